#include "macro/shape/fill_revolution.h"

#include "macro/shape/cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spall {
namespace {

/// A ring of equal cells.
struct Ring {
  double z, radius;   ///< of the points, m
  double volume;      ///< of the whole ring, m^3
  int around;         ///< points
  std::uint8_t faces; ///< bits of Face
};

/// Where layers begin: the kinks without those that would make layers much thinner than the others.
std::vector<double> layer_ends(const std::vector<double>& kinks, double spacing) {
  std::vector<double> ends = {kinks.front()};
  for (std::size_t k = 1; k + 1 < kinks.size(); ++k)
    if (kinks[k] - ends.back() > 0.25 * spacing && kinks.back() - kinks[k] > 0.25 * spacing)
      ends.push_back(kinks[k]);
  ends.push_back(kinks.back());
  return ends;
}

/// From a to b, with the places between them where the radii are not smooth.
std::vector<double> breaks_between(const Sections& body, double a, double b) {
  std::vector<double> breaks = {a};
  for (const std::vector<double>* places : {&body.kinks, &body.breaks})
    for (const double z : *places)
      if (z > a + 1e-9 * (b - a) && z < b - 1e-9 * (b - a)) breaks.push_back(z);
  breaks.push_back(b);
  std::sort(breaks.begin(), breaks.end());
  return breaks;
}

/// The rings of the layer between a and b, with at least so many through the wall of a hollow body.
void add_layer(std::vector<Ring>& rings, const Sections& body, double a, double b, int least, double spacing,
               int end_faces) {
  const std::vector<double> breaks = breaks_between(body, a, b);
  const double middle = 0.5 * (a + b), inner = body.inner(middle), wall = body.outer(middle) - inner;
  const int n = std::max(inner > 0 ? least : 1, nearest_count(wall, spacing));
  const auto boundary = [&](int j) {
    const double part = static_cast<double>(j) / n;
    return [&body, part](double z) { return (1 - part) * body.inner(z) + part * body.outer(z); };
  };
  for (int j = 0; j < n; ++j) {
    const MassProperties under = revolve(boundary(j), breaks), over = revolve(boundary(j + 1), breaks);
    const double volume = over.volume - under.volume;
    // A solid body has nothing, and so no centre, under its first ring.
    const double below = under.volume > 0 ? under.volume * under.centre[2] : 0;
    const double z = (over.volume * over.centre[2] - below) / volume;
    const double radius = 0.5 * (boundary(j)(z) + boundary(j + 1)(z));
    const int faces = end_faces | (j + 1 == n ? rim_face : 0);
    rings.push_back({z, radius, volume, points_on_ring(radius, spacing), static_cast<std::uint8_t>(faces)});
  }
}

/// A point's spacing is at least this part of the wanted one, so that thin cells at the tip or of a thin wall
/// reach the layers beside them.
constexpr double least_spacing = 0.75;

} // namespace

Points fill_revolution(const Sections& body, int least_rings, double spacing, const SymmetryPlanes& planes,
                       double density) {
  std::vector<Ring> rings;
  const std::vector<double> ends = layer_ends(body.kinks, spacing);
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const double from = ends[k], length = ends[k + 1] - from;
    const int layers = nearest_count(length, spacing);
    for (int i = 0; i < layers; ++i) {
      const bool lowest = k == 0 && i == 0, highest = k + 2 == ends.size() && i + 1 == layers;
      add_layer(rings, body, from + length * i / layers, from + length * (i + 1) / layers, least_rings,
                spacing, (lowest ? low_face : 0) | (highest ? high_face : 0));
    }
  }
  std::vector<Vec3> positions;
  std::vector<Cell> cells;
  for (const Ring& ring : rings) {
    const int around = planes.axis ? 1 : ring.around;
    for (int j = 0; j < around; ++j) {
      const double angle = planes.axis ? 0 : 2 * std::numbers::pi * (j + 0.5) / ring.around;
      const Vec3 x = {ring.radius * std::cos(angle), ring.radius * std::sin(angle), ring.z};
      if (!is_modelled(planes, x[0], x[1])) continue;
      positions.push_back(x);
      cells.push_back({.volume = ring.volume / around,
                       .spacing = std::max(std::cbrt(ring.volume / ring.around), least_spacing * spacing),
                       .faces = ring.faces});
    }
  }
  return points_of(positions, cells, density, 0.5);
}

} // namespace spall
