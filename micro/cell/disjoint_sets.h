#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace spall {

/// Sets that only ever merge (union-find); the smallest member stands for its set.
class DisjointSets {
public:
  explicit DisjointSets(std::size_t count) : parent(count) {
    std::iota(parent.begin(), parent.end(), std::size_t(0));
  }
  std::size_t operator()(std::size_t i) const {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  /// False if they were one set already.
  bool join(std::size_t a, std::size_t b) {
    a = (*this)(a);
    b = (*this)(b);
    parent[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

private:
  mutable std::vector<std::size_t> parent; ///< paths get shorter while they are followed
};

} // namespace spall
