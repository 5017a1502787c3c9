#include "macro/output/craters.h"

#include "macro/output/quantile.h"
#include "macro/points/neighbor_search.h"
#include "macro/points/parallel.h"
#include "shared/input/quantity.h"
#include "shared/output_directory.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spall {
namespace {

/// Number of sectors of the circle: each has 5 degrees, the angle that a cell covers at a distance of eleven
/// spacings from the axis.
constexpr std::size_t sectors = 72;
/// Samples per smallest spacing, along radius and depth, so that the steps of the outline are finer than the
/// cells that it follows.
constexpr double samples_per_spacing = 4;

/// Returns for each of this rank's points whether it has left the slab.
std::vector<bool> gone_points(const Solid& slab, const Fragments& fragments, Missing missing) {
  const Points& points = slab.points;
  const auto moved = [&points](std::size_t i, int c) {
    return points.position.component[c][i] - points.initial_position.component[c][i];
  };
  // The displacement of the slab as a whole is the median, which craters do not change.
  std::vector<double> along(points.owned);
  for (std::size_t i = 0; i < points.owned; ++i) along[i] = moved(i, 2);
  const Ranks& ranks = slab.ghosts.processes();
  const double middle =
      weighted_quantile(along, std::vector<double>(points.owned, 1.0),
                        std::floor(0.5 * ranks.sum(static_cast<double>(points.owned))) + 1, ranks);
  std::vector<bool> gone(points.owned);
  for (std::size_t i = 0; i < points.owned; ++i)
    gone[i] = fragments.of_point[i] != 0 ||
              (missing == Missing::fragments_and_moved &&
               std::hypot(moved(i, 0), moved(i, 1), along[i] - middle) > 0.5 * points.spacing[i]);
  return gone;
}

double radius_of(const Vec3& x) { return std::hypot(x[0], x[1]); }

/// Returns the largest distance from the axis of a point that has left the slab, m.
double outermost(const Solid& slab, const std::vector<bool>& gone) {
  const Points& points = slab.points;
  double radius = 0;
  for (std::size_t i = 0; i < points.owned; ++i)
    if (gone[i]) radius = std::max(radius, radius_of(points.initial_position[i]) + 2 * points.spacing[i]);
  return slab.ghosts.processes().max(radius);
}

/// Tells for a place in the undeformed slab whether its nearest point has left the slab.
class Places {
public:
  /// Collects the points of all ranks that can be nearest to a place within the distance `end` from the axis.
  Places(const Solid& slab, const std::vector<bool>& gone_here, double end) : planes(slab.ghosts.symmetry()) {
    const Points& points = slab.points;
    const Ranks& ranks = slab.ghosts.processes();
    const auto [least, most] = spacings_of(slab);
    smallest = least;
    const double beyond = end + 2 * most;
    struct Place {
      Vec3 x;
      bool gone;
    };
    std::vector<Place> list;
    for (std::size_t i = 0; i < points.owned; ++i)
      if (radius_of(points.initial_position[i]) <= beyond)
        list.push_back({points.initial_position[i], gone_here[i]});
    list = ranks.join(list);
    undeformed.resize(list.size());
    for (std::size_t i = 0; i < list.size(); ++i)
      undeformed.position.set(i, list[i].x), gone.push_back(list[i].gone);
    search.rebuild(undeformed, smallest);
  }

  /// False if there is no point at all.
  bool is_gone(double radius, double angle, double z) const {
    if (gone.empty()) return false;
    if (planes.axis) angle = 0;
    Vec3 x = {radius * std::cos(angle), radius * std::sin(angle), z};
    for (int c = 0; c < 3; ++c)
      if (planes.normal[c]) x[c] = std::abs(x[c]); // an image is never nearer than its owner
    std::uint32_t best = 0;
    double square = std::numeric_limits<double>::infinity();
    for (double reach = smallest; square > reach * reach / 4; reach *= 2)
      search.for_each_in_box(x, {reach, reach, reach}, [&](std::uint32_t i, double dx, double dy, double dz) {
        const double d = dx * dx + dy * dy + dz * dz;
        if (d < square) square = d, best = i;
      });
    return gone[best];
  }
  double smallest_spacing() const { return smallest; }

private:
  SymmetryPlanes planes;
  Points undeformed;
  std::vector<bool> gone;
  NeighborSearch search;
  double smallest;
};

/// Computes the crater of one face from the depths of all places.
void finish(Crater& crater, const std::vector<std::vector<double>>& depth, const std::vector<double>& radius,
            double width) {
  constexpr double sector = 2 * std::numbers::pi / sectors;
  double area = 0;
  crater.outline.assign(sectors, 0);
  crater.depth.assign(radius.size(), 0);
  for (std::size_t s = 0; s < sectors; ++s) {
    double gone = 0;
    for (std::size_t r = 0; r < radius.size(); ++r) {
      if (depth[s][r] > 0) gone += radius[r] * width * sector;
      crater.depth[r] += depth[s][r] / sectors;
      crater.deepest = std::max(crater.deepest, depth[s][r]);
    }
    crater.outline[s] = std::sqrt(2 * gone / sector);
    area += gone;
  }
  crater.mean_diameter = std::sqrt(4 * area / std::numbers::pi);
  for (std::size_t s = 0; s < sectors; ++s)
    crater.largest_diameter =
        std::max(crater.largest_diameter, crater.outline[s] + crater.outline[(s + sectors / 2) % sectors]);
}

} // namespace

Craters measure_craters(const Solid& slab, const Fragments& fragments, double front_face, double back_face,
                        double slab_radius, Missing missing) {
  const double thickness = back_face - front_face;
  const std::vector<bool> gone = gone_points(slab, fragments, missing);
  const double end = std::min(slab_radius, outermost(slab, gone));
  const Places places(slab, gone, end);
  Craters craters;
  const double width = places.smallest_spacing() / samples_per_spacing;
  for (std::size_t s = 0; s < sectors; ++s)
    craters.angle.push_back(2 * std::numbers::pi * (static_cast<double>(s) + 0.5) / sectors);
  for (double r = 0.5 * width; r < end; r += width) craters.radius.push_back(r);

  const auto layers = static_cast<int>(std::lround(std::max(1.0, thickness / width)));
  const double step = thickness / layers;
  const auto look = [&](double r, double angle, bool from_front) {
    int k = 0;
    while (k < layers &&
           places.is_gone(r, angle, front_face + (from_front ? k + 0.5 : layers - k - 0.5) * step))
      ++k;
    return k * step;
  };
  std::vector<std::vector<double>> front(sectors), back(sectors);
  for_each_index(sectors, [&](std::size_t s) {
    for (const double r : craters.radius) {
      front[s].push_back(look(r, craters.angle[s], true));
      back[s].push_back(look(r, craters.angle[s], false));
    }
  });
  finish(craters.front, front, craters.radius, width);
  finish(craters.back, back, craters.radius, width);
  return craters;
}

void write_craters(const std::filesystem::path& directory, const std::string& prefix,
                   const Craters& craters) {
  const auto table = [](const std::string& names, const std::vector<double>& at,
                        const std::vector<double>& front, const std::vector<double>& back) {
    std::string text = names + "\n";
    for (std::size_t i = 0; i < at.size(); ++i) {
      const char* comma = "";
      for (const double value : {at[i], front[i], back[i]})
        text += comma + format_quantity(value, Dimension::none), comma = ",";
      text += "\n";
    }
    return text;
  };
  write_atomically(
      directory / (prefix + "craters.csv"),
      table("angle,front_radius,back_radius", craters.angle, craters.front.outline, craters.back.outline));
  write_atomically(
      directory / (prefix + "crater_profiles.csv"),
      table("radius,front_depth,back_depth", craters.radius, craters.front.depth, craters.back.depth));
}

} // namespace spall
