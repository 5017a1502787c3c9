#pragma once

#include "macro/material/material.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace spall::test {

/// A cavity in a large body at rest whose wall, a material surface, moves outwards. The motion is radial:
/// about an axis without axial strain, or about a point. Lengths in m, times in s.
struct Cavity {
  int hoops = 1;                ///< directions around the cavity: 1 cylindrical, 2 spherical
  double radius = 12e-3;        ///< of the wall at the start
  double opened = 25e-3;        ///< of the wall at the end
  double velocity = 50;         ///< of the wall after the ramp, m/s
  double ramp = 20e-6;          ///< the velocity of the wall grows linearly for this long
  double outer_radius = 0.5;    ///< of the body, which is free there
  std::vector<double> gauges{}; ///< material radii where the radial stress is recorded

  double wall_velocity(double time) const { return velocity * std::min(1.0, time / ramp); }
  double end_time() const { return (opened - radius) / velocity + 0.5 * ramp; }
};

/// Values against time.
struct TimeHistory {
  std::vector<double> time;
  std::vector<std::vector<double>> values; ///< one list per time

  void add(double now, std::vector<double> list) { time.push_back(now), values.push_back(std::move(list)); }
  /// Returns the mean over time of value k after a part of the whole time (rule of trapezia).
  double late_mean(std::size_t k, double after = 0.5) const {
    double sum = 0, duration = 0;
    for (std::size_t n = 1; n < time.size(); ++n) {
      if (time[n - 1] < after * time.back()) continue;
      const double dt = time[n] - time[n - 1];
      sum += 0.5 * dt * (values[n - 1][k] + values[n][k]), duration += dt;
    }
    return sum / duration;
  }
};

/// State against the material radius.
struct RadialProfile {
  std::vector<double> radius; ///< at the start, ascending
  std::vector<double> stress; ///< radial, tension positive, Pa
  std::vector<double> plastic_strain, largest_compression, volume_ratio;

  /// Returns the radius that a zone reaches: where the values, linear in between, last fall below a
  /// threshold.
  double reach(const std::vector<double>& values, double threshold) const {
    for (std::size_t i = radius.size() - 1; i-- > 0;)
      if (values[i] > threshold) {
        const double part = (values[i] - threshold) / (values[i] - values[i + 1]);
        return radius[i] + part * (radius[i + 1] - radius[i]);
      }
    return 0;
  }
};

struct CavityResult {
  TimeHistory wall;   ///< pressure on the wall, Pa
  TimeHistory gauges; ///< radial stress at the gauges, tension positive, Pa
  RadialProfile end;  ///< at the end
};

/// Cells of the one-dimensional solver: the first is `width` wide (m), each next one wider by the growth.
struct RadialMesh {
  double width = 1e-3, growth = 1.04;

  /// Every cell divided in two.
  RadialMesh halved() const { return {width / (1 + std::sqrt(growth)), std::sqrt(growth)}; }
};

/// The one-dimensional problem of a cavity: Lagrangian cells between nodes, central differences (von Neumann
/// and Richtmyer 1950; Wilkins 1964). With g directions around the cavity and the radius r,
///
///   rho a = d sigma_r / dr + g (sigma_r - sigma_t) / r,   D_r = dv / dr,   D_t = v / r.
///
/// Nodal forces do the work of the cells' stresses, with D at the middle of a cell. J is the exact ratio of
/// a cell's volumes. In compression the mean stress has the artificial viscosity
/// q = rho l (c_1 c |div v| + c_2 l (div v)^2), l width and c wave speed of the cell: with c_1 = 0.1 and
/// c_2 = 1.5 a shock is a few cells wide and does not ring.
template<class Material> class RadialSolver {
public:
  RadialSolver(const Material& material_, const Cavity& cavity_, const RadialMesh& mesh)
      : material(material_), cavity(cavity_), g(cavity_.hoops) {
    node = {cavity.radius};
    for (double width = mesh.width; node.back() < cavity.outer_radius; width *= mesh.growth)
      node.push_back(node.back() + width);
    velocity.resize(node.size()), force.resize(node.size()), node_mass.resize(node.size());
    start = node;
    cells.resize(node.size() - 1);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      cells[i].volume = volume(i);
      node_mass[i] += 0.5 * material.density * volume(i);
      node_mass[i + 1] += 0.5 * material.density * volume(i);
    }
  }

  CavityResult run() {
    CavityResult result;
    while (time < cavity.end_time()) {
      step();
      result.wall.add(time, {-force[0] / std::pow(node[0], g)});
      std::vector<double> stresses;
      for (const double radius : cavity.gauges) stresses.push_back(stress_at(radius));
      result.gauges.add(time, stresses);
    }
    result.end = profile();
    return result;
  }

private:
  struct Cell {
    double volume;        ///< at the start, per angle (rad or sr) of the wall and, of a cylinder, per length
    Sym3 stress{};        ///< components: radial, around, around or axial, Pa
    double viscosity = 0; ///< q, Pa
    typename Material::State state{};
  };

  double volume(std::size_t i) const {
    return (std::pow(node[i + 1], g + 1) - std::pow(node[i], g + 1)) / (g + 1);
  }
  double middle(std::size_t i) const { return 0.5 * (start[i] + start[i + 1]); }

  /// One step of central differences, its length 0.3 of the Courant limit.
  void step() {
    double dt = 1;
    for (std::size_t i = 0; i < cells.size(); ++i)
      dt = std::min(dt, 0.3 * (node[i + 1] - node[i]) / material.sound_speed(cells[i].state));
    time += dt;
    for (std::size_t i = 0; i < node.size(); ++i) velocity[i] += dt / node_mass[i] * force[i];
    velocity[0] = cavity.wall_velocity(time);
    for (std::size_t i = 0; i < node.size(); ++i) node[i] += 0.5 * dt * velocity[i];
    std::vector<Sym3> rates;
    for (std::size_t i = 0; i < cells.size(); ++i) rates.push_back(rate(i));
    for (std::size_t i = 0; i < node.size(); ++i) node[i] += 0.5 * dt * velocity[i];
    std::fill(force.begin(), force.end(), 0.0);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      update(i, rates[i], dt);
      add_forces(i);
    }
  }
  /// D of a cell, 1/s.
  Sym3 rate(std::size_t i) const {
    const double radial = (velocity[i + 1] - velocity[i]) / (node[i + 1] - node[i]),
                 around = (velocity[i + 1] + velocity[i]) / (node[i + 1] + node[i]);
    return {radial, around, g == 2 ? around : 0, 0, 0, 0};
  }
  void update(std::size_t i, const Sym3& rate, double dt) {
    Cell& cell = cells[i];
    const double width = node[i + 1] - node[i], J = volume(i) / cell.volume,
                 around = 0.5 * (node[i + 1] + node[i]) / middle(i);
    const Mat3 F = {width / (start[i + 1] - start[i]), 0, 0, 0, around, 0, 0, 0, g == 2 ? around : 1};
    material.update(cell.stress, cell.state,
                    {.increment = dt * rate, .dt = dt, .volume_ratio = J, .deformation = F});
    const double closing = std::max(0.0, -trace(rate));
    cell.viscosity = material.density / J * width * closing *
                     (0.1 * material.sound_speed(cell.state) + 1.5 * width * closing);
  }
  void add_forces(std::size_t i) {
    const double width = node[i + 1] - node[i], r = 0.5 * (node[i + 1] + node[i]), q = cells[i].viscosity;
    const double radial = (cells[i].stress[0] - q) * std::pow(r, g),
                 around = 0.5 * g * (cells[i].stress[1] - q) * std::pow(r, g - 1) * width;
    force[i] += radial - around;
    force[i + 1] -= radial + around;
  }

  double stress_at(double radius) const {
    std::size_t i = 0;
    while (i + 2 < cells.size() && middle(i + 1) < radius) ++i;
    const double part = (radius - middle(i)) / (middle(i + 1) - middle(i));
    return (1 - part) * cells[i].stress[0] + part * cells[i + 1].stress[0];
  }
  static double history(const Cell& cell, const std::string& name) {
    for (const auto& field : Material::fields)
      if (field.name == name) return cell.state.*field.value;
    return 0;
  }
  RadialProfile profile() const {
    RadialProfile p;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      p.radius.push_back(middle(i));
      p.stress.push_back(cells[i].stress[0]);
      p.plastic_strain.push_back(history(cells[i], "plastic_strain"));
      p.largest_compression.push_back(history(cells[i], "largest_compression"));
      p.volume_ratio.push_back(volume(i) / cells[i].volume);
    }
    return p;
  }

  const Material material;
  const Cavity cavity;
  const int g;
  double time = 0;
  std::vector<double> node, start, velocity, force, node_mass; ///< radius now and at the start
  std::vector<Cell> cells;
};

/// Opens a cavity in the one-dimensional solver.
template<class Material>
CavityResult open_in_one_dimension(const Material& material, const Cavity& cavity,
                                   const RadialMesh& mesh = {}) {
  return RadialSolver<Material>(material, cavity, mesh).run();
}

} // namespace spall::test
