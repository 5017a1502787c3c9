#pragma once

#include "macro/approximation/reproducing_kernel.h"
#include "macro/integration/integration.h"
#include "macro/points/lanes.h"
#include "macro/points/neighbor_search.h"

#include <cstdint>
#include <vector>

namespace spall {

/// Gradients of the shape functions at the points of one block (consecutive points, compact in space), as
/// sparse rows over the points they touch. Spatial gradients with respect to the positions at the last
/// refresh.
///
/// A stabilised record is three vectors of four lanes: record[i] = {G_i, D_1i, D_2i, D_3i}, i = x, y, z, with
/// G the gradient and D_k = d_k G / (a sqrt 12) its derivative along the k-th edge of the nodal cell,
/// weighted with the cell's second moment (edge 1/a in xi). A plain record is one vector {G_x, G_y, G_z, 0}.
template<class T> struct GradientRows {
  std::size_t begin = 0, end = 0;     ///< the block's points
  std::vector<std::uint32_t> touched; ///< points in any row, ascending; ghosts included
  std::vector<std::uint32_t> start;   ///< CSR offsets, one per point and the end
  std::vector<std::uint32_t> column;  ///< position in `touched`
  std::vector<Lanes<T>> record;       ///< 3 per pair if stabilised, else 1
  std::size_t regularized = 0;        ///< points whose cloud cannot hold the linear basis
  std::size_t isolated = 0; ///< points with fewer than `fewest_neighbors` others: no gradient, free flight

  std::size_t memory_bytes() const {
    return sizeof(*this) + 4 * (touched.capacity() + start.capacity() + column.capacity()) +
           sizeof(Lanes<T>) * record.capacity();
  }
};

/// With fewer other points than this a cloud has no volume.
inline constexpr std::size_t fewest_neighbors = 4;

/// Working memory of build_rows, one per thread.
template<class T> struct RowScratch {
  Cloud<T> cloud;
  std::array<std::vector<T>, 12> derivative; ///< G_xyz, D_1xyz, D_2xyz, D_3xyz of the cloud's points
  std::vector<std::array<T, 3>> smoothed;    ///< smoothed gradients of the cloud's points
  std::vector<std::uint32_t> slot,
      seen; ///< global index -> position in touched; mark of the last block there
  std::uint32_t mark = 0;
};

/// Builds the rows of points [rows.begin, rows.end) for a scheme. `supports` holds one support per point of
/// the block.
template<class T>
void build_rows(GradientRows<T>& rows, const Points& points, const NeighborSearch& search,
                const std::vector<Support>& supports, Scheme scheme, double normalized_size,
                RowScratch<T>& scratch);

} // namespace spall
