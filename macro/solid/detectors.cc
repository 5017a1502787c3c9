#include "macro/solid/detectors.h"

#include "macro/approximation/kernel.h"
#include "macro/points/parallel.h"

#include <array>
#include <cmath>

namespace spall {
namespace {

constexpr double reach = 2; ///< of a neighbour, in undeformed spacings
constexpr int fewest = 6;   ///< neighbours of a point that is looked at
/// An octant counts with at least this many neighbours whose second moment has at least this part of the
/// largest determinant its trace allows (0.5 on a lattice): no flat ones at the surface.
constexpr int fewest_in_octant = 4;
/// How far an octant reaches beyond its planes, in spacings: further than a jitter of 0.3 moves the
/// neighbours that lie in them on a lattice, and short of the next ones.
constexpr double octant_overlap = 0.35;
constexpr double least_determinant = 0.1;
constexpr std::size_t chunk_size = 512;

/// Least-squares map of neighbours, from undeformed to present offsets: F = B A^-1.
struct LocalMap {
  int count = 0;
  Mat3 a{}, b{};
  void add(double weight, const Vec3& from, const Vec3& to) {
    ++count;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        a[3 * i + j] += weight * from[i] * from[j];
        b[3 * i + j] += weight * to[i] * from[j];
      }
  }
  bool sound(int needed) const {
    const double mean = (a[0] + a[4] + a[8]) / 3;
    return count >= needed && determinant(a) > least_determinant * mean * mean * mean;
  }
};

/// What pass one leaves of a point for pass two.
struct Local {
  bool sound = false;
  Vec3 offset{};     ///< of the neighbours' mean from the linear map, spacings
  Vec3 asymmetry{};  ///< volume of the octants ahead less that of those behind, per axis and volume ratio
  double volume = 1; ///< of the octants over the integrated one
};

class Measure {
public:
  Measure(const Points& points_, const Ghosts& ghosts_, const NeighborLists& lists_,
          const std::vector<double>& plastic_strain)
      : points(points_), ghosts(ghosts_), lists(lists_), initial(points_.initial_position),
        locals(points_.owned) {
    for (VectorField* field : {&initial, &offset, &asymmetry, &scalars})
      field->resize(points.owned + ghosts.size());
    for (std::size_t i = 0; i < points.owned; ++i) scalars.component[0][i] = plastic_strain[i];
  }

  Local look(std::size_t i) const {
    Local local;
    LocalMap all;
    std::array<LocalMap, 8> octants;
    Vec3 mean_from{}, mean_to{};
    double weights = 0;
    const double h = points.spacing[i];
    for_each_neighbor(i, [&](std::uint32_t j, const Vec3& from, double weight) {
      Vec3 to;
      for (int c = 0; c < 3; ++c) {
        to[c] = (points.position.component[c][j] - points.position.component[c][i]) / h;
        mean_from[c] += weight * from[c], mean_to[c] += weight * to[c];
      }
      weights += weight;
      all.add(weight, from, to);
      for (int o = 0; o < 8; ++o) {
        bool inside = true; // near the border: in both
        for (int c = 0; c < 3; ++c) inside = inside && (o >> c & 1 ? from[c] : -from[c]) > -octant_overlap;
        if (inside) octants[o].add(1, from, to);
      }
    });
    if (!all.sound(fewest)) return local;
    const Mat3 map = multiply(all.b, inverse(all.a));
    for (int c = 0; c < 3; ++c)
      local.offset[c] = (mean_to[c] - map[3 * c] * mean_from[0] - map[3 * c + 1] * mean_from[1] -
                         map[3 * c + 2] * mean_from[2]) /
                        weights;
    const double integrated = determinant(points.deformation(i));
    std::array<double, 8> volume{};
    int sound = 0;
    double sum = 0;
    for (int o = 0; o < 8; ++o)
      if (octants[o].sound(fewest_in_octant)) {
        volume[o] = determinant(octants[o].b) / determinant(octants[o].a) / integrated;
        sum += volume[o], ++sound;
      }
    if (sound < 8) return local; // at the surface there are no octants to compare
    local.sound = true;
    local.volume = sum / 8;
    for (int c = 0; c < 3; ++c)
      for (int o = 0; o < 8; ++o) local.asymmetry[c] += (o >> c & 1 ? volume[o] : -volume[o]) / 4;
    return local;
  }

  Roughness run() {
    ghosts.refresh(points, {&initial});
    const std::size_t chunks = (points.owned + chunk_size - 1) / chunk_size;
    for_each_index(chunks, [&](std::size_t k) {
      for (std::size_t i = k * chunk_size; i < std::min(points.owned, (k + 1) * chunk_size); ++i)
        locals[i] = look(i);
    });
    share_locals();
    std::vector<Sums> parts(chunks);
    for_each_index(chunks, [&](std::size_t k) {
      for (std::size_t i = k * chunk_size; i < std::min(points.owned, (k + 1) * chunk_size); ++i)
        compare(i, parts[k]);
    });
    Sums sum;
    for (const Sums& part : parts)
      for (const auto member : members) sum.*member += part.*member;
    for (const auto member : members) sum.*member = ghosts.processes().sum(sum.*member);
    const double v = std::max(sum.volume, 1e-300), s = std::max(sum.sound_volume, 1e-300);
    return {.plastic_saw_tooth = std::sqrt(sum.plastic / v),
            .position_saw_tooth = std::sqrt(sum.position / s),
            .volume_mismatch = sum.mismatch / s,
            .volume_alternation = 0.5 * std::sqrt(sum.alternation / s)};
  }

private:
  struct Sums {
    double volume = 0, plastic = 0, sound_volume = 0, position = 0, mismatch = 0, alternation = 0;
  };

  static constexpr std::array<double Sums::*, 6> members = {&Sums::volume,       &Sums::plastic,
                                                            &Sums::sound_volume, &Sums::position,
                                                            &Sums::mismatch,     &Sums::alternation};

  /// What neighbours need to know of each other, also those on other ranks and behind planes.
  void share_locals() {
    for (std::size_t i = 0; i < points.owned; ++i) {
      offset.set(i, locals[i].offset);
      asymmetry.set(i, locals[i].asymmetry);
      scalars.component[1][i] = locals[i].sound;
    }
    ghosts.refresh(points, {&offset, &asymmetry});
    // Scalars are the same behind a plane: remote points only.
    ghosts.remote_points().update({&scalars});
  }

  /// Calls action(j, undeformed offset in spacings, kernel weight) for the neighbours of old.
  template<class Action> void for_each_neighbor(std::size_t i, const Action& action) const {
    const Vec3 centre = points.initial_position[i];
    const double inverse_h = 1 / points.spacing[i];
    for (std::uint32_t p = lists.start[i]; p < lists.start[i + 1]; ++p) {
      const std::uint32_t j = lists.index[p];
      if (j == i) continue;
      Vec3 from = initial[j];
      for (int c = 0; c < 3; ++c) from[c] = (from[c] - centre[c]) * inverse_h;
      const double distance = std::sqrt(dot(from, from));
      if (distance < reach) action(j, from, CubicSpline::value(distance / reach));
    }
  }

  /// Pass two: the point against the mean of its neighbours.
  void compare(std::size_t i, Sums& sums) const {
    double weights = 0, sound_weights = 0, plastic = 0;
    Vec3 mean_offset{}, mean_asymmetry{};
    int count = 0;
    for_each_neighbor(i, [&](std::uint32_t j, const Vec3&, double weight) {
      const std::uint32_t owner = ghosts.owner(points, j);
      ++count;
      weights += weight;
      plastic += weight * scalars.component[0][owner];
      if (scalars.component[1][owner] == 0) return;
      const Vec3 o = offset[j], a = asymmetry[j];
      sound_weights += weight;
      for (int c = 0; c < 3; ++c) mean_offset[c] += weight * o[c], mean_asymmetry[c] += weight * a[c];
    });
    const double v = points.volume[i];
    const auto square = [](double x) { return x * x; };
    if (count >= fewest && weights > 0) {
      sums.volume += v;
      sums.plastic += v * square(scalars.component[0][i] - plastic / weights);
    }
    if (!locals[i].sound || !(sound_weights > 0)) return;
    sums.sound_volume += v;
    sums.mismatch += v * (locals[i].volume - 1);
    for (int c = 0; c < 3; ++c) {
      sums.position += v * square(locals[i].offset[c] - mean_offset[c] / sound_weights);
      sums.alternation += v * square(locals[i].asymmetry[c] - mean_asymmetry[c] / sound_weights);
    }
  }

  const Points& points;
  const Ghosts& ghosts;
  const NeighborLists& lists;
  VectorField initial;           ///< positions, ghosts included; so are the next
  VectorField offset, asymmetry; ///< of the locals
  VectorField scalars;           ///< plastic strain, soundness
  std::vector<Local> locals;
};

} // namespace

Roughness measure_roughness(const Points& points, const Ghosts& ghosts, const NeighborLists& lists,
                            const std::vector<double>& plastic_strain) {
  return Measure(points, ghosts, lists, plastic_strain).run();
}

} // namespace spall
