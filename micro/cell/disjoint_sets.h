#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace spall {

/// Disjoint sets of the numbers below `count` (union-find): sets can be merged, never split. The smallest
/// member represents its set.
class DisjointSets {
public:
  explicit DisjointSets(std::size_t count) : parent(count) {
    std::iota(parent.begin(), parent.end(), std::size_t(0));
  }
  /// Returns the representative of the set that `i` belongs to.
  std::size_t operator()(std::size_t i) const {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  /// Merges the sets of `a` and `b`. @return false if they were the same set already
  bool join(std::size_t a, std::size_t b) {
    a = (*this)(a);
    b = (*this)(b);
    parent[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

private:
  /// Parent of each number in its tree; a search halves the path that it follows.
  mutable std::vector<std::size_t> parent;
};

} // namespace spall
