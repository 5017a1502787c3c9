#pragma once

#include "tests/unit/points/clouds.h"

namespace spall::test {

/// Makes points whose first block has more neighbours than a block can have: each of its 128 points lies in a
/// separate crowd of 520 points. The points of the crowds have a tiny spacing, so that they have no
/// neighbours themselves.
inline Points crowded_points() {
  constexpr int sites = 128, crowd = 520;
  std::vector<Vec3> positions;
  const auto site = [](int k) { return Vec3{10. * (k % 8), 10. * (k / 8 % 4), 10. * (k / 32)}; };
  for (int k = 0; k < sites; ++k) positions.push_back(site(k));
  const std::vector<Vec3> offsets = random_cloud(sites * crowd, {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  for (int n = 0; n < sites * crowd; ++n) positions.push_back(site(n % sites) + offsets[n]);
  Points points = points_at(positions);
  for (std::size_t i = sites; i < points.owned; ++i) points.spacing[i] = 1e-6;
  return points;
}

} // namespace spall::test
