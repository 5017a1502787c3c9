#include "macro/integration/gradient_rows.h"

#include "macro/approximation/monomial_basis.h"
#include "macro/integration/point_lanes.h"
#include "shared/error.h"

#include <algorithm>
#include <limits>
#include <string>

namespace spall {
namespace {

/// Lists the points of the cloud that some lane sees: the ball that holds all faces and samples holds points
/// that none of them reaches.
template<class T> void keep_seen(int lanes, RowScratch<T>& scratch) {
  scratch.kept.clear();
  for (std::uint32_t j = 0; j < scratch.cloud.size(); ++j) {
    bool seen = false;
    for (int m = 0; m < lanes && !seen; ++m)
      for (int c = 0; c < 3; ++c) seen |= scratch.lane[m][c][j] != 0;
    if (seen) scratch.kept.push_back(j);
  }
}

/// Records of the kept points from the lanes, interleaved.
template<int Width, class T, class Record>
void append_records(std::vector<Record>& record, const RowScratch<T>& scratch) {
  const std::size_t old = record.size(), n = scratch.kept.size();
  record.resize(old + (Width == 1 ? 1 : 3) * n);
  Record* next = record.data() + old;
  for (const std::uint32_t j : scratch.kept) {
    if constexpr (Width == 1) {
      const auto& g = scratch.lane[0];
      *next++ = Record{g[0][j], g[1][j], g[2][j], 0};
    } else {
      for (int c = 0; c < 3; ++c) {
        Record r;
        for (int m = 0; m < Width; ++m) r[m] = scratch.lane[m][c][j];
        *next++ = r;
      }
    }
  }
}

/// Copies what has been built, into no more memory than it needs: bodies are as large as the machine lets
/// them.
template<class V> void keep(V& values, const V& built) {
  if (values.capacity() > built.size() + built.size() / 32) V().swap(values);
  values.assign(built.begin(), built.end());
}

/// Renumbers the columns from global indices to positions in `touched`, which it collects.
template<class T> void collect_touched(GradientRows<T>& rows, std::size_t count, RowScratch<T>& scratch) {
  if (scratch.seen.size() < count) scratch.seen.resize(count, 0), scratch.slot.resize(count);
  const std::uint32_t mark = ++scratch.mark;
  std::vector<std::uint32_t>& touched = scratch.touched;
  touched.clear();
  for (const std::uint32_t j : scratch.neighbor)
    if (scratch.seen[j] != mark) scratch.seen[j] = mark, touched.push_back(j);
  std::sort(touched.begin(), touched.end());
  for (std::size_t s = 0; s < touched.size(); ++s) scratch.slot[touched[s]] = static_cast<std::uint32_t>(s);
  if (touched.size() > std::numeric_limits<std::uint16_t>::max())
    throw ComputationError("the block of point " + std::to_string(rows.begin) + " has " +
                           std::to_string(touched.size()) +
                           " neighbours: the points have collapsed, or the support is far too large");
  keep(rows.touched, touched);
  scratch.column.clear();
  for (const std::uint32_t j : scratch.neighbor)
    scratch.column.push_back(static_cast<std::uint16_t>(scratch.slot[j]));
  keep(rows.column, scratch.column);
}

/// Fills the cloud with the points within reach of a support, in its coordinates.
template<bool Box, class T>
void gather(Cloud<T>& cloud, const Vec3& centre, const Support& support, double reach,
            const NeighborSearch& search) {
  const Mat3& a = support.inverse;
  cloud.clear();
  search.for_each_in_box(
      centre, support.half_widths(reach), [&](std::uint32_t j, double dx, double dy, double dz) {
        const double x = a[0] * dx + a[1] * dy + a[2] * dz, y = a[3] * dx + a[4] * dy + a[5] * dz,
                     z = a[6] * dx + a[7] * dy + a[8] * dz;
        const bool inside = Box ? std::max({std::abs(x), std::abs(y), std::abs(z)}) < reach
                                : x * x + y * y + z * z < reach * reach;
        if (inside) cloud.add(j, T(x), T(y), T(z));
      });
}

/// True if the cloud lies to one side of its centre: its mean is off by more than 0.18 of the support's
/// radius. Lattices have 0.25 (support of two spacings) to 0.38 (with the reach of smoothing) at a flat face
/// and 0.125 or less one layer inside; jitter of a fifth of a spacing gives 0.13 at most in the bulk.
template<class T> bool is_one_sided(const Cloud<T>& cloud) {
  double square = 0;
  for (const auto& x : cloud.xi) {
    double sum = 0;
    for (const T v : x) sum += static_cast<double>(v);
    square += sum * sum;
  }
  const double n = static_cast<double>(cloud.size());
  return square > 0.18 * 0.18 * n * n;
}

/// The whole block with one kernel and order.
template<class Basis, class T>
void build(GradientRows<T>& rows, const Points& points, const NeighborSearch& search,
           const std::vector<Support>& supports, double normalized_size, const IntegrationInputs& integration,
           const ConformingCells* cells, RowScratch<T>& scratch) {
  const PointLanes<Basis, T> lanes(integration, normalized_size, scratch);
  const double reach = reach_of(integration.scheme, normalized_size);
  for (std::size_t i = rows.begin; i < rows.end; ++i) {
    const Support& support = supports[i - rows.begin];
    Cloud<T>& cloud = scratch.cloud;
    gather<Basis::box>(cloud, points.position[i], support, reach, search);
    rows.at_surface.push_back(is_one_sided(cloud));
    if (cloud.size() > fewest_neighbors) {
      std::span<const ConformingCells::Face> faces;
      if (cells) faces = {cells->face.data() + cells->start[i], cells->face.data() + cells->start[i + 1]};
      const Quality quality = lanes.fill(support.inverse, faces, cells ? cells->volume[i] : 0);
      rows.regularized += quality.regularized;
      rows.smallest_fraction = std::min(rows.smallest_fraction, quality.fraction);
      keep_seen(rows.layout.used, scratch);
      for (const std::uint32_t j : scratch.kept) scratch.neighbor.push_back(cloud.index[j]);
      switch (rows.layout.width) {
      case 1:
        append_records<1>(scratch.record, scratch);
        break;
      case 4:
        append_records<4>(scratch.record, scratch);
        break;
      default:
        append_records<8>(scratch.wide, scratch);
      }
    } else {
      ++rows.isolated;
    }
    rows.start.push_back(static_cast<std::uint32_t>(scratch.neighbor.size()));
  }
}

/// Calls action<Kernel>() with the kernel of the inputs.
template<class Action> void with_kernel(const ApproximationInputs& inputs, const Action& action) {
  const auto shaped = [&]<class Profile>() {
    if (inputs.support.shape == SupportShape::box)
      action.template operator()<Box<Profile>>();
    else
      action.template operator()<Ball<Profile>>();
  };
  if (inputs.profile == Profile::cubic_spline)
    shaped.template operator()<CubicSpline>();
  else
    shaped.template operator()<WendlandC4>();
}

} // namespace

template<class T>
void build_rows(GradientRows<T>& rows, const Points& points, const NeighborSearch& search,
                const std::vector<Support>& supports, const ApproximationInputs& approximation,
                const IntegrationInputs& integration, const ConformingCells* cells, RowScratch<T>& scratch) {
  rows.layout = lanes_of(integration);
  rows.start.reserve(rows.end - rows.begin + 1);
  rows.start.assign(1, 0);
  rows.at_surface.reserve(rows.end - rows.begin);
  rows.at_surface.clear();
  scratch.neighbor.clear();
  scratch.record.clear();
  scratch.wide.clear();
  rows.regularized = rows.isolated = 0;
  rows.smallest_fraction = 1;
  const double size = approximation.support.normalized_size;
  with_kernel(approximation, [&]<class Kernel>() {
    const auto with_basis = [&]<class Basis>() {
      build<Basis>(rows, points, search, supports, size, integration, cells, scratch);
    };
    switch (approximation.order) {
    case 0:
      with_basis.template operator()<MonomialBasis<Kernel, 0>>();
      break;
    case 1:
      with_basis.template operator()<LinearBasis<Kernel>>();
      break;
    default:
      with_basis.template operator()<MonomialBasis<Kernel, 2>>();
    }
  });
  collect_touched(rows, points.position.component[0].size(), scratch);
  keep(rows.record, scratch.record);
  keep(rows.wide, scratch.wide);
}

template<class T> void GradientRows<T>::touch(const std::vector<std::uint32_t>& places) {
  touched = places;
  std::sort(touched.begin(), touched.end());
  if (touched == places) return;
  std::vector<std::uint16_t> moved; // of each entry
  for (const std::uint32_t place : places)
    moved.push_back(static_cast<std::uint16_t>(std::lower_bound(touched.begin(), touched.end(), place) -
                                               touched.begin()));
  for (std::uint16_t& c : column) c = moved[c];
}
template void GradientRows<float>::touch(const std::vector<std::uint32_t>&);
template void GradientRows<double>::touch(const std::vector<std::uint32_t>&);

template<class T> void push_forward(GradientRows<T>& rows, const std::vector<Mat3>& relative) {
  // grad_x = f^-T grad_X, the same for every lane.
  const auto push = [&](auto& record, std::size_t i) {
    const Mat3 f = inverse(relative[i]);
    for (std::uint32_t p = rows.start[i - rows.begin]; p < rows.start[i - rows.begin + 1]; ++p) {
      auto *g = &record[3 * p], &x = g[0], &y = g[1], &z = g[2];
      const auto a = T(f[0]) * x + T(f[3]) * y + T(f[6]) * z, b = T(f[1]) * x + T(f[4]) * y + T(f[7]) * z,
                 c = T(f[2]) * x + T(f[5]) * y + T(f[8]) * z;
      x = a, y = b, z = c;
    }
  };
  for (std::size_t i = rows.begin; i < rows.end; ++i) {
    if (rows.layout.width == 8) {
      push(rows.wide, i);
    } else if (rows.layout.width == 4) {
      push(rows.record, i);
    } else {
      const Mat3 f = inverse(relative[i]);
      for (std::uint32_t p = rows.start[i - rows.begin]; p < rows.start[i - rows.begin + 1]; ++p) {
        const Lanes<T> g = rows.record[p];
        for (int c = 0; c < 3; ++c)
          rows.record[p][c] = T(f[c]) * g[0] + T(f[3 + c]) * g[1] + T(f[6 + c]) * g[2];
      }
    }
  }
}

template void build_rows(GradientRows<float>&, const Points&, const NeighborSearch&,
                         const std::vector<Support>&, const ApproximationInputs&, const IntegrationInputs&,
                         const ConformingCells*, RowScratch<float>&);
template void build_rows(GradientRows<double>&, const Points&, const NeighborSearch&,
                         const std::vector<Support>&, const ApproximationInputs&, const IntegrationInputs&,
                         const ConformingCells*, RowScratch<double>&);
template void push_forward(GradientRows<float>&, const std::vector<Mat3>&);
template void push_forward(GradientRows<double>&, const std::vector<Mat3>&);

} // namespace spall
