#pragma once

#include "macro/approximation/approximation.h"
#include "macro/approximation/reproducing_kernel.h"
#include "macro/integration/conforming_cells.h"
#include "macro/integration/integration.h"
#include "macro/points/lanes.h"
#include "macro/points/neighbor_search.h"

#include <cstdint>
#include <string>
#include <vector>

namespace spall {

/// Gradient operators of the points of one block (consecutive points, compact in space): G_J of each point's
/// neighbours J, 1/m, so that sum_J G_J f_J is the gradient of f with respect to the positions at the last
/// refresh. A pair is a point and one of its neighbours; pairs are stored in compressed rows (CSR), one row
/// per point.
///
/// The record of a pair is three SIMD vectors, for x, y and z, each with one number per gradient operator
/// (`layout.width` of them, see OperatorLayout). With one operator the record is one vector {G_x, G_y, G_z,
/// 0} instead. Around the axis the images of a ring are joined to one neighbour (join_images).
template<class T> struct GradientOperators {
  std::size_t begin = 0, end = 0;     ///< the block's points
  OperatorLayout layout;              ///< layout of the records
  bool rings = false;                 ///< whether the neighbours are rings around the axis (RingRecord)
  std::vector<std::uint32_t> stencil; ///< all neighbours of the block's points, ascending; ghosts included
  std::vector<std::uint32_t> start;   ///< CSR offsets, one per point and the end
  std::vector<std::uint16_t> column;  ///< for each pair the position of its neighbour in `stencil`
  /// Records of width 1, 1 per pair, or of width 4, 3 per pair; and `slack`.
  std::vector<Lanes<T>> record;
  std::vector<Lanes<T, 8>> wide;        ///< records of width 8, 3 per pair; and `slack`
  std::vector<std::uint8_t> at_surface; ///< for each point: whether its neighbours lie to one side
  std::size_t regularized = 0;          ///< number of points whose neighbours do not resolve the basis
  std::size_t isolated = 0; ///< points with fewer than `fewest_neighbors` others: no gradient, free flight
  double smallest_fraction = 1; ///< smallest determinant of the moments at the points over that in the bulk

  /// Bytes after the last record, which loops over the pairs may read: they fill whole registers.
  static constexpr std::size_t slack = 64;

  /// Records of Width operators (4, 8; 1 has the type of 4).
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
  /// Component c of operator m for pair p, 1/m; not of rings.
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
  /// Transfers the operators, which cannot be computed again, because the positions at the last refresh are
  /// not stored. `stencil` is left out, since it depends on the places of the points in the arrays of a rank.
  void transfer(Archive& archive) {
    archive("rows_start", start);
    archive("rows_column", column);
    archive("rows_record", record);
    archive("rows_wide", wide);
    archive("rows_layout", layout);
    archive("rows_rings", rings);
    archive("rows_at_surface", at_surface);
    archive("rows_regularized", regularized);
    archive("rows_isolated", isolated);
    archive("rows_smallest_fraction", smallest_fraction);
  }
  /// Replaces `stencil` by the places that its points have now, given in the order of `stencil`.
  void relocate(const std::vector<std::uint32_t>& places);
  std::size_t memory_bytes() const {
    return sizeof(*this) + 4 * (stencil.capacity() + start.capacity()) + 2 * column.capacity() +
           at_surface.capacity() + sizeof(Lanes<T>) * record.capacity() +
           sizeof(Lanes<T, 8>) * wide.capacity();
  }
};

/// A cloud with fewer other points than this has no volume.
inline constexpr std::size_t fewest_neighbors = 4;

/// Working memory of build_gradient_operators, one per thread.
template<class T> struct OperatorScratch {
  Cloud<T> cloud;
  /// x, y, z of each gradient operator for the cloud's points.
  std::array<std::array<std::vector<T>, 3>, 8> operators;
  std::vector<T> plus, minus;             ///< shape functions at two faces
  std::array<std::vector<T>, 3> gradient; ///< gradient at the node
  std::vector<Lanes<T>> record;           ///< records of the pairs so far, as in GradientOperators
  std::vector<Lanes<T, 8>> wide;          ///< records of width 8
  std::vector<std::uint32_t> active;      ///< points of the cloud that some operator acts on
  std::vector<std::uint32_t> neighbor;    ///< global index of the neighbour of each pair so far
  std::vector<std::uint32_t> stencil;     ///< stencil of the block
  std::vector<std::uint16_t> column;      ///< position of each pair's neighbour in `stencil`
  std::vector<std::uint32_t> slot;        ///< global index -> position in `stencil`
  std::vector<std::uint32_t> seen;        ///< global index -> mark of the last block with the point
  std::uint32_t mark = 0;
};

/// The inputs from which the gradient operators of a block are computed.
struct OperatorInputs {
  const Points& points;
  const NeighborSearch& search;         ///< search over all points, ghosts included
  const std::vector<Support>& supports; ///< one per point of the block
  const ApproximationInputs& approximation;
  const IntegrationInputs& integration;
  const ConformingCells* cells = nullptr; ///< cells of all of this rank's points, for conforming schemes
};

/// Builds the gradient operators of points [operators.begin, operators.end) from their neighbours in the
/// present configuration.
/// @return reason of a failure; empty if there is none
template<class T>
[[nodiscard]] std::string build_gradient_operators(GradientOperators<T>& operators,
                                                   const OperatorInputs& inputs, OperatorScratch<T>& scratch);

/// Turns the gradients at the last refresh into those with respect to positions deformed by relative[i]
/// since, grad_x = f^-T grad_X: the Lagrangian configuration keeps its shape functions (paper Eq. 7).
template<class T> void push_forward(GradientOperators<T>& operators, const std::vector<Mat3>& relative);

} // namespace spall
