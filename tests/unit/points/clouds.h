#pragma once

#include "macro/points/points.h"

#include <random>

namespace spall::test {

/// Makes points at given positions, with unit volume and mass.
inline Points points_at(const std::vector<Vec3>& positions, double spacing = 1) {
  Points points;
  points.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    points.position.set(i, positions[i]);
    points.spacing[i] = spacing;
    points.volume[i] = points.mass[i] = spacing * spacing * spacing;
  }
  points.initial_position = points.position;
  return points;
}

/// Returns the centres of the cells of an n x n x n lattice of edge `spacing` with its corner at the origin,
/// each moved by up to `jitter` spacings in every direction.
inline std::vector<Vec3> jittered_lattice(int n, double spacing, double jitter, unsigned seed = 1) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> move(-jitter, jitter);
  std::vector<Vec3> positions;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const double x = move(engine), y = move(engine), z = move(engine);
        positions.push_back({spacing * (i + 0.5 + x), spacing * (j + 0.5 + y), spacing * (k + 0.5 + z)});
      }
  return positions;
}

/// Returns random points, uniform in a box.
inline std::vector<Vec3> random_cloud(std::size_t n, const Vec3& low, const Vec3& high, unsigned seed = 1) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> part(0, 1);
  std::vector<Vec3> positions(n);
  for (Vec3& x : positions)
    for (int c = 0; c < 3; ++c) x[c] = low[c] + (high[c] - low[c]) * part(engine);
  return positions;
}

} // namespace spall::test
