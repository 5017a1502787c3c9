#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace spall {

/// Mirror images of the modelled part, as bits: the axes whose sign changes. Two in succession: a ^ b.
using Mirror = std::uint8_t;

/// Clusters of points of the whole body, found among the modelled ones: each point belongs to its cluster
/// with a mirror image, and a cluster that meets its own image is the same as it.
class Clusters {
public:
  explicit Clusters(std::size_t points) : parent(points), image(points, 0), own(points, 1) {
    std::iota(parent.begin(), parent.end(), 0u);
  }

  struct Place {
    std::uint32_t root;
    Mirror image; ///< mirror image of the point that belongs to the root's cluster
  };
  Place find(std::uint32_t i) {
    Place p{i, 0};
    while (parent[p.root] != p.root) {
      // Path halving: each node on the path is linked to its grandparent.
      const std::uint32_t next = parent[p.root];
      image[p.root] ^= image[next];
      parent[p.root] = parent[next];
      p.image ^= image[p.root];
      p.root = parent[p.root];
    }
    return p;
  }

  /// Point i and the mirror image m of point j are connected.
  void connect(std::uint32_t i, std::uint32_t j, Mirror m) {
    Place a = find(i), b = find(j);
    const Mirror between = a.image ^ b.image ^ m;
    if (a.root == b.root) {
      if (between != 0) own[a.root] = product(own[a.root], 1u | 1u << between);
      return;
    }
    if (b.root < a.root) std::swap(a, b);
    parent[b.root] = a.root;
    image[b.root] = between;
    own[a.root] = product(own[a.root], own[b.root]);
  }

  /// Returns the images that are the same cluster as a bit set, with one bit per image.
  std::uint8_t same(std::uint32_t root) const { return own[root]; }

private:
  static std::uint8_t product(std::uint8_t a, std::uint8_t b) {
    unsigned result = 0;
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 8; ++j)
        if ((a >> i & 1) && (b >> j & 1)) result |= 1u << (i ^ j);
    return static_cast<std::uint8_t>(result);
  }
  std::vector<std::uint32_t> parent;
  std::vector<Mirror> image;     ///< image of the point with respect to its parent
  std::vector<std::uint8_t> own; ///< for each root the images that are the same cluster
};

} // namespace spall
