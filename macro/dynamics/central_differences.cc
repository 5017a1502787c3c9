#include "macro/dynamics/central_differences.h"

#include "macro/points/parallel.h"
#include "macro/solid/solid.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace spall {
namespace {

constexpr std::size_t chunk_size = 1024;

std::size_t chunk_count(std::size_t points) { return (points + chunk_size - 1) / chunk_size; }

/// Calls part(begin, end) for chunks of the points.
template<class Part> void for_each_chunk(std::size_t count, const Part& part) {
  for_each_index(chunk_count(count),
                 [&](std::size_t p) { part(p * chunk_size, std::min(count, (p + 1) * chunk_size)); });
}

} // namespace

MotionSums motion_sums(const Points& points) {
  std::vector<MotionSums> parts(chunk_count(points.owned));
  for_each_chunk(points.owned, [&](std::size_t begin, std::size_t end) {
    MotionSums& part = parts[begin / chunk_size];
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 v = points.velocity[i];
      part.kinetic += 0.5 * points.mass[i] * dot(v, v);
      part.momentum += points.mass[i] * v[2];
    }
  });
  MotionSums sum;
  for (const MotionSums& part : parts) sum.kinetic += part.kinetic, sum.momentum += part.momentum;
  return sum;
}

double CentralDifferences::add_memory(Points& points, double duration) {
  if (!has_memory) last_force = points.force, has_memory = true;
  std::vector<double> parts(chunk_count(points.owned));
  for_each_chunk(points.owned, [&](std::size_t begin, std::size_t end) {
    double work = 0;
    for (int c = 0; c < 3; ++c)
      for (std::size_t i = begin; i < end; ++i) {
        const double force = points.force.component[c][i];
        const double more = extra * (force - last_force.component[c][i]), all = force + more;
        last_force.component[c][i] = force;
        points.force.component[c][i] = all;
        work += duration * more * (points.velocity.component[c][i] + 0.5 * duration / points.mass[i] * all);
      }
    parts[begin / chunk_size] = work;
  });
  return -std::accumulate(parts.begin(), parts.end(), 0.0);
}

double CentralDifferences::kick(Points& points, double duration) {
  const double taken = extra > 0 ? add_memory(points, duration) : 0;
  for_each_chunk(points.owned, [&](std::size_t begin, std::size_t end) {
    for (int c = 0; c < 3; ++c)
      for (std::size_t i = begin; i < end; ++i)
        points.velocity.component[c][i] += duration / points.mass[i] * points.force.component[c][i];
  });
  return taken;
}

void CentralDifferences::drift(Points& points, double dt) {
  for_each_chunk(points.owned, [&](std::size_t begin, std::size_t end) {
    for (int c = 0; c < 3; ++c)
      for (std::size_t i = begin; i < end; ++i)
        points.position.component[c][i] += dt * points.velocity.component[c][i];
  });
}

void CentralDifferences::transfer(Archive& archive, const std::string& name, std::size_t owned,
                                  std::size_t block_size) {
  archive("has_memory", has_memory);
  if (!has_memory) return;
  last_force.resize(owned);
  archive.pieces(name + "_last_force", (owned + block_size - 1) / block_size,
                 [&](std::size_t b, Archive& piece) {
                   Slice part(piece, b * block_size, std::min(owned, (b + 1) * block_size), owned);
                   last_force.transfer(part, "last_force", owned);
                 });
}

} // namespace spall
