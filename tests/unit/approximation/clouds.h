#pragma once

#include "macro/approximation/reproducing_kernel.h"

#include <algorithm>
#include <random>
#include <string>

namespace spall::test {

/// A cloud in the unit ball and its name in messages.
template<class T> struct NamedCloud {
  std::string name;
  Cloud<T> cloud;
};

/// The part of space that has points: all of it, z >= 0, and so on.
enum class Part { bulk, face, edge, corner };

/// Makes a lattice of `spacing`, jittered by `jitter` spacings, mapped by `map` (a deformation that the
/// support does not follow), and cut to the part of space around the point at the origin and to the unit ball
/// (or the box around it).
template<class T>
Cloud<T> lattice_cloud(Part part, double spacing, double jitter, const Mat3& map, unsigned seed,
                       bool box = false) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> move(-jitter, jitter);
  Cloud<T> cloud;
  const int n = static_cast<int>(4 / spacing);
  std::uint32_t index = 0;
  for (int k = -n; k <= n; ++k)
    for (int j = -n; j <= n; ++j)
      for (int i = -n; i <= n; ++i) {
        if ((part >= Part::face && k < 0) || (part >= Part::edge && j < 0) || (part == Part::corner && i < 0))
          continue;
        const bool self = i == 0 && j == 0 && k == 0;
        double x[3] = {spacing * i, spacing * j, spacing * k}, y[3];
        for (double& c : x) c += self ? 0 : spacing * move(engine);
        for (int r = 0; r < 3; ++r) y[r] = map[3 * r] * x[0] + map[3 * r + 1] * x[1] + map[3 * r + 2] * x[2];
        const double size =
            box ? std::max({std::abs(y[0]), std::abs(y[1]), std::abs(y[2])}) : std::hypot(y[0], y[1], y[2]);
        if (size < 1) cloud.add(index++, T(y[0]), T(y[1]), T(y[2]));
      }
  return cloud;
}

/// Clouds that resolve the linear basis: in the bulk, on faces, edges and corners, jittered, random and
/// deformed.
template<class T> std::vector<NamedCloud<T>> sound_clouds(double spacing = 0.5) {
  constexpr Mat3 none = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  // The stretch and shear are larger than those between two refreshes.
  constexpr Mat3 deformed = {1.3, 0.2, 0, 0, 0.8, -0.1, 0.1, 0, 0.9};
  std::vector<NamedCloud<T>> clouds;
  const std::pair<Part, const char*> parts[] = {
      {Part::bulk, "bulk"}, {Part::face, "face"}, {Part::edge, "edge"}, {Part::corner, "corner"}};
  for (const auto& [part, name] : parts) {
    clouds.push_back({std::string(name) + ", regular", lattice_cloud<T>(part, spacing, 0, none, 1)});
    for (unsigned seed = 1; seed <= 3; ++seed) {
      clouds.push_back({std::string(name) + ", jittered", lattice_cloud<T>(part, spacing, 0.2, none, seed)});
      clouds.push_back(
          {std::string(name) + ", deformed", lattice_cloud<T>(part, 0.9 * spacing, 0.2, deformed, seed)});
    }
  }
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (int n = 0; n < 5; ++n) {
    Cloud<T> cloud;
    cloud.add(0, T(0), T(0), T(0));
    while (cloud.size() < 40) {
      const double x = coordinate(engine), y = coordinate(engine), z = coordinate(engine);
      if (x * x + y * y + z * z < 1) cloud.add(static_cast<std::uint32_t>(cloud.size()), T(x), T(y), T(z));
    }
    clouds.push_back({"random", cloud});
  }
  return clouds;
}

/// Clouds that do not resolve the linear basis: a single point, a line, a plane, a line nearly along an axis.
template<class T> std::vector<NamedCloud<T>> singular_clouds() {
  std::vector<NamedCloud<T>> clouds(4);
  clouds[0].name = "lone point";
  clouds[0].cloud.add(0, T(0), T(0), T(0));
  clouds[1].name = "line";
  clouds[2].name = "plane";
  clouds[3].name = "two points";
  clouds[3].cloud.add(0, T(0), T(0), T(0));
  clouds[3].cloud.add(1, T(0.3), T(-0.2), T(0.1));
  std::uint32_t index = 0;
  for (int i = -3; i <= 3; ++i) {
    clouds[1].cloud.add(index++, T(0.2 * i), T(0.15 * i), T(-0.1 * i));
    for (int j = -3; j <= 3; ++j) clouds[2].cloud.add(index++, T(0.2 * i), T(0.2 * j), T(0.1 * i - 0.05 * j));
  }
  return clouds;
}

/// Tolerance for the round-off of sums over a cloud: a few hundred units in the last place.
template<class T> constexpr double round_off = std::is_same_v<T, double> ? 1e-12 : 5e-5;

} // namespace spall::test
