#include "macro/shape/fill_revolution.h"

#include "macro/points/order.h"
#include "macro/shape/revolution.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spall {
namespace {

/// A ring of equal cells.
struct Ring {
  double z, radius; ///< of the points, m
  double volume;    ///< of the whole ring, m^3
  int around;       ///< points
};

int nearest_count(double length, double spacing) {
  return std::max(1, static_cast<int>(std::lround(length / spacing)));
}

/// The rings of the layer between a and b.
void add_layer(std::vector<Ring>& rings, const Revolution& body, double a, double b, int least,
               double spacing) {
  const double middle = 0.5 * (a + b), inner = body.inner(middle), wall = body.outer(middle) - inner;
  const int n = std::max(inner > 0 ? least : 1, nearest_count(wall, spacing));
  const auto boundary = [&](int j) {
    const double part = static_cast<double>(j) / n;
    return [&body, part](double z) { return (1 - part) * body.inner(z) + part * body.outer(z); };
  };
  for (int j = 0; j < n; ++j) {
    const MassProperties under = revolve(boundary(j), {a, b}), over = revolve(boundary(j + 1), {a, b});
    const double volume = over.volume - under.volume;
    // A solid body has nothing, and so no centre, under its first ring.
    const double below = under.volume > 0 ? under.volume * under.centre : 0;
    const double z = (over.volume * over.centre - below) / volume;
    const double radius = 0.5 * (boundary(j)(z) + boundary(j + 1)(z));
    rings.push_back({z, radius, volume, points_on_ring(radius, spacing)});
  }
}

/// A point's spacing is at least this part of the wanted one, so that thin cells at the tip or of a thin wall
/// reach the layers beside them.
constexpr double least_spacing = 0.75;

} // namespace

Points fill_revolution(const Revolution& body, int least_rings, double spacing, const SymmetryPlanes& planes,
                       double density) {
  std::vector<Ring> rings;
  for (std::size_t k = 0; k + 1 < body.kinks.size(); ++k) {
    const double from = body.kinks[k], length = body.kinks[k + 1] - from;
    const int layers = nearest_count(length, spacing);
    for (int i = 0; i < layers; ++i)
      add_layer(rings, body, from + length * i / layers, from + length * (i + 1) / layers, least_rings,
                spacing);
  }
  std::vector<Vec3> positions;
  std::vector<double> volumes, spacings;
  for (const Ring& ring : rings) {
    const int around = planes.axis ? 1 : ring.around;
    for (int j = 0; j < around; ++j) {
      const double angle = planes.axis ? 0 : 2 * std::numbers::pi * (j + 0.5) / ring.around;
      const Vec3 x = {ring.radius * std::cos(angle), ring.radius * std::sin(angle), ring.z};
      if ((planes.normal[0] && x[0] < 0) || (planes.normal[1] && x[1] < 0)) continue;
      positions.push_back(x);
      volumes.push_back(ring.volume / around);
      spacings.push_back(std::max(std::cbrt(ring.volume / ring.around), least_spacing * spacing));
    }
  }
  const auto order = hilbert_order(positions);
  Points points;
  points.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    points.position.set(i, positions[order[i]]);
    points.volume[i] = volumes[order[i]];
    points.mass[i] = density * points.volume[i];
    points.spacing[i] = spacings[order[i]];
  }
  points.initial_position = points.position;
  return points;
}

} // namespace spall
