#pragma once

#include "macro/points/balance.h"
#include "macro/points/decomposition.h"
#include "macro/solid/conjugate_gradients.h"
#include "macro/solid/force_reduction.h"
#include "macro/solid/pair_loops.h"
#include "macro/solid/solid.h"
#include "macro/solid/stress_store.h"
#include "shared/error.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace spall {

/// A deformable body of one material with one numerical scheme.
/// Material: a law of the list (materials.h); T: float or double for pairs; Stress: one of the stores of
/// stress_store.h.
///
/// Its phases are defined in files of their own, which solid_of_law.h includes: solid_refresh.h (neighbours
/// and gradient operators), solid_correction.h (their linear correction), solid_step.h (stresses and forces
/// of a step), solid_stiffness.h (critical time step), solid_transfer.h (restart and redistribution).
template<class Material, class T, class Stress> class SolidOf final : public Solid {
public:
  SolidOf(const Material& material_, Points points_, SymmetryPlanes planes, const SolidInputs& inputs_)
      : Solid(planes, inputs_.ranks), material(material_), inputs(inputs_),
        stresses(points_.owned, inputs_.integration) {
    points = std::move(points_);
    make_blocks();
  }

  RefreshReport refresh(const RefreshChoice& choice) override;
  SolidReport update(double dt, double time, const Subcycle& subcycle) override;
  double critical_step() override;
  StressEnergy elastic_energy() const override;
  void transfer(Archive& archive) override;

  NeighborLists neighbor_lists() const override {
    NeighborLists lists{.start = {0}, .index = {}};
    for (const Block& block : blocks) {
      const GradientOperators<T>& operators = block.operators;
      const auto before = static_cast<std::uint32_t>(lists.index.size());
      for (std::size_t i = 0; i + 1 < operators.start.size(); ++i)
        lists.start.push_back(before + operators.start[i + 1]);
      for (const std::uint16_t c : operators.column) lists.index.push_back(operators.stencil[c]);
    }
    return lists;
  }
  std::vector<std::string> field_names() const override {
    std::vector<std::string> names;
    for (const auto& field : Material::fields) names.emplace_back(field.name);
    return names;
  }
  std::vector<std::string> field_units() const override {
    std::vector<std::string> units;
    for (const auto& field : Material::fields) units.emplace_back(field.unit);
    return units;
  }
  std::vector<double> field(const std::string& name) const override {
    std::string known;
    for (const auto& candidate : Material::fields) {
      if (name != candidate.name) {
        known += (known.empty() ? "" : ", ") + std::string(candidate.name);
        continue;
      }
      std::vector<double> values(points.owned);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = stresses.history(i, candidate.value);
      return values;
    }
    throw std::invalid_argument("the material of " + label + " has no field '" + name + "', only: " + known);
  }
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
      bytes += block.operators.memory_bytes() + sizeof(Lanes<T>) * block.force.capacity();
    for (const auto& one : scratch) bytes += 4 * (one.seen.capacity() + one.slot.capacity());
    for (const auto& velocity : velocities) bytes += sizeof(Lanes<T>) * velocity.capacity();
    return bytes;
  }

private:
  /// Consecutive points that are computed together, by one thread.
  struct Block {
    GradientOperators<T> operators;
    std::vector<Lanes<T>> force; ///< force on the stencil points, N
    SolidReport report;
    double change = 0;      ///< largest |F - 1| since the block's last refresh
    int skipped = 0;        ///< number of refreshes since then that have skipped the block
    double stable_step = 0; ///< smallest h / c at the last refresh, s
    int ratio = 1;          ///< steps of subcycling at once (Subcycle)
    std::size_t bad = none; ///< first point whose cell inverted or is not finite
    double cost = 0;        ///< processor time, s
  };
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  void make_blocks() {
    blocks = std::vector<Block>((points.owned + block_size - 1) / block_size);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      blocks[b].operators.begin = b * block_size;
      blocks[b].operators.end = std::min(points.owned, (b + 1) * block_size);
    }
  }

  // solid_refresh.h
  /// Blocks that a refresh rebuilds; it counts the others as left out.
  std::vector<std::size_t> choose_blocks(const RefreshChoice& choice);
  /// Makes the present configuration the reference of a block.
  /// @param reach box around the supports, m
  /// @return supports of the block's points
  std::vector<Support> new_supports(Block& block, Bounds& reach);
  /// Finds neighbours and builds ghosts and gradient operators of blocks in the present configuration.
  /// @return reason of a failure on this rank; empty if there is none
  std::string build_operators(const std::vector<std::size_t>& chosen,
                              const std::vector<std::vector<Support>>& supports,
                              const std::vector<Bounds>& reaches);
  /// Allocates the blocks' forces and finds out which blocks add to which points.
  void connect_blocks();
  /// Counts over all ranks. @throws ComputationError on all of them if `failure` is not empty on one
  RefreshReport report_refresh(const std::vector<std::size_t>& chosen, const std::string& failure,
                               const SolverReport& correction) const;

  // solid_correction.h
  /// Applies the linear correction (LinearCorrection). @throws ComputationError if it does not converge
  SolverReport correct_gradients();
  std::string why_not_corrected(const SolverReport& report, const std::vector<double>& residual) const;

  // solid_step.h
  /// Adds up the displacements of the steps of subcycling.
  void travel(double dt, const Subcycle& subcycle);
  /// @param impulse factor of the forces
  void update_block(Block& block, double dt, double impulse);
  using Group = PointGroup<Stress::group>;
  /// Sums of a block's groups, lane by lane.
  struct GroupReport {
    using V = typename Stress::V;
    V work = V{}, compression = V{}, tension = V{}, stabilization_work = V{}, largest_change = V{};

    void add_volumetric(const V& mean_stress, const V& energy) {
      compression += select(mean_stress < 0, energy, 0);
      tension += select(mean_stress < 0, 0, energy);
    }
    void add_to(SolidReport& report) const {
      for (int m = 0; m < Stress::group; ++m) {
        const auto lane = [m](const V& sums) { return get_lane<Stress::group, double>(sums, m); };
        report.work += {.total = lane(work), .compression = lane(compression), .tension = lane(tension)};
        report.stabilization_work += lane(stabilization_work);
        report.largest_change = std::max(report.largest_change, lane(largest_change));
      }
    }
  };
  /// The step of a group of points that have neighbours. @return a point whose cell inverts; `none` if there
  /// is none. Everything it calls is inlined: it is all arithmetic on registers, and calls would pass tens of
  /// vectors through memory.
  [[gnu::flatten]] std::size_t update_group(Block& block, const Group& group, const Lanes<T>* velocity,
                                            double dt, double impulse, GroupReport& report);
  /// Velocities of the block's stencil points, m/s, in this thread's memory: factor times a field.
  const Lanes<T>* stencil_velocities(const Block& block, const VectorField& field, double factor = 1);
  SolidReport report_update(double time) const;
  /// Returns a message on which cell has inverted, where and when.
  std::string failure(std::size_t point, double time) const;
  std::string describe(std::size_t point) const;
  StressEnergy elastic_energy(std::size_t i) const;

  // solid_stiffness.h
  /// Elastic force of the present configuration for the displacement field that is stored in points.velocity.
  void stiffness_block(Block& block);
  [[gnu::flatten]] void stiffness_point(Block& block, std::size_t i, std::uint32_t first, std::uint32_t last,
                                        const Lanes<T>* displacement);

  // solid_transfer.h
  /// Resizes the arrays to another number of points.
  void resize(std::size_t count);
  /// Transfers one block and its points. @param names names of the stencil points
  void transfer(Block& block, PointNames& names, Archive& archive);
  /// After reading: finds the places of stencil points and ghosts. @param ghosts_known whether the ghosts
  /// have been read too
  void connect(const std::vector<PointNames>& names, bool ghosts_known);

  const Material material;
  const SolidInputs inputs;
  Stress stresses;
  std::vector<Block> blocks;
  bool built = false; ///< whether the blocks have gradient operators
  ForceReduction reduction;
  std::vector<const std::vector<std::uint32_t>*> stencils; ///< stencils of the blocks
  std::vector<const Lanes<T>*> contributions;              ///< forces of the blocks on their stencil points
  std::array<VectorField, 3> travelled; ///< displacements in the periods of 2, 4, 8 steps under way, m
  tbb::enumerable_thread_specific<OperatorScratch<T>> scratch;
  tbb::enumerable_thread_specific<std::vector<Lanes<T>>> velocities;
};

} // namespace spall
