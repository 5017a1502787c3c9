#include "macro/solid/hourglass_indicators.h"

#include "macro/approximation/kernel.h"
#include "macro/points/parallel.h"

#include <array>
#include <cmath>
#include <numbers>

namespace spall {
namespace {

constexpr double reach = 2;         ///< largest distance of a neighbour, in undeformed spacings
constexpr int fewest = 6;           ///< fewest neighbours of a point that is measured
constexpr int fewest_in_octant = 4; ///< fewest neighbours in an octant that is measured
/// Smallest determinant of the second moment, as a fraction of the largest one that its trace allows (0.5 for
/// an octant of a lattice). Clouds that are flatter, as at the surface, have no volume and are left out.
constexpr double least_determinant = 0.1;
/// An octant reaches this far beyond its planes, in spacings: further than a jitter of 0.3 moves the
/// neighbours that lie in the planes on a lattice, and not as far as the next ones.
constexpr double octant_overlap = 0.35;
constexpr std::size_t chunk_size = 512;

/// Least-squares map of neighbours from undeformed offsets X to present offsets x: x = F X with F = B A^-1, A
/// = sum w X X^T, B = sum w x X^T.
struct LocalMap {
  int count = 0;
  Mat3 a{}, b{};
  void add(double weight, const Vec3& from, const Vec3& to) {
    ++count;
    a += outer(weight * from, from);
    b += outer(weight * to, from);
  }
  bool has_volume(int needed) const {
    const double mean = trace(a) / 3;
    return count >= needed && determinant(a) > least_determinant * mean * mean * mean;
  }
  /// Returns the ratio of the present volume to the undeformed one, det F.
  double volume_ratio() const { return determinant(b) / determinant(a); }
};

/// Rotation about the z axis: that of an image of a ring.
struct Turn {
  double cosine, sine;
  explicit Turn(double angle) : cosine(std::cos(angle)), sine(std::sin(angle)) {}
  Vec3 operator()(const Vec3& a) const {
    return {cosine * a[0] - sine * a[1], sine * a[0] + cosine * a[1], a[2]};
  }
};

/// Measures of the neighbourhood of one point.
struct Local {
  bool complete = false; ///< whether there are neighbours in all octants
  Vec3 offset{};         ///< distance of the neighbours' mean from the linear map, in spacings
  Vec3 asymmetry{};  ///< for each axis the volume of the octants ahead less that of those behind, over the
                     ///< volume ratio
  double volume = 1; ///< volume of the octants over the integrated one
};

class HourglassMeasurement {
public:
  HourglassMeasurement(const Points& points_, const Ghosts& ghosts_, const NeighborLists& lists_,
                       const std::vector<double>& plastic_strain)
      : points(points_), ghosts(ghosts_), lists(lists_), initial(points_.initial_position),
        locals(points_.owned) {
    for (VectorField* field : {&initial, &offset, &asymmetry, &scalars})
      field->resize(points.owned + ghosts.size());
    for (std::size_t i = 0; i < points.owned; ++i) scalars.component[0][i] = plastic_strain[i];
  }

  HourglassIndicators run() {
    ghosts.refresh(points, {&initial});
    for_each_chunk([&](std::size_t, std::size_t i) { locals[i] = measure_local(i); });
    share_locals();
    std::vector<Sums> parts(chunks());
    for_each_chunk([&](std::size_t chunk, std::size_t i) { compare(i, parts[chunk]); });
    Sums sum;
    for (const Sums& part : parts)
      for (const auto member : members) sum.*member += part.*member;
    for (const auto member : members) sum.*member = ghosts.processes().sum(sum.*member);
    const double v = std::max(sum.volume, 1e-300), s = std::max(sum.complete_volume, 1e-300);
    return {.plastic_saw_tooth = std::sqrt(sum.plastic / v),
            .position_saw_tooth = std::sqrt(sum.position / s),
            .volume_mismatch = sum.mismatch / s,
            .volume_alternation = 0.5 * std::sqrt(sum.alternation / s)};
  }

private:
  struct Sums {
    double volume = 0, plastic = 0, complete_volume = 0, position = 0, mismatch = 0, alternation = 0;
  };

  static constexpr std::array<double Sums::*, 6> members = {&Sums::volume,          &Sums::plastic,
                                                            &Sums::complete_volume, &Sums::position,
                                                            &Sums::mismatch,        &Sums::alternation};

  std::size_t chunks() const { return (points.owned + chunk_size - 1) / chunk_size; }
  /// Calls action(chunk, i) for all owned points; chunks run in parallel.
  template<class Action> void for_each_chunk(const Action& action) const {
    for_each_index(chunks(), [&](std::size_t k) {
      for (std::size_t i = k * chunk_size; i < std::min(points.owned, (k + 1) * chunk_size); ++i)
        action(k, i);
    });
  }

  /// First pass: measures the neighbourhood of one point.
  Local measure_local(std::size_t i) const {
    LocalMap all;
    std::array<LocalMap, 8> octants;
    Vec3 mean_from{}, mean_to{};
    double weights = 0;
    const double h = points.spacing[i];
    const Vec3 centre = points.position[i];
    for_each_neighbor(i, [&](std::uint32_t j, const Turn& turn, const Vec3& from, double weight) {
      const Vec3 to = (turn(points.position[j]) - centre) / h;
      mean_from += weight * from;
      mean_to += weight * to;
      weights += weight;
      all.add(weight, from, to);
      for (int o = 0; o < 8; ++o) {
        bool inside = true; // a neighbour near a plane between two octants is in both
        for (int c = 0; c < 3; ++c) inside = inside && (o >> c & 1 ? from[c] : -from[c]) > -octant_overlap;
        if (inside) octants[o].add(1, from, to);
      }
    });
    Local local;
    if (!all.has_volume(fewest)) return local;
    const Mat3 map = multiply(all.b, inverse(all.a));
    for (int c = 0; c < 3; ++c)
      local.offset[c] =
          (mean_to[c] - map(c, 0) * mean_from[0] - map(c, 1) * mean_from[1] - map(c, 2) * mean_from[2]) /
          weights;
    compare_octants(octants, determinant(points.deformation(i)), local);
    return local;
  }

  /// Compares volumes of opposite octants. @param integrated volume ratio
  static void compare_octants(const std::array<LocalMap, 8>& octants, double integrated, Local& local) {
    std::array<double, 8> volume{};
    double sum = 0;
    for (int o = 0; o < 8; ++o) {
      if (!octants[o].has_volume(fewest_in_octant)) return; // at the surface there are no octants to compare
      volume[o] = octants[o].volume_ratio() / integrated;
      sum += volume[o];
    }
    local.complete = true;
    local.volume = sum / 8;
    for (int c = 0; c < 3; ++c)
      for (int o = 0; o < 8; ++o) local.asymmetry[c] += (o >> c & 1 ? volume[o] : -volume[o]) / 4;
  }

  /// Copies the results of the first pass to ghosts: points of other ranks and images behind symmetry planes.
  void share_locals() {
    for (std::size_t i = 0; i < points.owned; ++i) {
      offset.set(i, locals[i].offset);
      asymmetry.set(i, locals[i].asymmetry);
      scalars.component[1][i] = locals[i].complete;
    }
    ghosts.refresh(points, {&offset, &asymmetry});
    // Scalars are equal behind a symmetry plane, so only remote points are updated.
    ghosts.remote_points().update({&scalars});
  }

  /// Calls action(j, turn, undeformed offset in spacings, kernel weight) for the neighbours in the undeformed
  /// body: of a ring around the axis, the images on both sides of the half plane.
  template<class Action> void for_each_neighbor(std::size_t i, const Action& action) const {
    const Vec3 centre = points.initial_position[i];
    const double inverse_h = 1 / points.spacing[i];
    for (std::uint32_t p = lists.start[i]; p < lists.start[i + 1]; ++p) {
      const std::uint32_t j = lists.index[p];
      const int images = ghosts.symmetry().axis ? points_on_ring(initial[j][0], points.spacing[i]) : 1;
      const int side = static_cast<int>(reach); // an image is about one spacing off the next
      for (int k = -std::min(side, (images - 1) / 2); k <= std::min(side, images / 2); ++k) {
        if (j == i && k == 0) continue;
        const Turn turn(2 * std::numbers::pi * k / images);
        const Vec3 from = (turn(initial[j]) - centre) * inverse_h;
        const double distance = norm(from);
        if (distance < reach) action(j, turn, from, CubicSpline::value(distance / reach));
      }
    }
  }

  /// Second pass: compares the point with the mean of its neighbours.
  void compare(std::size_t i, Sums& sums) const {
    double weights = 0, complete_weights = 0, plastic = 0;
    Vec3 mean_offset{}, mean_asymmetry{};
    int count = 0;
    for_each_neighbor(i, [&](std::uint32_t j, const Turn& turn, const Vec3&, double weight) {
      const std::uint32_t owner = ghosts.owner(points, j);
      ++count;
      weights += weight;
      plastic += weight * scalars.component[0][owner];
      if (scalars.component[1][owner] == 0) return;
      complete_weights += weight;
      mean_offset += weight * turn(offset[j]);
      mean_asymmetry += weight * turn(asymmetry[j]);
    });
    const double v = points.volume[i];
    const auto square = [](double x) { return x * x; };
    if (count >= fewest && weights > 0) {
      sums.volume += v;
      sums.plastic += v * square(scalars.component[0][i] - plastic / weights);
    }
    if (!locals[i].complete || !(complete_weights > 0)) return;
    sums.complete_volume += v;
    sums.mismatch += v * (locals[i].volume - 1);
    const Vec3 offset_jump = locals[i].offset - mean_offset / complete_weights,
               asymmetry_jump = locals[i].asymmetry - mean_asymmetry / complete_weights;
    for (int c = 0; c < 3; ++c) {
      sums.position += v * square(offset_jump[c]);
      sums.alternation += v * square(asymmetry_jump[c]);
    }
  }

  const Points& points;
  const Ghosts& ghosts;
  const NeighborLists& lists;
  VectorField initial;           ///< initial positions; this and the next fields include ghosts
  VectorField offset, asymmetry; ///< offset and asymmetry of the local measures
  VectorField scalars;           ///< plastic strain, and whether there are neighbours in all octants
  std::vector<Local> locals;
};

} // namespace

HourglassIndicators measure_hourglassing(const Points& points, const Ghosts& ghosts,
                                         const NeighborLists& lists,
                                         const std::vector<double>& plastic_strain) {
  return HourglassMeasurement(points, ghosts, lists, plastic_strain).run();
}

} // namespace spall
