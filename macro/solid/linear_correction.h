#pragma once

#include "macro/integration/gradient_operators.h"
#include "macro/points/ghosts.h"
#include "macro/points/parallel.h"
#include "macro/solid/conjugate_gradients.h"
#include "macro/solid/force_reduction.h"

#include <algorithm>
#include <vector>

namespace spall {

/// Deviation of a field from the best linear field over the neighbours of one point: residual[p] = lambda_p -
/// (the least-squares linear fit of lambda)_p for the pairs p in [first, last). It is orthogonal to constants
/// and linear fields, so that a multiple of it may be added to the point's gradient operator, which then
/// reproduces what it did before. Zero if the neighbours span no volume.
template<class T>
void linear_residual(const GradientOperators<T>& operators, std::uint32_t first, std::uint32_t last,
                     const Points& points, const VectorField& lambda, std::vector<Vec3>& residual) {
  const std::size_t n = last - first;
  residual.assign(n, Vec3{});
  const auto neighbor = [&](std::uint32_t p) { return operators.stencil[operators.column[p]]; };
  Vec3 mean_x{}, mean{};
  for (std::uint32_t p = first; p < last; ++p) {
    mean_x += points.position[neighbor(p)] / static_cast<double>(n);
    mean += lambda[neighbor(p)] / static_cast<double>(n);
  }
  Mat3 second{}, mixed{};
  for (std::uint32_t p = first; p < last; ++p) {
    const Vec3 dx = points.position[neighbor(p)] - mean_x;
    second += outer(dx, dx);
    mixed += outer(dx, lambda[neighbor(p)] - mean);
  }
  const double extent = trace(second) / 3;
  if (!(determinant(second) > 1e-6 * extent * extent * extent)) return;
  const Mat3 slope = multiply(inverse(second), mixed); // slope(a, b) = d lambda_b / d x_a
  for (std::uint32_t p = first; p < last; ++p) {
    const Vec3 dx = points.position[neighbor(p)] - mean_x;
    Vec3 fit = mean;
    for (int a = 0; a < 3; ++a) fit += dx[a] * row(slope, a);
    residual[p - first] = lambda[neighbor(p)] - fit;
  }
}

/// The linear correction of the gradients: the smallest change D of the gradient operators G after which a
/// constant stress exerts no force on the points inside, so that the linear patch test is passed, while they
/// stay exact for linear fields. It minimises sum_I V_I |D_I|^2 subject to sum_I V_I (G + D)_IJ = 0 for every
/// point J inside. With the multipliers lambda of these constraints D_I = linear_residual(lambda) over the
/// neighbours of I, and the constraints become a symmetric system for lambda. Strains and forces use the same
/// gradients, so energy and momenta are kept as without the correction.
///
/// lambda travels between ranks and images as the velocity, and the sums over the points I as the force: both
/// fields are overwritten.
template<class T> class LinearCorrection {
public:
  /// @param blocks_ gradient operators of all blocks, in their order  @param stencils_ of these
  /// @param gradients_ number of operators per point that the correction is added to: their mean is the
  /// gradient
  LinearCorrection(std::vector<GradientOperators<T>*> blocks_,
                   const std::vector<const std::vector<std::uint32_t>*>& stencils_,
                   const ForceReduction& reduction_, Points& points_, const Ghosts& ghosts_, int gradients_)
      : blocks(std::move(blocks_)), stencils(stencils_), reduction(reduction_), points(points_),
        ghosts(ghosts_), gradients(gradients_), sums(blocks.size()) {
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      sums[b].resize(blocks[b]->stencil.size());
      sum_data.push_back(sums[b].data());
    }
  }

  /// Computes the correction and adds it to the gradient operators if the solution has converged. All ranks
  /// must call it together, and all get the same report.
  /// @param residual what is left of the system at its end: three numbers per owned point
  SolverReport apply(std::vector<double>& residual) {
    find_points_inside();
    column_sums([this](const GradientOperators<T>& operators, std::uint32_t first, std::uint32_t last,
                       std::vector<Vec3>& g) { negative_gradients(operators, first, last, g); },
                residual);
    mask(residual);
    const auto deviation = [this](const GradientOperators<T>& operators, std::uint32_t first,
                                  std::uint32_t last, std::vector<Vec3>& d) {
      linear_residual(operators, first, last, points, points.velocity, d);
    };
    std::vector<double> lambda;
    const SolverReport report = solve_symmetric(
        [&](const std::vector<double>& x, std::vector<double>& y) {
          set_lambda(x);
          column_sums(deviation, y);
          mask(y);
        },
        residual, lambda, ghosts.processes());
    if (report.converged) {
      set_lambda(lambda);
      ghosts.refresh(points);
      add_correction(deviation);
    }
    return report;
  }

private:
  /// For every owned point J: sum_I V_I vector_IJ, of the vectors that `row_vectors` gives for the pairs of
  /// each point I.
  template<class RowVectors> void column_sums(const RowVectors& row_vectors, std::vector<double>& result) {
    ghosts.refresh(points);
    for_each_index(blocks.size(), [&](std::size_t b) {
      const GradientOperators<T>& operators = *blocks[b];
      std::fill(sums[b].begin(), sums[b].end(), Lanes<double>{});
      std::vector<Vec3> vectors;
      for (std::size_t i = operators.begin; i < operators.end; ++i) {
        const std::uint32_t first = operators.start[i - operators.begin],
                            last = operators.start[i - operators.begin + 1];
        const double volume = points.volume[i] * determinant(points.reference[i]);
        row_vectors(operators, first, last, vectors);
        for (std::uint32_t p = first; p < last; ++p)
          for (int c = 0; c < 3; ++c) sums[b][operators.column[p]][c] += volume * vectors[p - first][c];
      }
    });
    reduction.sum<double>(stencils, sum_data, points);
    ghosts.add_back(points);
    result.resize(3 * points.owned);
    for (std::size_t i = 0; i < points.owned; ++i)
      for (int c = 0; c < 3; ++c) result[3 * i + c] = points.force.component[c][i];
  }
  void set_lambda(const std::vector<double>& lambda) {
    for (std::size_t i = 0; i < points.owned; ++i)
      points.velocity.set(i, {lambda[3 * i], lambda[3 * i + 1], lambda[3 * i + 2]});
  }
  void negative_gradients(const GradientOperators<T>& operators, std::uint32_t first, std::uint32_t last,
                          std::vector<Vec3>& g) const {
    g.assign(last - first, Vec3{});
    for (std::uint32_t p = first; p < last; ++p)
      for (int c = 0; c < 3; ++c)
        for (int m = 0; m < gradients; ++m) g[p - first][c] -= operators.entry(p, c, m) / gradients;
  }

  /// Points inside are those without a surface point among their neighbours.
  void find_points_inside() {
    for (const GradientOperators<T>* operators : blocks)
      for (std::size_t i = operators->begin; i < operators->end; ++i)
        points.velocity.set(i, {static_cast<double>(operators->at_surface[i - operators->begin]), 0, 0});
    ghosts.refresh(points);
    inside.assign(points.owned, 1.0);
    for (const GradientOperators<T>* operators : blocks)
      for (std::size_t i = operators->begin; i < operators->end; ++i)
        for (std::uint32_t p = operators->start[i - operators->begin];
             p < operators->start[i - operators->begin + 1]; ++p)
          // An image behind a plane or around the axis has its flag turned with it.
          if (points.velocity.component[0][operators->stencil[operators->column[p]]] != 0) inside[i] = 0;
  }
  /// Sets to zero what does not belong to points inside.
  void mask(std::vector<double>& values) const {
    for (std::size_t k = 0; k < values.size(); ++k) values[k] *= inside[k / 3];
  }

  template<class Deviation> void add_correction(const Deviation& deviation) {
    for_each_index(blocks.size(), [&](std::size_t b) {
      GradientOperators<T>& operators = *blocks[b];
      std::vector<Vec3> change;
      for (std::size_t i = operators.begin; i < operators.end; ++i) {
        const std::uint32_t first = operators.start[i - operators.begin],
                            last = operators.start[i - operators.begin + 1];
        deviation(operators, first, last, change);
        for (std::uint32_t p = first; p < last; ++p)
          for (int c = 0; c < 3; ++c)
            for (int m = 0; m < gradients; ++m) operators.add_to_entry(p, c, m, T(change[p - first][c]));
      }
    });
  }

  std::vector<GradientOperators<T>*> blocks;
  const std::vector<const std::vector<std::uint32_t>*>& stencils;
  const ForceReduction& reduction;
  Points& points;
  const Ghosts& ghosts;
  int gradients;
  std::vector<std::vector<Lanes<double>>> sums; ///< sums of each block on its stencil points
  std::vector<const Lanes<double>*> sum_data;
  std::vector<double> inside; ///< 1 for the points inside, 0 for the others
};

} // namespace spall
