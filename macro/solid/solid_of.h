#pragma once

#include "macro/points/balance.h"
#include "macro/points/decomposition.h"
#include "macro/points/neighbor_search.h"
#include "macro/points/parallel.h"
#include "macro/solid/force_reduction.h"
#include "macro/solid/pair_loops.h"
#include "macro/solid/solid.h"
#include "macro/solid/stress_store.h"
#include "shared/error.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace spall {

/// Material: J2 or Afc; T: float or double for pairs; Stress: one of the stores of stress_store.h.
template<class Material, class T, class Stress> class SolidOf final : public Solid {
public:
  SolidOf(const Material& material_, Points points_, SymmetryPlanes planes, const SolidInputs& inputs_)
      : Solid(planes, inputs_.ranks), material(material_), inputs(inputs_),
        stresses(points_.owned, {lanes_of(inputs_.integration), inputs_.integration.stabilization}) {
    points = std::move(points_);
    make_blocks();
  }

  RefreshReport refresh(const RefreshChoice& choice) override;
  SolidReport update(double dt, double time) override;
  /// Defined in solid_stiffness.h, like what it calls.
  double critical_step() override;
  NeighborLists neighbor_lists() const override {
    NeighborLists lists{.start = {0}, .index = {}};
    for (const Block& block : blocks) {
      for (std::size_t i = 0; i + 1 < block.rows.start.size(); ++i)
        lists.start.push_back(static_cast<std::uint32_t>(lists.index.size()) + block.rows.start[i + 1]);
      for (const std::uint16_t c : block.rows.column) lists.index.push_back(block.rows.touched[c]);
    }
    return lists;
  }
  StressEnergy elastic_energy() const override;

  std::vector<std::string> field_names() const override {
    std::vector<std::string> names;
    for (const auto& [name, member] : Material::fields) names.emplace_back(name);
    return names;
  }
  std::vector<double> field(const std::string& name) const override {
    std::vector<double> values(points.owned);
    for (const auto& [candidate, member] : Material::fields)
      if (name == candidate)
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = stresses.history(i, member);
    return values;
  }
  /// Defined in solid_transfer.h.
  void transfer(Archive& archive) override;
  std::vector<double> take_costs() override {
    std::vector<double> costs;
    for (Block& block : blocks) costs.push_back(std::exchange(block.cost, 0));
    return costs;
  }
  double bulk_modulus() const override { return material.bulk_modulus(); }
  double shear_modulus() const override { return material.shear_modulus(); }
  std::size_t memory_bytes() const override {
    std::size_t bytes = stresses.memory_bytes() + points.memory_bytes() + ghosts.memory_bytes() +
                        reduction.memory_bytes() + sizeof(Block) * blocks.capacity();
    for (const Block& block : blocks)
      bytes += block.rows.memory_bytes() + sizeof(Lanes<T>) * block.force.capacity();
    for (const auto& one : scratch) bytes += 4 * (one.seen.capacity() + one.slot.capacity());
    for (const auto& velocity : velocities) bytes += sizeof(Lanes<T>) * velocity.capacity();
    return bytes;
  }

private:
  struct Block {
    GradientRows<T> rows;
    std::vector<Lanes<T>> force; ///< of this block on the points it touches
    SolidReport report;
    double change = 0;      ///< largest |F - 1| since its last refresh
    int skipped = 0;        ///< refreshes since then
    double stable_step = 0; ///< smallest h / c then, s
    std::size_t bad = none; ///< first point that inverted or is not finite
    double cost = 0;        ///< processor time, s
  };
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  void make_blocks() {
    blocks = std::vector<Block>((points.owned + block_size - 1) / block_size);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      blocks[b].rows.begin = b * block_size;
      blocks[b].rows.end = std::min(points.owned, (b + 1) * block_size);
    }
  }
  /// Makes room for the states of so many points.
  void hold(std::size_t count) {
    points.resize(count);
    stresses = Stress(count, {lanes_of(inputs.integration), inputs.integration.stabilization});
    make_blocks();
  }
  /// Of one block and its points. @param names of the points it touches
  void transfer(Block& block, PointNames& names, Archive& archive);
  /// After loading: gives rows and ghosts their places. @param ghosts_known are as they were
  void connect(const std::vector<PointNames>& names, bool ghosts_known);
  /// Makes the present configuration the reference of a block. @param reach box around the supports
  std::vector<Support> new_supports(Block& block, Bounds& reach);
  /// Neighbours, ghosts and rows of blocks in the present configuration.
  void build_shape_functions(const std::vector<std::size_t>& chosen,
                             const std::vector<std::vector<Support>>& supports,
                             const std::vector<Bounds>& reaches);
  /// Of all ranks.
  RefreshReport report_refresh(const std::vector<std::size_t>& chosen) const;
  SolidReport report_update(double time) const;
  /// Room for the blocks' forces, and who adds to whom.
  void connect_blocks();
  /// Changes the gradients as little as possible so that a constant stress exerts no force on points inside
  /// (linear patch test) while they stay exact for linears. Strains and forces use the same gradients: energy
  /// and momenta are kept as without it. Defined in solid_correction.h.
  void make_consistent();
  void update_block(Block& block, double dt);
  /// The step of one point with the pairs [first, last). @return false if its cell inverts. Everything it
  /// calls is inlined: it is all arithmetic on registers, and calls would pass tens of vectors through
  /// memory.
  [[gnu::flatten]] bool update_point(Block& block, std::size_t i, std::uint32_t first, std::uint32_t last,
                                     const Lanes<T>* velocity, double dt);
  /// Velocities of the points that the block touches, in this thread's memory.
  const Lanes<T>* touched_velocities(const Block& block);
  StressEnergy elastic_energy(std::size_t i) const;
  /// Elastic force of the present configuration for the displacement field in `velocity` of the touched
  /// points.
  void stiffness_block(Block& block);
  [[gnu::flatten]] void stiffness_point(Block& block, std::size_t i, std::uint32_t first, std::uint32_t last,
                                        const Lanes<T>* displacement);
  /// What to say of a point whose cell has inverted.
  std::string failure(std::size_t point, double time) const;

  const Material material;
  const SolidInputs inputs;
  Stress stresses;
  std::vector<Block> blocks;
  bool built = false; ///< whether the blocks have rows
  ForceReduction reduction;
  std::vector<const std::vector<std::uint32_t>*> touched;
  std::vector<const Lanes<T>*> contributions;
  tbb::enumerable_thread_specific<RowScratch<T>> scratch;
  tbb::enumerable_thread_specific<std::vector<Lanes<T>>> velocities;
};

template<class Material, class T, class Stress>
RefreshReport SolidOf<Material, T, Stress>::refresh(const RefreshChoice& choice) {
  // The correction ties the gradients of all points together: then all are rebuilt.
  // Around the axis the images that the gradients see change with every refresh.
  const bool all = !built || inputs.integration.correction == Correction::linear || ghosts.symmetry().axis;
  std::vector<std::size_t> chosen;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (all || blocks[b].change >= choice.least_change || blocks[b].skipped >= choice.most_skipped)
      chosen.push_back(b);
    else
      ++blocks[b].skipped;
  }
  // The present configuration becomes the reference of the next gradients; the support follows the
  // deformation.
  const bool keep = built && inputs.approximation.configuration == Configuration::lagrangian;
  std::vector<std::vector<Support>> supports(chosen.size());
  std::vector<Bounds> reaches(chosen.size());
  for_each_index(chosen.size(), [&](std::size_t k) {
    Block& block = blocks[chosen[k]];
    if (keep) push_forward(block.rows, points.relative);
    supports[k] = new_supports(block, reaches[k]);
  });
  if (!keep) build_shape_functions(chosen, supports, reaches);
  return report_refresh(chosen);
}

template<class Material, class T, class Stress>
RefreshReport SolidOf<Material, T, Stress>::report_refresh(const std::vector<std::size_t>& chosen) const {
  RefreshReport report{.stable_step = std::numeric_limits<double>::infinity()};
  for (const std::size_t b : chosen) report.rebuilt += blocks[b].rows.end - blocks[b].rows.begin;
  for (const Block& block : blocks) {
    report.pairs += block.rows.column.size();
    report.regularized += block.rows.regularized;
    report.isolated += block.rows.isolated;
    report.smallest_fraction = std::min(report.smallest_fraction, block.rows.smallest_fraction);
    report.stable_step = std::min(report.stable_step, block.stable_step);
  }
  Reduction all{.smallest = {&report.smallest_fraction, &report.stable_step},
                .counts = {&report.rebuilt, &report.pairs, &report.regularized, &report.isolated}};
  ghosts.processes().reduce(all);
  return report;
}

template<class Material, class T, class Stress>
std::vector<Support> SolidOf<Material, T, Stress>::new_supports(Block& block, Bounds& reach) {
  const SupportInputs support_inputs = inputs.approximation.present_support();
  const double extent = reach_of(inputs.integration.scheme, inputs.approximation.support.normalized_size);
  std::vector<Support> supports;
  block.change = 0;
  block.skipped = 0;
  block.stable_step = std::numeric_limits<double>::infinity();
  for (std::size_t i = block.rows.begin; i < block.rows.end; ++i) {
    points.reference[i] = points.deformation(i);
    points.relative[i] = identity3;
    Mat3 shape = points.reference[i];
    // Around the axis the cell is as wide as the gap of the images.
    if (ghosts.symmetry().axis)
      shape[4] = gap_on_ring(points.position.component[0][i], points.spacing[i]) / points.spacing[i];
    supports.push_back(make_support(shape, points.spacing[i], support_inputs));
    reach.add(points.position[i], supports.back().half_widths(extent));
    block.stable_step = std::min(block.stable_step, points.spacing[i] * supports.back().smallest_stretch /
                                                        material.sound_speed(stresses.state(i)));
  }
  return supports;
}

template<class Material, class T, class Stress>
void SolidOf<Material, T, Stress>::build_shape_functions(const std::vector<std::size_t>& chosen,
                                                         const std::vector<std::vector<Support>>& supports,
                                                         const std::vector<Bounds>& reaches) {
  Vec3 reach{}; // beyond the coordinate planes
  for (const Bounds& box : reaches)
    for (int c = 0; c < 3; ++c) reach[c] = std::max(reach[c], -box.low[c]);
  const bool some_left_out = ghosts.processes().any(chosen.size() < blocks.size());
  ghosts.rebuild(points, reach, some_left_out, reaches);
  NeighborSearch search; // as large as a field or two: not kept
  if (points.owned > 0)
    search.rebuild(points, *std::min_element(points.spacing.begin(), points.spacing.end()));
  ghosts.processes().on_all([&] { // a cloud that has collapsed on one rank stops all of them
    for_each_index(chosen.size(), [&](std::size_t k) {
      Block& block = blocks[chosen[k]];
      const CostTimer timer(block.cost, ghosts.processes().several());
      build_rows(block.rows, points, search, supports[k], inputs.approximation, inputs.integration,
                 inputs.cells.get(), scratch.local());
    });
  });
  connect_blocks();
  if (inputs.integration.correction == Correction::linear) make_consistent();
}

template<class Material, class T, class Stress> void SolidOf<Material, T, Stress>::connect_blocks() {
  touched.clear();
  contributions.clear();
  for (Block& block : blocks) {
    block.force.resize(block.rows.touched.size());
    touched.push_back(&block.rows.touched);
    contributions.push_back(block.force.data());
  }
  reduction.rebuild(touched, points.owned + ghosts.size(), block_size);
  built = true;
}

template<class Material, class T, class Stress>
SolidReport SolidOf<Material, T, Stress>::update(double dt, double time) {
  ghosts.refresh(points, {&points.velocity});
  const bool timed = ghosts.processes().several();
  for_each_index(blocks.size(), [&](std::size_t b) {
    const CostTimer timer(blocks[b].cost, timed);
    update_block(blocks[b], dt);
  });
  const SolidReport report = report_update(time);
  reduction.sum<T>(touched, contributions, points);
  ghosts.add_back(points);
  return report;
}

template<class Material, class T, class Stress>
SolidReport SolidOf<Material, T, Stress>::report_update(double time) const {
  SolidReport sum;
  for (const Block& block : blocks) {
    if (block.bad != none && sum.failure.empty()) sum.failure = failure(block.bad, time);
    sum.work += block.report.work;
    sum.stabilization_work += block.report.stabilization_work;
    sum.largest_change = std::max(sum.largest_change, block.report.largest_change);
  }
  return sum;
}

template<class Material, class T, class Stress>
void SolidOf<Material, T, Stress>::update_block(Block& block, double dt) {
  const GradientRows<T>& rows = block.rows;
  block.report = {};
  block.bad = none;
  if (rows.begin == rows.end) return;
  const Lanes<T>* velocity = touched_velocities(block);
  block.force.assign(rows.touched.size(), Lanes<T>{});
  for (std::size_t i = rows.begin; i < rows.end; ++i) {
    const std::uint32_t first = rows.start[i - rows.begin], last = rows.start[i - rows.begin + 1];
    if (first == last) continue; // free flight
    if (!update_point(block, i, first, last, velocity, dt)) {
      block.bad = i;
      return;
    }
  }
  block.change = std::max(block.change, block.report.largest_change);
}

template<class Material, class T, class Stress>
bool SolidOf<Material, T, Stress>::update_point(Block& block, std::size_t i, std::uint32_t first,
                                                std::uint32_t last, const Lanes<T>* velocity, double dt) {
  constexpr int L = Stress::lanes;

  // (i) rates of F, kinematics of the step
  const MatLanes<L> rate = gather_rates<L>(block.rows, first, last, velocity);
  const auto k =
      step_kinematics<L, typename Stress::Spin>(rate, stresses.node_rate(rate), points.relative[i], dt);
  const double start_factor = determinant(points.relative[i]);
  points.relative[i] = k.end;
  const Mat3 deformation = points.deformation(i);
  const double volume_ratio = determinant(deformation);
  if (!(volume_ratio > 0) || !std::isfinite(volume_ratio) || !(k.middle_factor > 0)) return false;
  for (int c = 0; c < 9; ++c)
    block.report.largest_change = std::max(block.report.largest_change, std::abs(k.end[c] - identity3[c]));

  // (ii) objective stress update, and its work
  const double start_trace = trace(points.stress[i]);
  const auto result = stresses.advance(
      material, i, points.stress[i], k,
      {.dt = dt, .volume_ratio = volume_ratio, .deformation = deformation, .spacing = points.spacing[i]});
  const double reference_volume = points.volume[i] * (volume_ratio / k.volume_factor);
  block.report.work.total += reference_volume * k.middle_factor * result.work;
  const double mean_stress = (start_trace + trace(points.stress[i])) / 6;
  block.report.work.add_volumetric(mean_stress,
                                   reference_volume * (k.volume_factor - start_factor) * mean_stress);
  block.report.stabilization_work += reference_volume * k.middle_factor * result.stabilization_work;

  // (iii) force on the neighbours: -V s : grad Psi
  scatter_forces<L>(block.rows, first, last,
                    nominal_stress<L>(result.lanes, k.end, -reference_volume * k.volume_factor),
                    block.force.data());
  return true;
}

template<class Material, class T, class Stress>
StressEnergy SolidOf<Material, T, Stress>::elastic_energy() const {
  std::vector<StressEnergy> parts(blocks.size());
  for_each_index(blocks.size(), [&](std::size_t b) {
    for (std::size_t i = blocks[b].rows.begin; i < blocks[b].rows.end; ++i) parts[b] += elastic_energy(i);
  });
  StressEnergy sum;
  for (const StressEnergy& part : parts) sum += part;
  Reduction all;
  sum.list(all);
  ghosts.processes().reduce(all);
  return sum;
}

template<class Material, class T, class Stress>
StressEnergy SolidOf<Material, T, Stress>::elastic_energy(std::size_t i) const {
  const Tangent tangent = material.elastic(stresses.state(i));
  const double volume = points.volume[i] * determinant(points.deformation(i));
  const double mean = trace(points.stress[i]) / 3;
  const Sym3 s = deviator(points.stress[i]);
  const double volumetric = volume * mean * mean / (2 * tangent.bulk);
  StressEnergy energy{.total = volumetric + volume * contract(s, s) / (4 * tangent.shear)};
  energy.add_volumetric(mean, volumetric);
  return energy;
}

template<class Material, class T, class Stress>
const Lanes<T>* SolidOf<Material, T, Stress>::touched_velocities(const Block& block) {
  // Relative to one point of the block: gradients do not see the difference, single precision does.
  const GradientRows<T>& rows = block.rows;
  const Vec3 frame = points.velocity[rows.begin];
  std::vector<Lanes<T>>& velocity = velocities.local();
  velocity.resize(std::max(velocity.size(), rows.touched.size()));
  for (std::size_t s = 0; s < rows.touched.size(); ++s) {
    const Vec3 v = points.velocity[rows.touched[s]];
    velocity[s] = Lanes<T>{T(v[0] - frame[0]), T(v[1] - frame[1]), T(v[2] - frame[2]), 0};
  }
  return velocity.data();
}

template<class Material, class T, class Stress>
std::string SolidOf<Material, T, Stress>::failure(std::size_t i, double time) const {
  const Vec3 x = points.position[i];
  const double ratio = determinant(points.deformation(i));
  return "t = " + std::to_string(time * 1e6) + " us: the cell of point " + std::to_string(i) + " at (" +
         std::to_string(x[0] * 1e3) + ", " + std::to_string(x[1] * 1e3) + ", " + std::to_string(x[2] * 1e3) +
         ") mm has inverted (volume ratio " + std::to_string(ratio) +
         "); a smaller Time/Step factor, a shorter refresh interval or more stabilisation may help";
}

template<class Material, class T>
std::unique_ptr<Solid> make_solid_of(const Material& material, Points points, SymmetryPlanes planes,
                                     const SolidInputs& inputs) {
  const auto with = [&]<class Stress>() -> std::unique_ptr<Solid> {
    return std::make_unique<SolidOf<Material, T, Stress>>(material, std::move(points), planes, inputs);
  };
  const LaneLayout layout = lanes_of(inputs.integration);
  switch (layout.use) {
  case LaneUse::none:
    break;
  case LaneUse::moments:
    return layout.width == 4 ? with.template operator()<MomentStress<Material, T, 4>>()
                             : with.template operator()<MomentStress<Material, T, 8>>();
  case LaneUse::subpoints:
    return layout.width == 4 ? with.template operator()<SubpointStress<Material, T, 4>>()
                             : with.template operator()<SubpointStress<Material, T, 8>>();
  }
  return with.template operator()<PlainStress<Material, T>>();
}

template<class Material>
std::unique_ptr<Solid> make_solid(const Material& material, Points points, SymmetryPlanes planes,
                                  SolidInputs inputs) {
  inputs.integration.axisymmetric = planes.axis;
  const Share share = share_of(points.owned, inputs.ranks, block_size);
  if (inputs.ranks.several() && inputs.cells)
    inputs.cells = std::make_shared<const ConformingCells>(part_of(*inputs.cells, share));
  points = part_of(std::move(points), share);
  if (inputs.double_precision)
    return make_solid_of<Material, double>(material, std::move(points), planes, inputs);
  return make_solid_of<Material, float>(material, std::move(points), planes, inputs);
}

} // namespace spall
