#include "macro/reinforcement/point_interpolation.h"

#include "macro/approximation/kernel.h"
#include "macro/approximation/reproducing_kernel.h"
#include "macro/points/neighbor_search.h"
#include "macro/points/parallel.h"

#include <algorithm>
#include <cmath>

namespace spall {
namespace {

/// Points are listed as near a place within this part of its support more, so that the list serves for some
/// steps. With 0.3 and 1.9 spacings a list serves until something has moved by half a spacing.
constexpr double margin = 0.3;

/// A place is among points if the magnitudes of its weights have no larger sum than this. The sum is 1 in the
/// bulk and about 1.2 on a flat face; weights that extrapolate to a place beside the points grow without
/// limit.
constexpr double largest_sum = 2;

Vec3 reflected(Vec3 x, std::uint32_t mask) {
  for (int c = 0; c < 3; ++c)
    if (mask >> c & 1) x[c] = -x[c];
  return x;
}

} // namespace

PointInterpolation::PointInterpolation(std::vector<double> radius_, Profile profile_,
                                       const SymmetryPlanes& planes_, const Ranks& ranks_)
    : radius(std::move(radius_)), profile(profile_), planes(planes_), ranks(ranks_), near(radius.size()),
      parts(radius.size()), moments(sums * radius.size()), sizes(radius.size()), holds(radius.size()) {}

void PointInterpolation::find_near(const VectorField& places, const Points& points) {
  NeighborSearch search;
  if (points.owned > 0)
    search.rebuild(points, *std::min_element(points.spacing.begin(), points.spacing.end()));
  for_each_index(near.size(), [&](std::size_t k) {
    near[k].clear();
    const double reach = (1 + margin) * radius[k];
    for (std::uint32_t mask = 0; mask < 8; ++mask) {
      bool there = points.owned > 0;
      for (int c = 0; c < 3; ++c) there = there && (!(mask >> c & 1) || planes.normal[c]);
      if (!there) continue;
      search.for_each_in_box(reflected(places[k], mask), {reach, reach, reach},
                             [&](std::uint32_t i, double x, double y, double z) {
                               if (i < points.owned && x * x + y * y + z * z < reach * reach)
                                 near[k].push_back({i, mask});
                             });
    }
    std::sort(near[k].begin(), near[k].end(), [](const Near& a, const Near& b) {
      return a.point < b.point || (a.point == b.point && a.mask < b.mask);
    });
  });
  travelled = 0;
  known = true;
}

// The functions of one place are not inlined: inlined into a loop, a compiler may round the first of its
// passes otherwise than the others, and which place comes first depends on the number of threads.

template<class Kernel>
[[gnu::noinline]] void PointInterpolation::add_moments(std::size_t k, const Vec3& place,
                                                       const Points& points) {
  double* sum = &moments[sums * k];
  std::fill_n(sum, sums, 0.0);
  parts[k].clear();
  for (const Near& entry : near[k]) {
    const Vec3 d = 1 / radius[k] * (reflected(points.position[entry.point], entry.mask) - place);
    if (!(dot(d, d) < 1)) continue;
    const double phi = Kernel::value(d[0], d[1], d[2]);
    parts[k].push_back({entry, d, phi});
    sum[0] += phi;
    for (int c = 0; c < 3; ++c) sum[1 + c] += phi * d[c];
    for (int c = 0; c < 3; ++c) sum[4 + c] += phi * d[c] * d[c];
    sum[7] += phi * d[0] * d[1], sum[8] += phi * d[1] * d[2], sum[9] += phi * d[0] * d[2];
  }
}

template<class Kernel> [[gnu::noinline]] void PointInterpolation::set_weights(std::size_t k) {
  const double* sum = &moments[sums * k];
  const double bulk = Kernel::second_moment * sum[0];
  const Vec3 mean = 1 / sum[0] * Vec3{sum[1], sum[2], sum[3]};
  Sym3 second = {sum[4], sum[5], sum[6], sum[7], sum[8], sum[9]};
  second -= sum[0] * Sym3{mean[0] * mean[0], mean[1] * mean[1], mean[2] * mean[2],
                          mean[0] * mean[1], mean[1] * mean[2], mean[0] * mean[2]};
  const double det = determinant(second);
  holds[k] = sum[0] > 0 && det > singular_fraction * bulk * bulk * bulk;
  sizes[k] = 0;
  if (!holds[k]) return;
  const Vec3 slope = times(inverse(second, det), mean);
  for (Part& part : parts[k]) {
    part.weight *= 1 / sum[0] - dot(slope, part.at - mean);
    sizes[k] += std::abs(part.weight);
  }
}

[[gnu::noinline]] Vec3 PointInterpolation::value_at(std::size_t k, const VectorField& field) const {
  Vec3 sum{};
  for (const Part& part : parts[k]) sum += part.weight * reflected(field[part.of.point], part.of.mask);
  return sum;
}

template<class Kernel>
void PointInterpolation::evaluate_with(const VectorField& places, const Points& points) {
  for_each_index(near.size(), [&](std::size_t k) { add_moments<Kernel>(k, places[k], points); });
  ranks.sum(moments);
  for_each_index(near.size(), [&](std::size_t k) { set_weights<Kernel>(k); });
  ranks.sum(sizes);
  for (std::size_t k = 0; k < near.size(); ++k) {
    holds[k] = holds[k] && sizes[k] < largest_sum;
    if (!holds[k]) sizes[k] = 0, parts[k].clear();
  }
}

void PointInterpolation::evaluate(const VectorField& places, const Points& points) {
  const bool old =
      std::any_of(radius.begin(), radius.end(), [&](double r) { return travelled > margin * r; });
  if (!known || old) find_near(places, points);
  if (profile == Profile::cubic_spline)
    evaluate_with<Ball<CubicSpline>>(places, points);
  else
    evaluate_with<Ball<WendlandC4>>(places, points);
}

void PointInterpolation::interpolate(const VectorField& field, std::vector<Vec3>& at_places) const {
  std::vector<double> values(3 * near.size());
  for_each_index(near.size(), [&](std::size_t k) {
    const Vec3 value = value_at(k, field);
    for (int c = 0; c < 3; ++c) values[3 * k + c] = value[c];
  });
  ranks.sum(values);
  at_places.resize(near.size());
  for (std::size_t k = 0; k < near.size(); ++k)
    at_places[k] = {values[3 * k], values[3 * k + 1], values[3 * k + 2]};
}

void PointInterpolation::distribute(const std::vector<Vec3>& at_places, VectorField& force) const {
  for (std::size_t k = 0; k < near.size(); ++k)
    for (const Part& part : parts[k])
      force.add(part.of.point, part.weight * reflected(at_places[k], part.of.mask));
}

double PointInterpolation::stiffness_over_mass(const std::vector<double>& stiffness,
                                               const std::vector<double>& mass) const {
  std::vector<double> rows(mass.size());
  for (std::size_t k = 0; k < near.size(); ++k)
    for (const Part& part : parts[k]) rows[part.of.point] += stiffness[k] * sizes[k] * std::abs(part.weight);
  double largest = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) largest = std::max(largest, rows[i] / mass[i]);
  return ranks.max(largest);
}

} // namespace spall
