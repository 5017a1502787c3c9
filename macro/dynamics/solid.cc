#include "macro/dynamics/solid.h"

#include "macro/dynamics/force_reduction.h"
#include "macro/dynamics/point_kinematics.h"
#include "macro/integration/gradient_rows.h"
#include "macro/material/afc.h"
#include "macro/material/j2.h"
#include "macro/points/neighbor_search.h"
#include "macro/points/parallel.h"
#include "shared/error.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spall {
namespace {

/// Points per block: small enough that a block's velocities, forces and rows stay in the second-level cache,
/// large enough that the rim of touched points is not most of it.
constexpr std::size_t block_size = 128;

template<class Material, class T> class SolidOf final : public Solid {
public:
  SolidOf(const Material& material_, Points points_, SymmetryPlanes planes, const SolidInputs& inputs_)
      : Solid(planes), material(material_), inputs(inputs_) {
    points = std::move(points_);
    states.resize(points.owned);
    blocks.resize((points.owned + block_size - 1) / block_size);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      blocks[b].rows.begin = b * block_size;
      blocks[b].rows.end = std::min(points.owned, (b + 1) * block_size);
    }
  }

  RefreshReport refresh() override;
  SolidReport update(double dt, double time) override;

  std::vector<std::string> field_names() const override {
    std::vector<std::string> names;
    for (const auto& [name, member] : Material::fields) names.emplace_back(name);
    return names;
  }
  std::vector<double> field(const std::string& name) const override {
    std::vector<double> values(points.owned);
    for (const auto& [candidate, member] : Material::fields)
      if (name == candidate)
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = states[i].*member;
    return values;
  }
  std::size_t memory_bytes() const override {
    std::size_t bytes = points.owned * (sizeof(typename Material::State) + sizeof(StressLanes) +
                                        2 * sizeof(Mat3) + 3 * sizeof(double)) +
                        points.position.component[0].size() * 12 * sizeof(double);
    for (const Block& block : blocks)
      bytes +=
          block.rows.memory_bytes() + sizeof(Lanes<T>) * (block.velocity.capacity() + block.force.capacity());
    return bytes;
  }

private:
  struct Block {
    GradientRows<T> rows;
    std::vector<Lanes<T>> velocity, force; ///< of the touched points
    SolidReport report;
    std::size_t bad = none; ///< first point that inverted or is not finite
  };
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  template<bool Stabilized> void update_block(Block& block, double dt);
  [[noreturn]] void fail(std::size_t point, double time) const;

  const Material material;
  const SolidInputs inputs;
  std::vector<typename Material::State> states;
  std::vector<Block> blocks;
  NeighborSearch search;
  ForceReduction reduction;
  std::vector<const std::vector<std::uint32_t>*> touched;
  std::vector<const Lanes<T>*> contributions;
  tbb::enumerable_thread_specific<RowScratch<T>> scratch;
};

template<class Material, class T> RefreshReport SolidOf<Material, T>::refresh() {
  // (i) The present configuration becomes the reference of the next gradients; the support follows the
  // deformation.
  std::vector<std::vector<Support>> supports(blocks.size());
  std::vector<double> stable(blocks.size(), std::numeric_limits<double>::infinity());
  std::vector<Vec3> reach(blocks.size());
  const double extent = reach_of(inputs.integration.scheme, inputs.support.normalized_size);
  for_each_index(blocks.size(), [&](std::size_t b) {
    for (std::size_t i = blocks[b].rows.begin; i < blocks[b].rows.end; ++i) {
      points.reference[i] = points.deformation(i);
      points.relative[i] = identity3;
      const Support support = make_support(points.reference[i], points.spacing[i], inputs.support);
      const Vec3 half = support.half_widths(extent);
      for (int c = 0; c < 3; ++c)
        reach[b][c] = std::max(reach[b][c], half[c] - points.position.component[c][i]);
      stable[b] =
          std::min(stable[b], points.spacing[i] * support.smallest_stretch / material.sound_speed(states[i]));
      supports[b].push_back(support);
    }
  });
  Vec3 plane_reach{};
  for (const Vec3& r : reach)
    for (int c = 0; c < 3; ++c) plane_reach[c] = std::max(plane_reach[c], r[c]);
  ghosts.rebuild(points, plane_reach);

  // (ii) Neighbours and shape functions.
  search.rebuild(points, *std::min_element(points.spacing.begin(), points.spacing.end()));
  for_each_index(blocks.size(), [&](std::size_t b) {
    build_rows(blocks[b].rows, points, search, supports[b], inputs.integration.scheme,
               inputs.support.normalized_size, scratch.local());
    blocks[b].velocity.resize(blocks[b].rows.touched.size());
    blocks[b].force.resize(blocks[b].rows.touched.size());
  });
  touched.clear();
  contributions.clear();
  RefreshReport report{.stable_step = std::numeric_limits<double>::infinity()};
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    touched.push_back(&blocks[b].rows.touched);
    contributions.push_back(blocks[b].force.data());
    report.pairs += blocks[b].rows.column.size();
    report.regularized += blocks[b].rows.regularized;
    report.isolated += blocks[b].rows.isolated;
    report.stable_step = std::min(report.stable_step, stable[b]);
  }
  reduction.rebuild(touched, points.owned + ghosts.size(), block_size);
  return report;
}

template<class Material, class T> SolidReport SolidOf<Material, T>::update(double dt, double time) {
  ghosts.refresh(points);
  const bool stabilized = is_stabilized(inputs.integration.scheme);
  for_each_index(blocks.size(), [&](std::size_t b) {
    if (stabilized)
      update_block<true>(blocks[b], dt);
    else
      update_block<false>(blocks[b], dt);
  });
  SolidReport sum;
  for (const Block& block : blocks) {
    if (block.bad != none) fail(block.bad, time);
    sum.internal_work += block.report.internal_work;
    sum.stabilization_work += block.report.stabilization_work;
    sum.largest_change = std::max(sum.largest_change, block.report.largest_change);
  }
  reduction.sum<T>(touched, contributions, points);
  ghosts.add_back(points);
  return sum;
}

template<class Material, class T>
template<bool Stabilized>
void SolidOf<Material, T>::update_block(Block& block, double dt) {
  const GradientRows<T>& rows = block.rows;
  block.report = {};
  block.bad = none;
  if (rows.begin == rows.end) return;
  // Velocities relative to one point of the block: gradients do not see the difference, single precision
  // does.
  const Vec3 frame = points.velocity[rows.begin];
  for (std::size_t s = 0; s < rows.touched.size(); ++s) {
    const Vec3 v = points.velocity[rows.touched[s]];
    block.velocity[s] = Lanes<T>{T(v[0] - frame[0]), T(v[1] - frame[1]), T(v[2] - frame[2]), 0};
    block.force[s] = Lanes<T>{};
  }
  for (std::size_t i = rows.begin; i < rows.end; ++i) {
    const std::uint32_t first = rows.start[i - rows.begin], last = rows.start[i - rows.begin + 1];
    if (first == last) continue; // free flight

    // (i) rates of F and of its derivatives
    std::array<std::array<Lanes<T>, 3>, 3>
        sum{}; // stabilised: [velocity component][derivative]; plain: [component][0]
    for (std::uint32_t p = first; p < last; ++p) {
      const Lanes<T> v = block.velocity[rows.column[p]];
      if constexpr (Stabilized) {
        for (int d = 0; d < 3; ++d) {
          const Lanes<T> g = rows.record[3 * p + d];
          for (int c = 0; c < 3; ++c) sum[c][d] += v[c] * g;
        }
      } else {
        for (int c = 0; c < 3; ++c) sum[c][0] += v[c] * rows.record[p];
      }
    }
    std::array<std::array<Lanes<double>, 3>, 3> rate;
    for (int c = 0; c < 3; ++c)
      for (int d = 0; d < 3; ++d)
        rate[c][d] = Stabilized ? __builtin_convertvector(sum[c][d], Lanes<double>)
                                : Lanes<double>{static_cast<double>(sum[c][0][d]), 0, 0, 0};

    // (ii) kinematics and objective rotation of the stresses
    const StepKinematics k = step_kinematics(rate, points.relative[i], dt);
    points.relative[i] = k.end;
    const Mat3 deformation = points.deformation(i);
    const double volume_ratio = determinant(deformation);
    if (!(volume_ratio > 0) || !std::isfinite(volume_ratio) || !(k.middle_factor > 0)) {
      block.bad = i;
      return;
    }
    for (int c = 0; c < 9; ++c)
      block.report.largest_change = std::max(block.report.largest_change, std::abs(k.end[c] - identity3[c]));
    const StressLanes before = rotate(k.rotation, points.stress[i]);

    // (iii) constitutive law on lane 0, its tangent on the moments
    Sym3 stress, increment;
    for (int c = 0; c < 6; ++c) stress[c] = before[c][0], increment[c] = k.increment[c][0];
    const Tangent tangent = material.update(
        stress, states[i],
        {.increment = increment, .dt = dt, .volume_ratio = volume_ratio, .deformation = deformation});
    StressLanes after = before;
    if constexpr (Stabilized)
      add_moment_increment(after, k.increment, tangent, inputs.integration.stabilization);
    for (int c = 0; c < 6; ++c) after[c][0] = stress[c];
    points.stress[i] = after;

    // (iv) work of the step, midpoint stress
    Lanes<double> work{};
    for (int c = 0; c < 6; ++c) work += (c < 3 ? 0.5 : 1.0) * (before[c] + after[c]) * k.increment[c];
    const double reference_volume = points.volume[i] * (volume_ratio / k.volume_factor);
    const double middle_volume = reference_volume * k.middle_factor;
    block.report.internal_work += middle_volume * work[0];
    block.report.stabilization_work += middle_volume * (work[1] + work[2] + work[3]);

    // (v) force on the neighbours: -V s : grad Psi, with the transpose of (i)
    const auto nominal = nominal_stress(after, k.end, -reference_volume * k.volume_factor);
    if constexpr (Stabilized) {
      std::array<std::array<Lanes<T>, 4>, 3> column;
      for (int d = 0; d < 3; ++d)
        for (int m = 0; m < 4; ++m)
          column[d][m] = Lanes<T>{T(nominal[d][0][m]), T(nominal[d][1][m]), T(nominal[d][2][m]), 0};
      for (std::uint32_t p = first; p < last; ++p) {
        Lanes<T> f = block.force[rows.column[p]];
        for (int d = 0; d < 3; ++d) {
          const Lanes<T> g = rows.record[3 * p + d];
          for (int m = 0; m < 4; ++m) f += g[m] * column[d][m];
        }
        block.force[rows.column[p]] = f;
      }
    } else {
      std::array<Lanes<T>, 3> column;
      for (int d = 0; d < 3; ++d)
        column[d] = Lanes<T>{T(nominal[d][0][0]), T(nominal[d][1][0]), T(nominal[d][2][0]), 0};
      for (std::uint32_t p = first; p < last; ++p) {
        const Lanes<T> g = rows.record[p];
        block.force[rows.column[p]] += g[0] * column[0] + g[1] * column[1] + g[2] * column[2];
      }
    }
  }
}

template<class Material, class T> void SolidOf<Material, T>::fail(std::size_t i, double time) const {
  const Vec3 x = points.position[i];
  const double ratio = determinant(points.deformation(i));
  throw ComputationError(
      "t = " + std::to_string(time * 1e6) + " us: the cell of point " + std::to_string(i) + " at (" +
      std::to_string(x[0] * 1e3) + ", " + std::to_string(x[1] * 1e3) + ", " + std::to_string(x[2] * 1e3) +
      ") mm has inverted (volume ratio " + std::to_string(ratio) +
      "); a smaller Time/Step factor, a shorter refresh interval or more stabilisation may help");
}

} // namespace

template<class Material>
std::unique_ptr<Solid> make_solid(const Material& material, Points points, SymmetryPlanes planes,
                                  const SolidInputs& inputs) {
  if (inputs.double_precision)
    return std::make_unique<SolidOf<Material, double>>(material, std::move(points), planes, inputs);
  return std::make_unique<SolidOf<Material, float>>(material, std::move(points), planes, inputs);
}

template std::unique_ptr<Solid> make_solid(const J2&, Points, SymmetryPlanes, const SolidInputs&);
template std::unique_ptr<Solid> make_solid(const Afc&, Points, SymmetryPlanes, const SolidInputs&);

} // namespace spall
