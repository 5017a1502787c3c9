#pragma once

#include "macro/approximation/approximation.h"
#include "macro/approximation/reproducing_kernel.h"
#include "macro/integration/conforming_cells.h"
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
/// The record of a pair is three vectors, for x, y and z, of `layout.width` lanes; what a lane is says
/// LaneLayout. With one lane the record is one vector {G_x, G_y, G_z, 0} instead.
template<class T> struct GradientRows {
  std::size_t begin = 0, end = 0;       ///< the block's points
  LaneLayout layout;                    ///< of the records
  std::vector<std::uint32_t> touched;   ///< points in any row, ascending; ghosts included
  std::vector<std::uint32_t> start;     ///< CSR offsets, one per point and the end
  std::vector<std::uint16_t> column;    ///< position in `touched`
  std::vector<Lanes<T>> record;         ///< one lane: 1 per pair; four lanes: 3 per pair
  std::vector<Lanes<T, 8>> wide;        ///< eight lanes: 3 per pair
  std::vector<std::uint8_t> at_surface; ///< of the points: whether the cloud lies to one side
  std::size_t regularized = 0;          ///< points whose cloud cannot hold the basis
  std::size_t isolated = 0; ///< points with fewer than `fewest_neighbors` others: no gradient, free flight
  double smallest_fraction = 1; ///< of the determinant of the moments of the bulk, at the points

  /// Records of Width lanes (4, 8; 1 has the type of 4).
  template<int Width> const auto& records() const {
    if constexpr (Width == 8)
      return wide;
    else
      return record;
  }
  template<int Width> auto& records() {
    return const_cast<std::vector<Lanes<T, Width == 8 ? 8 : 4>>&>(
        std::as_const(*this).template records<Width>());
  }
  /// Lane m along direction c of the record of pair p.
  T entry(std::uint32_t p, int c, int m) const {
    return layout.width == 1 ? record[p][c] : layout.width == 4 ? record[3 * p + c][m] : wide[3 * p + c][m];
  }
  void add_to_entry(std::uint32_t p, int c, int m, T value) {
    if (layout.width == 1)
      record[p][c] += value;
    else if (layout.width == 4)
      record[3 * p + c][m] += value;
    else
      wide[3 * p + c][m] += value;
  }
  /// Between refreshes the rows belong to positions that are gone. Without `touched`, which depends on where
  /// the points are.
  void transfer(Archive& archive) {
    archive("rows_start", start);
    archive("rows_column", column);
    archive("rows_record", record);
    archive("rows_wide", wide);
    archive("rows_layout", layout);
    archive("rows_at_surface", at_surface);
    archive("rows_regularized", regularized);
    archive("rows_isolated", isolated);
    archive("rows_smallest_fraction", smallest_fraction);
  }
  /// Replaces `touched` by where those points are now, in any order.
  void touch(const std::vector<std::uint32_t>& places);
  std::size_t memory_bytes() const {
    return sizeof(*this) + 4 * (touched.capacity() + start.capacity()) + 2 * column.capacity() +
           at_surface.capacity() + sizeof(Lanes<T>) * record.capacity() +
           sizeof(Lanes<T, 8>) * wide.capacity();
  }
};

/// With fewer other points than this a cloud has no volume.
inline constexpr std::size_t fewest_neighbors = 4;

/// Working memory of build_rows, one per thread.
template<class T> struct RowScratch {
  Cloud<T> cloud;
  std::array<std::array<std::vector<T>, 3>, 8> lane; ///< x, y, z of each lane for the cloud's points
  std::vector<T> plus, minus;                        ///< shape functions at two faces
  std::array<std::vector<T>, 3> gradient;            ///< at the node
  std::vector<Lanes<T>> record;                      ///< of the rows so far, as in GradientRows
  std::vector<Lanes<T, 8>> wide;                     ///< the same
  std::vector<std::uint32_t> kept;                   ///< points of the cloud that some lane sees
  std::vector<std::uint32_t> neighbor;               ///< of the pairs so far, global index
  std::vector<std::uint32_t> touched;                ///< by the block
  std::vector<std::uint16_t> column;                 ///< of the pairs, in `touched`
  std::vector<std::uint32_t> slot,
      seen; ///< global index -> position in touched; mark of the last block there
  std::uint32_t mark = 0;
};

/// Builds the rows of points [rows.begin, rows.end). `supports` holds one support per point of the block;
/// `cells`: of the whole body, for conforming schemes.
template<class T>
void build_rows(GradientRows<T>& rows, const Points& points, const NeighborSearch& search,
                const std::vector<Support>& supports, const ApproximationInputs& approximation,
                const IntegrationInputs& integration, const ConformingCells* cells, RowScratch<T>& scratch);

/// Turns the gradients at the last refresh into those with respect to positions deformed by relative[i]
/// since: the Lagrangian configuration keeps its shape functions and never builds rows again.
template<class T> void push_forward(GradientRows<T>& rows, const std::vector<Mat3>& relative);

} // namespace spall
