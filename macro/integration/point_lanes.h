#pragma once

#include "macro/integration/cell_samples.h"
#include "macro/integration/gradient_rows.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace spall {

/// How well the cloud of a point holds the basis.
struct Quality {
  double fraction = 1; ///< smallest determinant of the moments at the places used, as a part of the bulk's
  bool regularized = false;
};

/// The lanes of one point: the scheme applied to the cloud of a support, in the support's coordinates xi, in
/// which the nodal cell is the cube of edge 1 / normalised size. Basis: LinearBasis or another of its form.
///
/// Places at which the cloud cannot hold the basis lie outside the body (faces and samples of the cells at
/// edges, corners and fragments). There the cell ends at the node: the node's own value stands in. So the
/// gradients of every scheme are exact for linears wherever the node's own cloud holds them, and rigid
/// rotation strains no point.
template<class Basis, class T> class PointLanes {
public:
  PointLanes(const IntegrationInputs& integration, double normalized_size, RowScratch<T>& scratch_)
      : scheme(integration.scheme), axisymmetric(integration.axisymmetric), layout(lanes_of(integration)),
        samples(cell_samples(integration)), edge(T(1 / normalized_size)), scratch(scratch_) {}

  /// Fills scratch.lane for the points of scratch.cloud. `inverse`: of the support, to turn derivatives with
  /// respect to xi into those in space.
  /// `faces`: of the conforming cell, `volume` its volume, for the schemes that have one.
  Quality fill(const Mat3& inverse, std::span<const ConformingCells::Face> faces = {},
               double volume = 0) const {
    std::array<T, 9> to_xi;
    for (int k = 0; k < 9; ++k) to_xi[k] = static_cast<T>(inverse[k]);
    for (int m = 0; m < layout.width; ++m)
      for (auto& component : scratch.lane[m]) component.resize(scratch.cloud.size());
    Quality quality;
    switch (scheme) {
    case Scheme::dni:
      differentiate<false>(centre, 0, to_xi, quality);
      break;
    case Scheme::nsni:
      if constexpr (Basis::has_derivatives) differentiate<true>(centre, 0, to_xi, quality);
      // What is equal in turned directions varies over a cell in Cartesian ones; no strain does.
      if (axisymmetric)
        for (auto& component : scratch.lane[2]) std::fill(component.begin(), component.end(), T(0));
      break;
    case Scheme::snni:
      smooth(to_xi, quality);
      break;
    case Scheme::scni:
      smooth_conforming(inverse, faces, volume, quality);
      break;
    case Scheme::m_scni:
      sample(to_xi, quality);
      take_differences();
      smooth_conforming(inverse, faces, volume, quality);
      break;
    case Scheme::m_snni:
      sample(to_xi, quality);
      take_differences();
      smooth(to_xi, quality);
      break;
    case Scheme::subpoint:
      sample(to_xi, quality);
      break;
    }
    for (int m = layout.used; m < layout.width; ++m)
      for (auto& component : scratch.lane[m]) std::fill(component.begin(), component.end(), T(0));
    return quality;
  }

private:
  using Place = std::array<T, 3>;
  static constexpr Place centre{};

  template<bool Derivatives> auto evaluate(const Place& at, Quality& quality) const {
    const auto op = Basis::template evaluate<Derivatives>(scratch.cloud, at);
    if (!op.outside() || at == centre) {
      quality.fraction = std::min(quality.fraction, static_cast<double>(op.fraction()));
      quality.regularized |= op.lowered();
    }
    return op;
  }

  /// Gradient at a place into lane m, with Derivatives also its change over the cell into lanes 1-3: the
  /// second moment of the cube is edge^2 / 12 per axis and volume.
  template<bool Derivatives>
  void differentiate(const Place& at, int m, const std::array<T, 9>& to_xi, Quality& quality) const {
    auto op = evaluate<Derivatives>(at, quality);
    if (op.outside() && at != centre) op = evaluate<Derivatives>(centre, quality);
    std::array<T*, 12> out{};
    for (int k = 0; k < (Derivatives ? 12 : 3); ++k) out[k] = scratch.lane[m + k / 3][k % 3].data();
    op.template differentiate<Derivatives>(scratch.cloud, to_xi, edge / T(std::sqrt(12.0)), out);
  }

  /// Gradients at the samples into lanes 0 .. K-1.
  void sample(const std::array<T, 9>& to_xi, Quality& quality) const {
    for (int k = 0; k < samples.count; ++k) {
      Place at;
      for (int c = 0; c < 3; ++c) at[c] = edge * T(samples.offset[k][c]);
      differentiate<false>(at, k, to_xi, quality);
    }
  }

  /// Turns K gradients into their K - 1 independent differences, lanes 1 .. K-1: with the orthonormal
  /// contrasts of Helmert, sum_k (1 / K) |G_k - mean|^2 = sum_m |D_m|^2 for any field. Eq. 11 takes the
  /// smoothed gradient for the mean; the difference of the two, of third order in the spacing, is left out.
  void take_differences() const {
    for (int c = 0; c < 3; ++c) {
      T* sum = scratch.lane[0][c].data();
      for (int m = 1; m < samples.count; ++m) {
        T* g = scratch.lane[m][c].data();
        const T scale = T(1 / std::sqrt(m * (m + 1.0) * samples.count));
        for (std::size_t j = 0; j < scratch.cloud.size(); ++j) {
          const T own = g[j];
          g[j] = scale * (sum[j] - T(m) * own);
          sum[j] += own;
        }
      }
    }
  }

  /// Smoothed gradient (paper Eq. 10) into lane 0, one point per face. Face normals are the axes of xi, so
  /// that along axis k it is (Psi(ahead) - Psi(behind)) / distance.
  void smooth(const std::array<T, 9>& to_xi, Quality& quality) const {
    const std::size_t n = scratch.cloud.size();
    auto& lane = scratch.lane[0];
    for (auto& component : lane) std::fill(component.begin(), component.end(), T(0));
    for (int k = 0; k < 3; ++k) {
      const T ahead = shape_functions_on_face(k, edge / 2, scratch.plus, quality),
              behind = shape_functions_on_face(k, -edge / 2, scratch.minus, quality);
      if (ahead + behind == 0) { // no room for a cell along this axis
        differentiate<false>(centre, 0, to_xi, quality);
        return;
      }
      for (int i = 0; i < 3; ++i) {
        const T scale = to_xi[3 * k + i] / (ahead + behind);
#pragma omp simd
        for (std::size_t j = 0; j < n; ++j) lane[i][j] += scale * (scratch.plus[j] - scratch.minus[j]);
      }
    }
  }

  /// Shape functions at the centre of a face of the cell, or at the node. @return distance from the node.
  T shape_functions_on_face(int axis, T offset, std::vector<T>& psi, Quality& quality) const {
    psi.resize(scratch.cloud.size());
    Place at{};
    at[axis] = offset;
    auto op = evaluate<false>(at, quality);
    const bool outside = op.outside();
    if (outside) op = evaluate<false>(centre, quality);
    op.values(scratch.cloud, psi.data());
    return outside ? 0 : std::abs(offset);
  }

  /// Smoothed gradient over a conforming cell: sum over its faces of area times shape function / volume. A
  /// face at which the cloud cannot hold the basis (at edges and corners of the body) takes what the node has
  /// there by linear extrapolation.
  void smooth_conforming(const Mat3& inverse, std::span<const ConformingCells::Face> faces, double volume,
                         Quality& quality) const {
    const std::size_t n = scratch.cloud.size();
    auto& lane = scratch.lane[0];
    for (auto& component : lane) std::fill(component.begin(), component.end(), T(0));
    Mat3 extrapolated{}; // sum of area (x) centre over those faces
    Vec3 constant{};     // sum of their areas
    std::vector<T>& psi = scratch.plus;
    psi.resize(n);
    for (const ConformingCells::Face& face : faces) {
      Place at;
      for (int c = 0; c < 3; ++c)
        at[c] = T(inverse[3 * c] * face.centre[0] + inverse[3 * c + 1] * face.centre[1] +
                  inverse[3 * c + 2] * face.centre[2]);
      const auto op = evaluate<false>(at, quality);
      if (op.outside()) {
        for (int c = 0; c < 9; ++c) extrapolated[c] += face.area[c / 3] * face.centre[c % 3] / volume;
        for (int c = 0; c < 3; ++c) constant[c] += face.area[c] / volume;
        continue;
      }
      op.values(scratch.cloud, psi.data());
      add_to_lane(psi, {T(face.area[0] / volume), T(face.area[1] / volume), T(face.area[2] / volume)});
    }
    if (extrapolated == Mat3{}) return;
    const auto op = evaluate<false>(centre, quality);
    op.values(scratch.cloud, psi.data());
    add_to_lane(psi, {T(constant[0]), T(constant[1]), T(constant[2])});
    std::array<T*, 12> out{};
    for (int k = 0; k < 3; ++k) {
      scratch.gradient[k].resize(n);
      out[k] = scratch.gradient[k].data();
    }
    std::array<T, 9> to_xi;
    for (int k = 0; k < 9; ++k) to_xi[k] = static_cast<T>(inverse[k]);
    op.template differentiate<false>(scratch.cloud, to_xi, T(1), out);
    for (int k = 0; k < 3; ++k)
      add_to_lane(scratch.gradient[k], {T(extrapolated[k]), T(extrapolated[3 + k]), T(extrapolated[6 + k])});
  }
  /// lane 0 += weight (x) values.
  void add_to_lane(const std::vector<T>& values, const std::array<T, 3>& weight) const {
    for (int c = 0; c < 3; ++c) {
      T* sum = scratch.lane[0][c].data();
#pragma omp simd
      for (std::size_t j = 0; j < values.size(); ++j) sum[j] += weight[c] * values[j];
    }
  }

  Scheme scheme;
  bool axisymmetric;
  LaneLayout layout;
  CellSamples samples;
  T edge; ///< of the nodal cell in xi
  RowScratch<T>& scratch;
};

} // namespace spall
