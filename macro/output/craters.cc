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

/// What has become of the concrete at a point.
struct Fate {
  bool gone = false; ///< whether it has left the slab
  double along = 0;  ///< displacement along z relative to the slab as a whole, m
};

/// Returns the fate of each of this rank's points.
std::vector<Fate> fates_of(const Solid& slab, const Fragments& fragments, Missing missing) {
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
  std::vector<Fate> fates(points.owned);
  for (std::size_t i = 0; i < points.owned; ++i)
    fates[i] = {fragments.of_point[i] != 0 ||
                    (missing == Missing::fragments_and_moved &&
                     std::hypot(moved(i, 0), moved(i, 1), along[i] - middle) > 0.5 * points.spacing[i]),
                along[i] - middle};
  return fates;
}

double radius_of(const Vec3& x) { return std::hypot(x[0], x[1]); }

/// Returns a distance from the axis beyond which nothing is missing, m. Of two places that have parted by
/// more than `loose` one has moved by more than half of it.
double outermost(const Solid& slab, const std::vector<Fate>& fates, double loose) {
  const Points& points = slab.points;
  double radius = 0;
  for (std::size_t i = 0; i < points.owned; ++i)
    if (fates[i].gone || std::abs(fates[i].along) > 0.5 * loose)
      radius = std::max(radius, radius_of(points.initial_position[i]) + 2 * points.spacing[i]);
  return slab.ghosts.processes().max(radius);
}

/// Tells for a place in the undeformed slab what has become of its nearest point.
class Places {
public:
  /// Collects the points of all ranks that can be nearest to a place within the distance `end` from the axis.
  Places(const Solid& slab, const std::vector<Fate>& fates_here, double end)
      : planes(slab.ghosts.symmetry()) {
    const Points& points = slab.points;
    const Ranks& ranks = slab.ghosts.processes();
    const auto [least, most] = spacings_of(slab);
    smallest = least;
    const double beyond = end + 2 * most;
    struct Place {
      Vec3 x;
      Fate fate;
    };
    std::vector<Place> list;
    for (std::size_t i = 0; i < points.owned; ++i)
      if (radius_of(points.initial_position[i]) <= beyond)
        list.push_back({points.initial_position[i], fates_here[i]});
    list = ranks.join(list);
    undeformed.resize(list.size());
    for (std::size_t i = 0; i < list.size(); ++i)
      undeformed.position.set(i, list[i].x), fates.push_back(list[i].fate);
    search.rebuild(undeformed, smallest);
  }

  /// Nothing has become of a place if there is no point at all.
  Fate fate(double radius, double angle, double z) const {
    if (fates.empty()) return {};
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
    return fates[best];
  }
  double smallest_spacing() const { return smallest; }

private:
  SymmetryPlanes planes;
  Points undeformed;
  std::vector<Fate> fates;
  NeighborSearch search;
  double smallest;
};

/// Returns how many places of a column, from a face on, are missing. The one of two places that an open crack
/// parts which has moved more is loose. @param outwards -1 at the front, where loose places move against z, 1
/// at the back
std::size_t missing_places(const std::vector<Fate>& column, double outwards, double loose) {
  const auto parted = [&](const Fate& outer, const Fate& inner) {
    return !inner.gone && outwards * (outer.along - inner.along) > loose &&
           std::abs(outer.along) > std::abs(inner.along);
  };
  std::size_t k = 0;
  while (k < column.size() &&
         (column[k].gone || std::any_of(column.begin() + static_cast<long>(k) + 1, column.end(),
                                        [&](const Fate& inner) { return parted(column[k], inner); })))
    ++k;
  return k;
}

/// Leaves out the rings beyond the outermost one in which a place is missing.
void leave_sound_rings_out(std::vector<double>& radius, std::vector<std::vector<double>>& front,
                           std::vector<std::vector<double>>& back) {
  std::size_t rings = 0;
  for (const auto* face : {&front, &back})
    for (const std::vector<double>& depth : *face)
      for (std::size_t r = rings; r < depth.size(); ++r)
        if (depth[r] > 0) rings = r + 1;
  radius.resize(rings);
  for (auto* face : {&front, &back})
    for (std::vector<double>& depth : *face) depth.resize(rings);
}

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
                        double slab_radius, double loose, Missing missing) {
  const double thickness = back_face - front_face;
  const double opening = missing == Missing::fragments ? std::numeric_limits<double>::infinity() : loose;
  const std::vector<Fate> fates = fates_of(slab, fragments, missing);
  const double end = std::min(slab_radius, outermost(slab, fates, opening));
  const Places places(slab, fates, end);
  Craters craters;
  const double width = places.smallest_spacing() / samples_per_spacing;
  for (std::size_t s = 0; s < sectors; ++s)
    craters.angle.push_back(2 * std::numbers::pi * (static_cast<double>(s) + 0.5) / sectors);
  for (double r = 0.5 * width; r < end; r += width) craters.radius.push_back(r);

  const auto layers = static_cast<int>(std::lround(std::max(1.0, thickness / width)));
  const double step = thickness / layers;
  std::vector<std::vector<double>> front(sectors), back(sectors);
  for_each_index(slab.ghosts.symmetry().axis ? 1 : sectors, [&](std::size_t s) {
    for (const double r : craters.radius) {
      std::vector<Fate> column;
      column.reserve(static_cast<std::size_t>(layers));
      for (int k = 0; k < layers; ++k)
        column.push_back(places.fate(r, craters.angle[s], front_face + (k + 0.5) * step));
      front[s].push_back(static_cast<double>(missing_places(column, -1, opening)) * step);
      std::reverse(column.begin(), column.end());
      back[s].push_back(static_cast<double>(missing_places(column, 1, opening)) * step);
    }
  });
  if (slab.ghosts.symmetry().axis)
    std::fill(front.begin() + 1, front.end(), front[0]), std::fill(back.begin() + 1, back.end(), back[0]);
  leave_sound_rings_out(craters.radius, front, back);
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
