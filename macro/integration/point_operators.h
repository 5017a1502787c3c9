#pragma once

#include "macro/integration/cell_samples.h"
#include "macro/integration/gradient_operators.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace spall {

/// Quality of the cloud of a point: how well it resolves the basis.
struct Quality {
  double fraction = 1; ///< smallest determinant of the moments at the places used, as a part of the bulk's
  bool regularized = false;
};

/// The gradient operators of one point: the scheme applied to the cloud of a support, in the support's
/// coordinates xi, in which the nodal cell is the cube of edge 1 / normalised size. Basis: LinearBasis or
/// another of its form.
/// Places at which the cloud does not resolve the basis lie outside the body (faces and samples of the cells
/// at edges, corners and fragments). There the cell ends at the node, and the node's own value is used. So
/// the gradients of every scheme are exact for linear fields wherever the node's own cloud resolves them, and
/// a rigid rotation causes no strain.
template<class Basis, class T> class PointOperators {
public:
  PointOperators(const IntegrationInputs& integration, double normalized_size, OperatorScratch<T>& scratch_)
      : scheme(integration.scheme), axisymmetric(integration.axisymmetric), layout(layout_of(integration)),
        samples(cell_samples(integration)), edge(T(1 / normalized_size)), scratch(scratch_) {}

  /// Fills scratch.operators for the points of scratch.cloud.
  /// @param inverse of the support's matrix, 1/m: it turns derivatives with respect to xi into those in space
  /// @param faces of the conforming cell, for the schemes that have one
  /// @param volume of that cell, m^3
  Quality fill(const Mat3& inverse, std::span<const ConformingCells::Face> faces = {},
               double volume = 0) const {
    const Mat<T> to_xi = convert<T>(inverse);
    for (int m = 0; m < layout.width; ++m)
      for (auto& component : scratch.operators[m]) hold(component, scratch.cloud.size());
    Quality quality;
    switch (scheme) {
    case Scheme::dni:
      differentiate<false>(centre, 0, to_xi, quality);
      break;
    case Scheme::nsni:
      if constexpr (Basis::has_derivatives) differentiate<true>(centre, 0, to_xi, quality);
      // Around the axis the strain of an axisymmetric motion is constant in rotated axes; only its Cartesian
      // components vary. So the derivative of the strain along y is zero.
      if (axisymmetric) set_zero(2);
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
    for (int m = layout.count; m < layout.width; ++m) set_zero(m);
    return quality;
  }

private:
  using Place = Vec<T>;
  static constexpr Place centre{};

  void set_zero(int m) const {
    for (auto& component : scratch.operators[m]) std::fill_n(component.begin(), scratch.cloud.size(), T(0));
  }

  template<bool Derivatives> auto evaluate(const Place& at, Quality& quality) const {
    const auto op = Basis::template evaluate<Derivatives>(scratch.cloud, at);
    if (!op.outside() || at == centre) {
      quality.fraction = std::min(quality.fraction, static_cast<double>(op.fraction()));
      quality.regularized |= op.lowered();
    }
    return op;
  }

  /// Operator m becomes the gradient at a place; with Derivatives operators 1 to 3 become its change over the
  /// cell: the second moment of the cube is edge^2 / 12 per axis and volume.
  template<bool Derivatives>
  void differentiate(const Place& at, int m, const Mat<T>& to_xi, Quality& quality) const {
    auto op = evaluate<Derivatives>(at, quality);
    if (op.outside() && at != centre) op = evaluate<Derivatives>(centre, quality);
    std::array<T*, 12> out{};
    for (int k = 0; k < (Derivatives ? 12 : 3); ++k) out[k] = scratch.operators[m + k / 3][k % 3].data();
    op.template differentiate<Derivatives>(scratch.cloud, to_xi, edge / T(std::sqrt(12.0)), out);
  }

  /// Operators 0 to K - 1 become the gradients at the samples.
  void sample(const Mat<T>& to_xi, Quality& quality) const {
    for (int k = 0; k < samples.count; ++k)
      differentiate<false>(edge * convert<T>(samples.offset[k]), k, to_xi, quality);
  }

  /// Turns K gradients into their K - 1 independent differences, operators 1 to K - 1: with the orthonormal
  /// contrasts of Helmert, sum_k (1 / K) |G_k - mean|^2 = sum_m |D_m|^2 for any field. Eq. 11 takes the
  /// smoothed gradient for the mean; the difference of the two, of third order in the spacing, is left out.
  void take_differences() const {
    for (int c = 0; c < 3; ++c) {
      T* sum = scratch.operators[0][c].data();
      for (int m = 1; m < samples.count; ++m) {
        T* g = scratch.operators[m][c].data();
        const T scale = T(1 / std::sqrt(m * (m + 1.0) * samples.count));
        for (std::size_t j = 0; j < scratch.cloud.size(); ++j) {
          const T own = g[j];
          g[j] = scale * (sum[j] - T(m) * own);
          sum[j] += own;
        }
      }
    }
  }

  /// Operator 0 becomes the smoothed gradient (paper Eq. 10), one point per face. Face normals are the axes
  /// of xi, so that along axis k it is (Psi(ahead) - Psi(behind)) / distance.
  void smooth(const Mat<T>& to_xi, Quality& quality) const {
    const std::size_t n = scratch.cloud.size();
    auto& smoothed = scratch.operators[0];
    set_zero(0);
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
        for (std::size_t j = 0; j < n; ++j) smoothed[i][j] += scale * (scratch.plus[j] - scratch.minus[j]);
      }
    }
  }

  /// Shape functions at the centre of a face of the cell, or at the node. @return distance from the node.
  T shape_functions_on_face(int axis, T offset, std::vector<T>& psi, Quality& quality) const {
    hold(psi, scratch.cloud.size());
    Place at{};
    at[axis] = offset;
    auto op = evaluate<false>(at, quality);
    const bool outside = op.outside();
    if (outside) op = evaluate<false>(centre, quality);
    op.values(scratch.cloud, psi.data());
    return outside ? 0 : std::abs(offset);
  }

  /// Operator 0 becomes the smoothed gradient over a conforming cell: the sum over its faces of area times
  /// shape function, over the volume. A face at which the cloud does not resolve the basis (at edges and
  /// corners of the body) takes what the node has there by linear extrapolation.
  void smooth_conforming(const Mat3& inverse, std::span<const ConformingCells::Face> faces, double volume,
                         Quality& quality) const {
    set_zero(0);
    Mat3 extrapolated{}; // sum of area (x) centre over those faces, per volume
    Vec3 constant{};     // sum of their areas, per volume
    std::vector<T>& psi = scratch.plus;
    hold(psi, scratch.cloud.size());
    for (const ConformingCells::Face& face : faces) {
      const auto op = evaluate<false>(convert<T>(times(inverse, face.centre)), quality);
      if (op.outside()) {
        extrapolated += outer(face.area, face.centre) / volume;
        constant += face.area / volume;
        continue;
      }
      op.values(scratch.cloud, psi.data());
      add_to_smoothed(psi, convert<T>(face.area / volume));
    }
    if (extrapolated != Mat3{}) add_extrapolated(constant, extrapolated, convert<T>(inverse), quality);
  }

  /// Adds constant Psi + extrapolated grad Psi with the node's own shape functions to operator 0.
  void add_extrapolated(const Vec3& constant, const Mat3& extrapolated, const Mat<T>& to_xi,
                        Quality& quality) const {
    std::vector<T>& psi = scratch.plus;
    const auto op = evaluate<false>(centre, quality);
    op.values(scratch.cloud, psi.data());
    add_to_smoothed(psi, convert<T>(constant));
    std::array<T*, 12> out{};
    for (int k = 0; k < 3; ++k) {
      hold(scratch.gradient[k], scratch.cloud.size());
      out[k] = scratch.gradient[k].data();
    }
    op.template differentiate<false>(scratch.cloud, to_xi, T(1), out);
    for (int k = 0; k < 3; ++k)
      add_to_smoothed(scratch.gradient[k], convert<T>(row(transpose(extrapolated), k)));
  }
  /// Operator 0 += weight (x) values.
  void add_to_smoothed(const std::vector<T>& values, const Vec<T>& weight) const {
    for (int c = 0; c < 3; ++c) {
      T* sum = scratch.operators[0][c].data();
#pragma omp simd
      for (std::size_t j = 0; j < scratch.cloud.size(); ++j) sum[j] += weight[c] * values[j];
    }
  }

  Scheme scheme;
  bool axisymmetric;
  OperatorLayout layout;
  CellSamples samples;
  T edge; ///< edge of the nodal cell in xi
  OperatorScratch<T>& scratch;
};

} // namespace spall
