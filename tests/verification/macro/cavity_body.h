#pragma once

#include "macro/shape/cells.h"
#include "macro/solid/solid.h"
#include "shared/error.h"
#include "tests/support/cavity_expansion.h"

#include <memory>
#include <numbers>
#include <numeric>
#include <vector>

namespace spall::test {

/// Shells of points around a cavity. The innermost points lie on the wall, and their shell is half as thick.
struct Shells {
  std::vector<double> radius;   ///< of the points, m
  std::vector<double> boundary; ///< between the shells: shell k is from boundary k to k + 1, m
  std::vector<double> width;    ///< of whole shells, m

  std::size_t size() const { return radius.size(); }
  /// The shell whose points have this radius.
  std::size_t at(double where) const {
    const auto next = std::upper_bound(boundary.begin() + 1, boundary.end() - 1, where);
    return static_cast<std::size_t>(next - boundary.begin()) - 1;
  }
};

/// Where the shells are thin, and how they grow.
struct ShellGrading {
  double spacing = 4e-3;      ///< of the inner shells, m
  double fine_radius = 80e-3; ///< up to which shells are thin, m
  double growth = 1.08;       ///< of each further shell
  double widest = 10e-3;      ///< m
};

inline Shells shells_around(const Cavity& cavity, const ShellGrading& grading) {
  Shells shells;
  double width = grading.spacing;
  shells.boundary = {cavity.radius};
  while (shells.boundary.back() < cavity.outer_radius) {
    const bool first = shells.radius.empty();
    const double begin = shells.boundary.back();
    if (begin > grading.fine_radius) width = std::min(width * grading.growth, grading.widest);
    shells.width.push_back(width);
    shells.radius.push_back(first ? begin : begin + 0.5 * width);
    shells.boundary.push_back(begin + (first ? 0.5 : 1) * width);
  }
  return shells;
}

/// Points of an annulus with rotational symmetry, in layers from z = 0 to the height; the outermost layers
/// lie on the ends, with half cells. Each shell has layers about as thick as itself.
inline Points annulus_points(const Shells& shells, double height, double density) {
  std::vector<Vec3> positions;
  std::vector<Cell> cells;
  for (std::size_t k = 0; k < shells.size(); ++k) {
    const int layers = std::max(2, static_cast<int>(std::lround(height / shells.width[k])));
    const double inner = shells.boundary[k], outer = shells.boundary[k + 1], thickness = height / layers;
    const double area = std::numbers::pi * (outer * outer - inner * inner);
    for (int j = 0; j <= layers; ++j) {
      const bool end = j == 0 || j == layers;
      positions.push_back({shells.radius[k], 0, j * thickness});
      cells.push_back({.volume = area * thickness * (end ? 0.5 : 1),
                       .spacing = std::cbrt(shells.width[k] * thickness * shells.width[k]),
                       .faces = 0});
    }
  }
  return points_of(positions, cells, density, 0.5);
}

/// Points of a spherical shell with rotational symmetry: each shell of points is divided over the polar angle
/// into arcs about as long as it is thick.
inline Points sphere_points(const Shells& shells, double density) {
  std::vector<Vec3> positions;
  std::vector<Cell> cells;
  for (std::size_t k = 0; k < shells.size(); ++k) {
    const double r = shells.radius[k], width = shells.width[k];
    const int arcs = static_cast<int>(std::lround(std::numbers::pi * r / width));
    const double angle = std::numbers::pi / arcs;
    const double cubes = std::pow(shells.boundary[k + 1], 3) - std::pow(shells.boundary[k], 3);
    for (int j = 0; j < arcs; ++j) {
      const double middle = (j + 0.5) * angle;
      positions.push_back({r * std::sin(middle), 0, r * std::cos(middle)});
      const double slice = std::cos(j * angle) - std::cos((j + 1) * angle);
      cells.push_back({.volume = 2. / 3 * std::numbers::pi * cubes * slice,
                       .spacing = std::cbrt(width * width * r * angle),
                       .faces = 0});
    }
  }
  return points_of(positions, cells, density, 0.5);
}

/// A body of points whose cavity opens: explicit steps of a solid, whose innermost points move radially at
/// the velocity of the wall. A cylinder has no axial velocity at its ends.
class CavityBody {
public:
  static constexpr double height = 32e-3; ///< of the annulus, m

  template<class Material>
  CavityBody(const Material& material, const Cavity& cavity_, const ShellGrading& grading,
             const SolidInputs& numerics)
      : cavity(cavity_), shells(shells_around(cavity, grading)) {
    Points points = cavity.hoops == 1 ? annulus_points(shells, height, material.density)
                                      : sphere_points(shells, material.density);
    solid = make_solid(material, std::move(points), {.axis = true}, numerics);
    members.resize(shells.size());
    const Points& p = solid->points;
    for (std::size_t i = 0; i < p.owned; ++i) {
      const Vec3 x = p.initial_position[i];
      const std::size_t shell = shells.at(norm(radial(x)));
      direction.push_back(unit(radial(x)));
      if (shell == 0) wall.push_back(i);
      const bool end = cavity.hoops == 1 && (x[2] < 1e-9 || x[2] > height - 1e-9);
      if (end)
        ends.push_back(i);
      else
        members[shell].push_back(i);
    }
  }

  CavityResult run(int refresh_interval, double step_factor = 0.4) {
    CavityResult result;
    double stable = 0;
    for (int step = 0; time < cavity.end_time(); ++step) {
      if (step % refresh_interval == 0) stable = solid->refresh().stable_step;
      const double dt = step_factor * stable;
      time += dt;
      move(dt);
      const SolidReport report = solid->update(dt, time);
      if (!report.failure.empty()) throw ComputationError(report.failure);
      std::vector<double> stresses;
      for (const double radius : cavity.gauges) stresses.push_back(stress(shells.at(radius)));
      result.gauges.add(time, stresses);
    }
    result.end = profile();
    return result;
  }

  /// Mean J of the points of a shell over the ratio of the volumes between its two neighbour shells.
  double volume_error(std::size_t shell) const {
    const double power = cavity.hoops + 1;
    const auto between = [&](const auto& at) {
      return std::pow(at(shell + 1), power) - std::pow(at(shell - 1), power);
    };
    const double exact = between([&](std::size_t k) { return mean_radius(k); }) /
                         between([&](std::size_t k) { return shells.radius[k]; });
    return volume_ratio(shell) / exact - 1;
  }
  /// Standard deviation of the pressure over the points of a shell, over their mean.
  double noise(std::size_t shell) const {
    const auto pressure = [&](std::size_t i) { return trace(solid->points.stress[i]); };
    const double mean = mean_over(shell, pressure);
    const double square =
        mean_over(shell, [&](std::size_t i) { return (pressure(i) - mean) * (pressure(i) - mean); });
    return std::sqrt(square) / std::abs(mean);
  }
  std::size_t shell_at(double radius) const { return shells.at(radius); }
  double spacing_at(double radius) const { return shells.width[shells.at(radius)]; }
  /// Volume of all points at the start, m^3.
  double volume() const {
    return std::accumulate(solid->points.volume.begin(), solid->points.volume.end(), 0.0);
  }

private:
  /// The part of a vector away from the axis or the centre.
  Vec3 radial(const Vec3& x) const { return cavity.hoops == 1 ? Vec3{x[0], x[1], 0} : x; }

  void move(double dt) {
    Points& p = solid->points;
    for (std::size_t i = 0; i < p.owned; ++i) p.velocity.set(i, p.velocity[i] + dt / p.mass[i] * p.force[i]);
    for (const std::size_t i : wall) p.velocity.set(i, cavity.wall_velocity(time) * direction[i]);
    for (const std::size_t i : ends) p.velocity.component[2][i] = 0;
    for (std::size_t i = 0; i < p.owned; ++i) p.position.set(i, p.position[i] + dt * p.velocity[i]);
  }
  /// Mean over the points of a shell, without those on the ends.
  template<class Value> double mean_over(std::size_t shell, const Value& value) const {
    double sum = 0, volume = 0;
    for (const std::size_t i : members[shell])
      sum += solid->points.volume[i] * value(i), volume += solid->points.volume[i];
    return sum / volume;
  }
  double stress(std::size_t shell) const {
    return mean_over(shell, [&](std::size_t i) {
      const Sym3& s = solid->points.stress[i];
      const Vec3 n = unit(radial(solid->points.position[i]));
      return n[0] * n[0] * s[0] + n[2] * n[2] * s[2] + 2 * n[0] * n[2] * s[5];
    });
  }
  double mean_radius(std::size_t shell) const {
    return mean_over(shell, [&](std::size_t i) { return norm(radial(solid->points.position[i])); });
  }
  double volume_ratio(std::size_t shell) const {
    return mean_over(shell, [&](std::size_t i) { return determinant(solid->points.deformation(i)); });
  }
  RadialProfile profile() const {
    const std::vector<double> plastic = solid->field_or_zero("plastic_strain"),
                              largest = solid->field_or_zero("largest_compression");
    RadialProfile p;
    for (std::size_t k = 0; k < shells.size(); ++k) {
      p.radius.push_back(shells.radius[k]);
      p.stress.push_back(stress(k));
      p.plastic_strain.push_back(mean_over(k, [&](std::size_t i) { return plastic[i]; }));
      p.largest_compression.push_back(mean_over(k, [&](std::size_t i) { return largest[i]; }));
      p.volume_ratio.push_back(volume_ratio(k));
    }
    return p;
  }

  const Cavity cavity;
  const Shells shells;
  std::unique_ptr<Solid> solid;
  double time = 0;
  std::vector<Vec3> direction;                   ///< of each point, away from the axis or the centre
  std::vector<std::size_t> wall, ends;           ///< points that are driven, and those held along the axis
  std::vector<std::vector<std::size_t>> members; ///< points of each shell, without those on the ends
};

} // namespace spall::test
