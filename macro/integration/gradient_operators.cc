#include "macro/integration/gradient_operators.h"

#include "macro/approximation/monomial_basis.h"
#include "macro/integration/point_operators.h"

#include <algorithm>
#include <limits>

namespace spall {
namespace {

/// Lists the points of the cloud that some operator acts on. The ball around all faces and samples contains
/// points that no operator reaches.
template<class T> void find_active_points(int count, OperatorScratch<T>& scratch) {
  const std::size_t n = scratch.cloud.size();
  std::vector<T>& magnitude = scratch.plus; // sum over the operators of each point; NaN stays
  hold(magnitude, n);
  std::fill_n(magnitude.begin(), n, T(0));
  for (int m = 0; m < count; ++m)
    for (const auto& component : scratch.operators[m])
#pragma omp simd
      for (std::size_t j = 0; j < n; ++j) magnitude[j] += std::abs(component[j]);
  scratch.active.resize(n);
  std::size_t active = 0;
  for (std::size_t j = 0; j < n; ++j) {
    scratch.active[active] = static_cast<std::uint32_t>(j);
    active += magnitude[j] != 0;
  }
  scratch.active.resize(active);
}

/// Appends the records of the active points, each with all operators side by side.
template<int Width, class T, class Record>
void append_records(std::vector<Record>& record, const OperatorScratch<T>& scratch) {
  const std::size_t old = record.size(), n = scratch.active.size();
  record.resize(old + (Width == 1 ? 1 : 3) * n);
  Record* next = record.data() + old;
  for (const std::uint32_t j : scratch.active) {
    if constexpr (Width == 1) {
      const auto& g = scratch.operators[0];
      *next++ = Record{g[0][j], g[1][j], g[2][j], 0};
    } else {
      for (int c = 0; c < 3; ++c) {
        Record r;
        for (int m = 0; m < Width; ++m) r[m] = scratch.operators[m][c][j];
        *next++ = r;
      }
    }
  }
}

/// Copies a vector without excess capacity, because memory limits the size of the bodies.
template<class V> void copy_without_excess(V& values, const V& built) {
  if (values.capacity() > built.size() + built.size() / 32) V().swap(values);
  values.assign(built.begin(), built.end());
}

/// Collects the stencil of the block, and numbers the neighbours of the pairs by their positions in it.
/// @param count number of points with ghosts @return reason of a failure; empty if there is none
template<class T>
std::string number_stencil(GradientOperators<T>& operators, std::size_t count, OperatorScratch<T>& scratch) {
  if (scratch.seen.size() < count) scratch.seen.resize(count, 0), scratch.slot.resize(count);
  const std::uint32_t mark = ++scratch.mark;
  std::vector<std::uint32_t>& stencil = scratch.stencil;
  stencil.clear();
  for (const std::uint32_t j : scratch.neighbor)
    if (scratch.seen[j] != mark) scratch.seen[j] = mark, stencil.push_back(j);
  std::sort(stencil.begin(), stencil.end());
  for (std::size_t s = 0; s < stencil.size(); ++s) scratch.slot[stencil[s]] = static_cast<std::uint32_t>(s);
  if (stencil.size() > std::numeric_limits<std::uint16_t>::max())
    return "the block of point " + std::to_string(operators.begin) + " has " +
           std::to_string(stencil.size()) +
           " neighbours: the points have collapsed, or the support is far too large";
  copy_without_excess(operators.stencil, stencil);
  scratch.column.resize(scratch.neighbor.size());
  for (std::size_t p = 0; p < scratch.column.size(); ++p)
    scratch.column[p] = static_cast<std::uint16_t>(scratch.slot[scratch.neighbor[p]]);
  copy_without_excess(operators.column, scratch.column);
  return {};
}

/// Fills the cloud with the offsets of the points of the search's runs from the centre.
template<class T>
void gather_box(Cloud<T>& cloud, const Vec3& centre, const Vec3& half, const NeighborSearch& search) {
  constexpr std::size_t whole = NeighborSearch::padding; // runs are short: whole registers are copied
  std::size_t n = 0;
  search.for_each_run(centre, half, [&](const NeighborSearch::Run& run) {
    if (n + run.count + whole > cloud.index.size()) cloud.make_room(2 * (n + run.count + whole));
    for (std::size_t first = 0; first < run.count; first += whole) {
      std::copy_n(run.index + first, whole, cloud.index.data() + n + first);
      for (int c = 0; c < 3; ++c) {
        const double *position = run.position[c] + first, origin = centre[c];
        T* offset = cloud.xi[c].data() + n + first;
#pragma omp simd
        for (std::size_t s = 0; s < whole; ++s) offset[s] = T(position[s] - origin);
      }
    }
    n += run.count;
  });
  cloud.count = n;
}

/// Fills the cloud with the points inside a support, in the support's coordinates.
template<bool Box, class T>
void gather(Cloud<T>& cloud, const Vec3& centre, const Support& support, double reach,
            const NeighborSearch& search) {
  gather_box(cloud, centre, support.half_widths(reach), search);
  cloud.transform(convert<T>(support.inverse));
  cloud.template keep_within<Box>(T(reach));
}

/// Returns true if the cloud lies to one side of its centre: its mean is off by more than 0.18 of the
/// support's radius. Lattices have 0.25 (support of two spacings) to 0.38 (with the reach of smoothing) at a
/// flat face and 0.125 or less one layer inside; jitter of a fifth of a spacing gives 0.13 at most in the
/// bulk.
template<class T> bool is_one_sided(const Cloud<T>& cloud) {
  const T *x = cloud.xi[0].data(), *y = cloud.xi[1].data(), *z = cloud.xi[2].data();
  T sx = 0, sy = 0, sz = 0;
#pragma omp simd reduction(+ : sx, sy, sz)
  for (std::size_t j = 0; j < cloud.size(); ++j) sx += x[j], sy += y[j], sz += z[j];
  const Vec<T> sum = {sx, sy, sz};
  const T n = static_cast<T>(cloud.size());
  return dot(sum, sum) > T(0.18 * 0.18) * n * n;
}

/// Appends the operators of the point whose cloud is in the scratch memory.
template<class Basis, class T>
void append_point(GradientOperators<T>& operators, const PointOperators<Basis, T>& point, std::size_t i,
                  const OperatorInputs& inputs, OperatorScratch<T>& scratch) {
  const ConformingCells* cells = inputs.cells;
  std::span<const ConformingCells::Face> faces;
  if (cells) faces = {cells->face.data() + cells->start[i], cells->face.data() + cells->start[i + 1]};
  const Quality quality =
      point.fill(inputs.supports[i - operators.begin].inverse, faces, cells ? cells->volume[i] : 0);
  operators.regularized += quality.regularized;
  operators.smallest_fraction = std::min(operators.smallest_fraction, quality.fraction);
  find_active_points(operators.layout.count, scratch);
  const std::size_t before = scratch.neighbor.size();
  scratch.neighbor.resize(before + scratch.active.size());
  for (std::size_t k = 0; k < scratch.active.size(); ++k)
    scratch.neighbor[before + k] = scratch.cloud.index[scratch.active[k]];
  switch (operators.layout.width) {
  case 1:
    return append_records<1>(scratch.record, scratch);
  case 4:
    return append_records<4>(scratch.record, scratch);
  default:
    return append_records<8>(scratch.wide, scratch);
  }
}

/// Builds the operators of the whole block with one kernel and order.
template<class Basis, class T>
void build(GradientOperators<T>& operators, const OperatorInputs& inputs, OperatorScratch<T>& scratch) {
  const double normalized_size = inputs.approximation.support.normalized_size;
  const PointOperators<Basis, T> point(inputs.integration, normalized_size, scratch);
  const double reach = reach_of(inputs.integration.scheme, normalized_size);
  for (std::size_t i = operators.begin; i < operators.end; ++i) {
    gather<Basis::box>(scratch.cloud, inputs.points.position[i], inputs.supports[i - operators.begin], reach,
                       inputs.search);
    operators.at_surface.push_back(is_one_sided(scratch.cloud));
    if (scratch.cloud.size() > fewest_neighbors)
      append_point(operators, point, i, inputs, scratch);
    else
      ++operators.isolated;
    operators.start.push_back(static_cast<std::uint32_t>(scratch.neighbor.size()));
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

/// Removes the previous operators.
template<class T> void clear(GradientOperators<T>& operators, OperatorScratch<T>& scratch) {
  operators.start.reserve(operators.end - operators.begin + 1);
  operators.start.assign(1, 0);
  operators.at_surface.reserve(operators.end - operators.begin);
  operators.at_surface.clear();
  scratch.neighbor.clear();
  scratch.record.clear();
  scratch.wide.clear();
  operators.regularized = operators.isolated = 0;
  operators.smallest_fraction = 1;
}

} // namespace

template<class T>
std::string build_gradient_operators(GradientOperators<T>& operators, const OperatorInputs& inputs,
                                     OperatorScratch<T>& scratch) {
  operators.layout = layout_of(inputs.integration);
  operators.rings = false;
  clear(operators, scratch);
  with_kernel(inputs.approximation, [&]<class Kernel>() {
    switch (inputs.approximation.order) {
    case 0:
      return build<MonomialBasis<Kernel, 0>>(operators, inputs, scratch);
    case 1:
      return build<LinearBasis<Kernel>>(operators, inputs, scratch);
    default:
      return build<MonomialBasis<Kernel, 2>>(operators, inputs, scratch);
    }
  });
  scratch.record.resize(scratch.record.size() + GradientOperators<T>::slack / sizeof(Lanes<T>));
  scratch.wide.resize(scratch.wide.size() + GradientOperators<T>::slack / sizeof(Lanes<T, 8>));
  copy_without_excess(operators.record, scratch.record);
  copy_without_excess(operators.wide, scratch.wide);
  return number_stencil(operators, inputs.points.position.component[0].size(), scratch);
}

template<class T> void GradientOperators<T>::relocate(const std::vector<std::uint32_t>& places) {
  stencil = places;
  std::sort(stencil.begin(), stencil.end());
  if (stencil == places) return;
  std::vector<std::uint16_t> moved; // new position in the stencil of each stencil point
  for (const std::uint32_t place : places)
    moved.push_back(static_cast<std::uint16_t>(std::lower_bound(stencil.begin(), stencil.end(), place) -
                                               stencil.begin()));
  for (std::uint16_t& c : column) c = moved[c];
}

namespace {

/// Calls action(records) with the records of a width above 1.
template<class T, class Action> void with_vectors(GradientOperators<T>& operators, const Action& action) {
  if (operators.layout.width == 4)
    action(operators.record);
  else
    action(operators.wide);
}

/// push_forward of the rings [first, last): rr and rz, zr and zz are gradients in the half plane.
template<class T>
void push_rings(GradientOperators<T>& operators, std::uint32_t first, std::uint32_t last,
                const Mat<T>& inverse_f) {
  const auto push = [&](auto& r, auto& z) {
    const auto before = r;
    r = inverse_f(0, 0) * before + inverse_f(2, 0) * z;
    z = inverse_f(0, 2) * before + inverse_f(2, 2) * z;
  };
  if (operators.layout.width == 1) {
    for (std::uint32_t p = first; p < last; ++p) {
      Lanes<T>&a = operators.record[2 * p], &b = operators.record[2 * p + 1];
      std::array<T, 4> g = {a[0], a[1], b[0], b[1]};
      push(g[0], g[1]);
      push(g[2], g[3]);
      a = Lanes<T>{g[0], g[1], inverse_f(1, 1) * a[2], 0}, b = Lanes<T>{g[2], g[3], 0, 0};
    }
    return;
  }
  with_vectors(operators, [&](auto& record) {
    for (std::uint32_t p = first; p < last; ++p) {
      auto* g = &record[5 * p];
      push(g[0], g[1]);
      push(g[3], g[4]);
      g[2] *= inverse_f(1, 1);
    }
  });
}

} // namespace

template<class T> void push_forward(GradientOperators<T>& operators, const std::vector<Mat3>& relative) {
  for (std::size_t i = operators.begin; i < operators.end; ++i) {
    const Mat<T> inverse_f = convert<T>(inverse(relative[i]));
    const std::uint32_t first = operators.start[i - operators.begin],
                        last = operators.start[i - operators.begin + 1];
    if (operators.rings) {
      push_rings(operators, first, last, inverse_f);
      continue;
    }
    if (operators.layout.width == 1) {
      for (std::uint32_t p = first; p < last; ++p) {
        Lanes<T>& g = operators.record[p];
        const auto [x, y, z] = times_transposed(inverse_f, Vec<T>{g[0], g[1], g[2]});
        g = Lanes<T>{x, y, z, 0};
      }
      continue;
    }
    with_vectors(operators, [&](auto& record) { // all operators of a pair
      for (std::uint32_t p = first; p < last; ++p) {
        auto* g = &record[3 * p];
        const auto [x, y, z] = times_transposed(inverse_f, Vec<std::decay_t<decltype(*g)>>{g[0], g[1], g[2]});
        g[0] = x, g[1] = y, g[2] = z;
      }
    });
  }
}

template struct GradientOperators<float>;
template struct GradientOperators<double>;
template std::string build_gradient_operators(GradientOperators<float>&, const OperatorInputs&,
                                              OperatorScratch<float>&);
template std::string build_gradient_operators(GradientOperators<double>&, const OperatorInputs&,
                                              OperatorScratch<double>&);
template void push_forward(GradientOperators<float>&, const std::vector<Mat3>&);
template void push_forward(GradientOperators<double>&, const std::vector<Mat3>&);

} // namespace spall
