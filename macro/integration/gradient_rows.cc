#include "macro/integration/gradient_rows.h"

#include <algorithm>

namespace spall {
namespace {

/// A^-T b: from derivatives with respect to xi to derivatives in space.
template<class T> std::array<T, 3> to_space(const Mat3& inverse, const std::array<T, 3>& b) {
  return {T(inverse[0]) * b[0] + T(inverse[3]) * b[1] + T(inverse[6]) * b[2],
          T(inverse[1]) * b[0] + T(inverse[4]) * b[1] + T(inverse[7]) * b[2],
          T(inverse[2]) * b[0] + T(inverse[5]) * b[1] + T(inverse[8]) * b[2]};
}

/// Smoothed gradient (paper Eq. 10) of every point of the cloud: the cell is the cube of edge 1/a in xi,
/// moving with the material; one point per face. Face normals are the axes of xi, so B_k = a (Psi(+k) -
/// Psi(-k)).
template<class T>
void smooth(Cloud<T>& cloud, T normalized_size, std::vector<std::array<T, 3>>& gradient, bool& regularized) {
  gradient.assign(cloud.size(), {});
  const T half_edge = T(0.5) / normalized_size;
  for (int k = 0; k < 3; ++k)
    for (const T side : {T(1), T(-1)}) {
      std::array<T, 3> at{};
      at[k] = side * half_edge;
      const Moments<T> m = evaluate_moments<CubicSpline>(cloud, at);
      regularized |= m.regularized;
      for (std::size_t j = 0; j < cloud.size(); ++j)
        gradient[j][k] += side * normalized_size * shape_function(cloud, j, m, at);
    }
}

/// Records of all points of the cloud: derivatives in space, computed along arrays, then interleaved.
template<bool Stabilized, class T>
void append_records(std::vector<Lanes<T>>& record, const Cloud<T>& cloud, const GradientOperator<T>& op,
                    const Mat3& inverse, double normalized_size, RowScratch<T>& scratch) {
  const std::size_t n = cloud.size(), old = record.size();
  // The second moment of the nodal cell, a cube of edge 1/a in xi, is 1 / (12 a^2) per axis and volume.
  const T weight = T(1 / (normalized_size * std::sqrt(12.0)));
  for (auto& g : scratch.derivative) g.resize(n);
  std::array<T*, 12> out;
  for (int k = 0; k < 12; ++k) out[k] = scratch.derivative[k].data();
  std::array<T, 9> to_xi;
  for (int k = 0; k < 9; ++k) to_xi[k] = static_cast<T>(inverse[k]);
  op.template differentiate<Stabilized>(cloud, to_xi, weight, out);
  if constexpr (Stabilized) {
    record.resize(old + 3 * n);
    for (std::size_t j = 0; j < n; ++j)
      for (int c = 0; c < 3; ++c)
        record[old + 3 * j + c] = Lanes<T>{out[c][j], out[3 + c][j], out[6 + c][j], out[9 + c][j]};
  } else {
    record.resize(old + n);
    for (std::size_t j = 0; j < n; ++j) record[old + j] = Lanes<T>{out[0][j], out[1][j], out[2][j], 0};
  }
}

/// Renumbers the columns from global indices to positions in `touched`, which it collects.
template<class T> void collect_touched(GradientRows<T>& rows, std::size_t count, RowScratch<T>& scratch) {
  if (scratch.seen.size() < count) scratch.seen.resize(count, 0), scratch.slot.resize(count);
  const std::uint32_t mark = ++scratch.mark;
  rows.touched.clear();
  for (const std::uint32_t j : rows.column)
    if (scratch.seen[j] != mark) scratch.seen[j] = mark, rows.touched.push_back(j);
  std::sort(rows.touched.begin(), rows.touched.end());
  for (std::size_t s = 0; s < rows.touched.size(); ++s)
    scratch.slot[rows.touched[s]] = static_cast<std::uint32_t>(s);
  for (std::uint32_t& c : rows.column) c = scratch.slot[c];
}

} // namespace

template<class T>
void build_rows(GradientRows<T>& rows, const Points& points, const NeighborSearch& search,
                const std::vector<Support>& supports, Scheme scheme, double normalized_size,
                RowScratch<T>& scratch) {
  rows.start.assign(1, 0);
  rows.column.clear();
  rows.record.clear();
  rows.regularized = rows.isolated = 0;
  const double reach = reach_of(scheme, normalized_size);
  Cloud<T>& cloud = scratch.cloud;
  for (std::size_t i = rows.begin; i < rows.end; ++i) {
    const Support& support = supports[i - rows.begin];
    const Mat3& a = support.inverse;
    cloud.clear();
    search.for_each_in_box(points.position[i], support.half_widths(reach),
                           [&](std::uint32_t j, double dx, double dy, double dz) {
                             const double x = a[0] * dx + a[1] * dy + a[2] * dz;
                             const double y = a[3] * dx + a[4] * dy + a[5] * dz;
                             const double z = a[6] * dx + a[7] * dy + a[8] * dz;
                             if (x * x + y * y + z * z < reach * reach) cloud.add(j, T(x), T(y), T(z));
                           });
    if (cloud.size() <= fewest_neighbors) {
      ++rows.isolated;
      rows.start.push_back(static_cast<std::uint32_t>(rows.column.size()));
      continue;
    }
    rows.column.insert(rows.column.end(), cloud.index.begin(), cloud.index.end());
    bool regularized = false;
    if (scheme == Scheme::snni) {
      smooth(cloud, T(normalized_size), scratch.smoothed, regularized);
      for (const auto& b : scratch.smoothed) {
        const auto g = to_space(a, b);
        rows.record.push_back(Lanes<T>{g[0], g[1], g[2], 0});
      }
    } else {
      GradientOperator<T> op{evaluate_moments<CubicSpline>(cloud, std::array<T, 3>{})};
      regularized = op.moments.regularized;
      if (is_stabilized(scheme)) {
        op.collect_derivatives(cloud);
        append_records<true>(rows.record, cloud, op, a, normalized_size, scratch);
      } else {
        append_records<false>(rows.record, cloud, op, a, normalized_size, scratch);
      }
    }
    rows.regularized += regularized;
    rows.start.push_back(static_cast<std::uint32_t>(rows.column.size()));
  }
  collect_touched(rows, points.position.component[0].size(), scratch);
}

template void build_rows(GradientRows<float>&, const Points&, const NeighborSearch&,
                         const std::vector<Support>&, Scheme, double, RowScratch<float>&);
template void build_rows(GradientRows<double>&, const Points&, const NeighborSearch&,
                         const std::vector<Support>&, Scheme, double, RowScratch<double>&);

} // namespace spall
