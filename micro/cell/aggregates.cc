#include "micro/cell/aggregates.h"

#include "micro/cell/power_diagram.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

namespace spall {
namespace {

using Eigen::Vector2d;

/// Number of Lloyd iterations, which move the sites to the centroids of their cells: enough to avoid slivers,
/// few enough to keep the packing random.
constexpr int roundings = 6;
/// Sides shorter than this times the square root of the mean area are collapsed, because they would make tiny
/// elements.
constexpr double shortest_side = 0.1;
/// Flattest corner that collapsing a side may make: sine of 180 degrees minus the corner's angle.
constexpr double flattest = 0.05;
/// Distance below which two corners are the same, in units of the cell.
constexpr double same_place = 1e-9;
/// Largest size of an aggregate over that of its polygon, so that a ring of mortar remains around it.
constexpr double largest_scale = 0.95;
/// Number of random packings that are tried.
constexpr int attempts = 20;

/// Returns a number uniform in [0, 1), the same on every machine, unlike std::uniform_real_distribution.
double uniform(std::mt19937& random) { return random() / 4294967296.0; }

/// A corner of a polygon: corners with the same number coincide up to a period.
struct Corner {
  std::size_t number = 0;
  Vector2d at;
};
using Polygon = std::vector<Corner>;

std::vector<Polygon> number_corners(const std::vector<PowerCell>& cells) {
  std::vector<Vector2d> known;
  std::vector<Polygon> polygons;
  for (const PowerCell& cell : cells) {
    polygons.emplace_back();
    for (const Vector2d& at : cell.corners) {
      std::size_t number = 0;
      const auto periods = [&] { return Vector2d((at - known[number]).array().round()); };
      while (number < known.size() && (at - known[number] - periods()).norm() > same_place) ++number;
      if (number == known.size()) known.push_back(at);
      polygons.back().push_back({number, known[number] + periods()});
    }
  }
  return polygons;
}

void drop_repeated(Polygon& polygon) {
  Polygon result;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    if (polygon[k].number != polygon[(k + 1) % polygon.size()].number) result.push_back(polygon[k]);
  polygon = std::move(result);
}

bool is_convex(const Polygon& polygon) {
  const std::size_t n = polygon.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vector2d in = polygon[(k + 1) % n].at - polygon[k].at,
                   out = polygon[(k + 2) % n].at - polygon[(k + 1) % n].at;
    if (in[0] * out[1] - in[1] * out[0] < flattest * in.norm() * out.norm()) return false;
  }
  return n >= 3;
}

/// Returns the polygons with one side collapsed to its middle in all polygons that share it; empty if some
/// polygon would not be convex.
std::vector<Polygon> without_side(std::vector<Polygon> polygons, const Corner& a, const Corner& b) {
  const Vector2d middle = 0.5 * (a.at + b.at);
  for (Polygon& polygon : polygons) {
    bool touched = false;
    for (Corner& corner : polygon)
      for (const Corner& end : {a, b})
        if (corner.number == end.number) {
          corner.at += middle - end.at;
          corner.number = a.number;
          touched = true;
          break;
        }
    drop_repeated(polygon);
    if (touched && !is_convex(polygon)) return {};
  }
  return polygons;
}

/// Collapses short sides, shortest first. @return false if a side that cannot be collapsed is far too short
bool close_short_sides(std::vector<Polygon>& polygons) {
  const double limit = shortest_side / std::sqrt(static_cast<double>(polygons.size()));
  using Ends = std::pair<std::size_t, std::size_t>;
  std::vector<Ends> uncollapsible;
  for (;;) {
    Corner a, b;
    double shortest = limit;
    for (const Polygon& polygon : polygons)
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Corner &from = polygon[k], &to = polygon[(k + 1) % polygon.size()];
        const double length = (to.at - from.at).norm();
        const Ends ends = std::minmax(from.number, to.number);
        if (length < shortest &&
            std::find(uncollapsible.begin(), uncollapsible.end(), ends) == uncollapsible.end()) {
          shortest = length;
          a = from;
          b = to;
        }
      }
    if (shortest == limit) break;
    if (std::vector<Polygon> closed = without_side(polygons, a, b); !closed.empty())
      polygons = std::move(closed);
    else if (shortest > 0.1 * limit)
      uncollapsible.emplace_back(std::minmax(a.number, b.number));
    else
      return false;
  }
  return std::all_of(polygons.begin(), polygons.end(), is_convex);
}

/// Makes one random packing of aggregates with given areas; empty if it would make bad elements.
std::vector<Aggregate> pack(const std::vector<double>& areas, double fraction, std::mt19937& random) {
  std::vector<double> shares;
  for (const double of_one : areas) shares.push_back(of_one / fraction);
  std::vector<Vector2d> sites(areas.size());
  for (Vector2d& site : sites)
    for (double& x : site) x = uniform(random);
  std::vector<PowerCell> cells;
  for (int i = 0;; ++i) {
    cells = power_diagram(sites, weights_for_areas(sites, shares));
    if (i == roundings) break;
    for (std::size_t k = 0; k < sites.size(); ++k) {
      const Vector2d centre = centroid(cells[k].corners);
      sites[k] = centre - centre.array().floor().matrix();
    }
  }
  std::vector<Polygon> polygons = number_corners(cells);
  for (Polygon& polygon : polygons) drop_repeated(polygon);
  if (!close_short_sides(polygons)) return {};
  std::vector<Aggregate> result;
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    Aggregate aggregate;
    for (const Corner& corner : polygons[k]) aggregate.corners.push_back(corner.at);
    aggregate.centre = centroid(aggregate.corners);
    aggregate.scale = std::sqrt(areas[k] / area(aggregate.corners));
    if (aggregate.scale > largest_scale) return {};
    result.push_back(std::move(aggregate));
  }
  return result;
}

} // namespace

const std::vector<std::pair<std::string, MortarCracks>>& mortar_crack_words() {
  static const std::vector<std::pair<std::string, MortarCracks>> words = {
      {"none", MortarCracks::none},
      {"corners", MortarCracks::corners},
      {"corners and flats", MortarCracks::corners_and_flats}};
  return words;
}

LongestSides longest_sides(const std::vector<Aggregate>& aggregates, int refinements) {
  LongestSides longest;
  for (const Aggregate& a : aggregates)
    for (std::size_t k = 0; k < a.corners.size(); ++k) {
      const Vector2d side = a.corners[(k + 1) % a.corners.size()] - a.corners[k];
      longest.interface_zone = std::max(longest.interface_zone, 0.5 * a.scale * side.norm());
      longest.mortar = std::max(longest.mortar, (1 - a.scale) * (a.corners[k] - a.centre).norm());
    }
  const double parts = std::pow(2, refinements);
  return {longest.interface_zone / parts, longest.mortar / parts};
}

std::vector<double> aggregate_diameters(const Grading& grading, double cell_size) {
  const double n = grading.exponent, low = grading.smallest, high = grading.largest;
  // F is the passing share by area; the density of the number of aggregates is F' / (pi d^2 / 4).
  const double span = std::pow(high, n) - std::pow(low, n);
  const auto passing = [&](double d) { return (std::pow(d, n) - std::pow(low, n)) / span; };
  const double largest_power = std::pow(high, n - 2), smallest_power = std::pow(low, n - 2);
  const double expected = grading.fraction * cell_size * cell_size * 4 / std::numbers::pi * n / (2 - n) *
                          (smallest_power - largest_power) / span;
  const int number = std::max(1, static_cast<int>(std::lround(expected)));
  std::vector<double> diameters;
  double above = high;
  for (int i = 1; i <= number; ++i) {
    const double below =
        i == number ? low
                    : std::pow(largest_power + (smallest_power - largest_power) * i / number, 1 / (n - 2));
    diameters.push_back(
        std::sqrt(4 / std::numbers::pi * grading.fraction * (passing(above) - passing(below))));
    above = below;
  }
  return diameters;
}

std::vector<Aggregate> place_aggregates(const std::vector<double>& diameters, int seed) {
  std::vector<double> areas;
  double fraction = 0;
  for (const double d : diameters) {
    areas.push_back(0.25 * std::numbers::pi * d * d);
    fraction += areas.back();
  }
  std::mt19937 random(static_cast<std::uint32_t>(seed));
  for (int i = 0; i < attempts; ++i)
    if (std::vector<Aggregate> packed = pack(areas, fraction, random); !packed.empty()) return packed;
  throw std::runtime_error("aggregates cannot be packed into the cell");
}

} // namespace spall
