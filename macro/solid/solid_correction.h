#pragma once

#include "macro/solid/consistency.h"
#include "macro/solid/solid_of.h"

namespace spall {

template<class Material, class T, class Stress> void SolidOf<Material, T, Stress>::make_consistent() {
  // Minimise sum V |D|^2 over corrections D of the rows, with D exact for constants and linears and sum_L V_L
  // (G + D)_LJ = 0 for every point J inside. The multiplier lambda of the latter gives D =
  // linear_residual(lambda) and a symmetric system for lambda. It travels as the velocity, sums over columns
  // as the force.
  const VectorField velocity = points.velocity, force = points.force;
  const std::size_t n = points.owned;
  std::vector<std::vector<Lanes<double>>> sums(blocks.size());
  std::vector<const Lanes<double>*> sum_data;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    sums[b].resize(blocks[b].rows.touched.size());
    sum_data.push_back(sums[b].data());
  }
  const LaneLayout layout = lanes_of(inputs.integration);
  const int gradients = layout.use == LaneUse::subpoints ? layout.used : 1;
  // Calls visit(i, pair, vector of the pair) for all pairs of a block: what a row adds to its columns.
  const auto column_sums = [&](const auto& row_vectors, std::vector<double>& result) {
    ghosts.refresh(points);
    for_each_index(blocks.size(), [&](std::size_t b) {
      const GradientRows<T>& rows = blocks[b].rows;
      std::fill(sums[b].begin(), sums[b].end(), Lanes<double>{});
      std::vector<Vec3> vectors;
      for (std::size_t i = rows.begin; i < rows.end; ++i) {
        const std::uint32_t first = rows.start[i - rows.begin], last = rows.start[i - rows.begin + 1];
        const double volume = points.volume[i] * determinant(points.reference[i]);
        row_vectors(rows, first, last, vectors);
        for (std::uint32_t p = first; p < last; ++p)
          for (int c = 0; c < 3; ++c) sums[b][rows.column[p]][c] += volume * vectors[p - first][c];
      }
    });
    reduction.sum<double>(touched, sum_data, points);
    ghosts.add_back(points);
    result.resize(3 * n);
    for (std::size_t i = 0; i < n; ++i)
      for (int c = 0; c < 3; ++c) result[3 * i + c] = points.force.component[c][i];
  };
  const auto set_lambda = [&](const std::vector<double>& lambda) {
    for (std::size_t i = 0; i < n; ++i)
      for (int c = 0; c < 3; ++c) points.velocity.component[c][i] = lambda[3 * i + c];
  };

  // Points inside: those without a surface point among their neighbours.
  std::vector<double> flag(3 * n, 0.0);
  for (const Block& block : blocks)
    for (std::size_t i = block.rows.begin; i < block.rows.end; ++i)
      flag[3 * i] = block.rows.at_surface[i - block.rows.begin];
  set_lambda(flag);
  ghosts.refresh(points);
  std::vector<double> inside(3 * n, 1.0);
  for (const Block& block : blocks)
    for (std::size_t i = block.rows.begin; i < block.rows.end; ++i)
      for (std::uint32_t p = block.rows.start[i - block.rows.begin];
           p < block.rows.start[i - block.rows.begin + 1]; ++p)
        if (points.velocity.component[0][block.rows.touched[block.rows.column[p]]] != 0)
          inside[3 * i] = inside[3 * i + 1] = inside[3 * i + 2] = 0;
  const auto mask = [&](std::vector<double>& v) {
    for (std::size_t k = 0; k < v.size(); ++k) v[k] *= inside[k];
  };

  std::vector<double> right, lambda;
  column_sums(
      [&](const GradientRows<T>& rows, std::uint32_t first, std::uint32_t last, std::vector<Vec3>& g) {
        g.assign(last - first, Vec3{});
        for (std::uint32_t p = first; p < last; ++p)
          for (int c = 0; c < 3; ++c)
            for (int m = 0; m < gradients; ++m) g[p - first][c] -= rows.entry(p, c, m) / gradients;
      },
      right);
  mask(right);
  const auto residual = [&](const GradientRows<T>& rows, std::uint32_t first, std::uint32_t last,
                            std::vector<Vec3>& e) {
    linear_residual(rows, first, last, points, points.velocity, e);
  };
  solve_symmetric(
      [&](const std::vector<double>& x, std::vector<double>& y) {
        set_lambda(x);
        column_sums(residual, y);
        mask(y);
      },
      right, lambda, ghosts.processes());

  set_lambda(lambda);
  ghosts.refresh(points);
  for_each_index(blocks.size(), [&](std::size_t b) {
    GradientRows<T>& rows = blocks[b].rows;
    std::vector<Vec3> change;
    for (std::size_t i = rows.begin; i < rows.end; ++i) {
      const std::uint32_t first = rows.start[i - rows.begin], last = rows.start[i - rows.begin + 1];
      residual(rows, first, last, change);
      for (std::uint32_t p = first; p < last; ++p)
        for (int c = 0; c < 3; ++c)
          for (int m = 0; m < gradients; ++m) rows.add_to_entry(p, c, m, T(change[p - first][c]));
    }
  });
  points.velocity = velocity;
  points.force = force;
}

} // namespace spall
