#pragma once

#include "macro/points/neighbor_search.h"
#include "macro/points/parallel.h"
#include "macro/solid/solid_of.h"

namespace spall {

template<class Material, class T, class Stress>
RefreshReport SolidOf<Material, T, Stress>::refresh(const RefreshChoice& choice) {
  const std::vector<std::size_t> chosen = choose_blocks(choice);
  // The present configuration becomes the reference of the next gradients; the support follows the
  // deformation.
  const bool keep = built && inputs.approximation.configuration == Configuration::lagrangian;
  std::vector<std::vector<Support>> supports(chosen.size());
  std::vector<Bounds> reaches(chosen.size());
  for_each_index(chosen.size(), [&](std::size_t k) {
    Block& block = blocks[chosen[k]];
    if (keep) push_forward(block.operators, points.relative);
    supports[k] = new_supports(block, reaches[k]);
  });
  if (keep) return report_refresh(chosen, {}, {});
  const std::string failed = build_operators(chosen, supports, reaches);
  SolverReport correction;
  // The correction needs all ranks: if one of them has failed, the report below says so on all.
  if (inputs.integration.correction == Correction::linear && !ghosts.processes().any(!failed.empty())) {
    connect_blocks();
    correction = correct_gradients();
  }
  if (ghosts.symmetry().axis && failed.empty()) {
    for_each_index(chosen.size(),
                   [&](std::size_t k) { join_images(blocks[chosen[k]].operators, ghosts, points); });
    ghosts.drop_images(points);
  }
  connect_blocks();
  return report_refresh(chosen, failed, correction);
}

template<class Material, class T, class Stress>
std::vector<std::size_t> SolidOf<Material, T, Stress>::choose_blocks(const RefreshChoice& choice) {
  // The correction ties the gradients of all points together: with it all blocks are rebuilt.
  const bool all = !built || inputs.integration.correction == Correction::linear;
  std::vector<std::size_t> chosen;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (all || blocks[b].change >= choice.least_change || blocks[b].skipped >= choice.most_skipped)
      chosen.push_back(b);
    else
      ++blocks[b].skipped;
  }
  return chosen;
}

template<class Material, class T, class Stress>
std::vector<Support> SolidOf<Material, T, Stress>::new_supports(Block& block, Bounds& reach) {
  const SupportInputs support_inputs = inputs.approximation.present_support();
  const double extent = reach_of(inputs.integration.scheme, inputs.approximation.support.normalized_size);
  std::vector<Support> supports;
  block.change = 0;
  block.skipped = 0;
  block.stable_step = std::numeric_limits<double>::infinity();
  for (std::size_t i = block.operators.begin; i < block.operators.end; ++i) {
    points.reference[i] = points.deformation(i);
    points.relative[i] = identity3;
    Mat3 shape = points.reference[i];
    // Around the axis the cell is as wide as the gap of the images.
    if (ghosts.symmetry().axis)
      shape(1, 1) = gap_on_ring(points.position.component[0][i], points.spacing[i]) / points.spacing[i];
    supports.push_back(make_support(shape, points.spacing[i], support_inputs));
    reach.add(points.position[i], supports.back().half_widths(extent));
    block.stable_step = std::min(block.stable_step, points.spacing[i] * supports.back().smallest_stretch /
                                                        material.sound_speed(stresses.state(i)));
  }
  return supports;
}

template<class Material, class T, class Stress>
std::string SolidOf<Material, T, Stress>::build_operators(const std::vector<std::size_t>& chosen,
                                                          const std::vector<std::vector<Support>>& supports,
                                                          const std::vector<Bounds>& reaches) {
  Vec3 reach{}; // beyond the coordinate planes
  for (const Bounds& box : reaches)
    for (int c = 0; c < 3; ++c) reach[c] = std::max(reach[c], -box.low[c]);
  const bool some_left_out = ghosts.processes().any(chosen.size() < blocks.size());
  ghosts.rebuild(points, reach, some_left_out, reaches);
  NeighborSearch search; // not stored between refreshes, because it is as large as one or two fields
  if (points.owned > 0)
    search.rebuild(points, *std::min_element(points.spacing.begin(), points.spacing.end()));
  std::vector<std::string> failures(chosen.size());
  for_each_index(chosen.size(), [&](std::size_t k) {
    Block& block = blocks[chosen[k]];
    const CostTimer timer(block.cost, ghosts.processes().several());
    failures[k] = build_gradient_operators(block.operators,
                                           {.points = points,
                                            .search = search,
                                            .supports = supports[k],
                                            .approximation = inputs.approximation,
                                            .integration = inputs.integration,
                                            .cells = inputs.cells.get()},
                                           scratch.local());
  });
  const auto first = std::find_if(failures.begin(), failures.end(), [](const auto& f) { return !f.empty(); });
  return first == failures.end() ? std::string() : label + ": " + *first;
}

template<class Material, class T, class Stress> void SolidOf<Material, T, Stress>::connect_blocks() {
  stencils.clear();
  contributions.clear();
  for (Block& block : blocks) {
    block.force.resize(block.operators.stencil.size());
    stencils.push_back(&block.operators.stencil);
    contributions.push_back(block.force.data());
  }
  reduction.rebuild(stencils, points.owned + ghosts.size(), block_size);
  built = true;
}

template<class Material, class T, class Stress>
RefreshReport SolidOf<Material, T, Stress>::report_refresh(const std::vector<std::size_t>& chosen,
                                                           const std::string& failure,
                                                           const SolverReport& correction) const {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  RefreshReport report{.smallest_step = infinite,
                       .stable_step = infinite,
                       .correction_iterations = correction.iterations,
                       .correction_residual = correction.residual};
  for (const std::size_t b : chosen) report.rebuilt += blocks[b].operators.end - blocks[b].operators.begin;
  for (const Block& block : blocks) {
    report.pairs += block.operators.column.size();
    report.regularized += block.operators.regularized;
    report.isolated += block.operators.isolated;
    report.smallest_fraction = std::min(report.smallest_fraction, block.operators.smallest_fraction);
    report.smallest_step = std::min(report.smallest_step, block.stable_step);
    report.stable_step = std::min(report.stable_step, block.stable_step / block.ratio);
  }
  double failed = !failure.empty();
  Reduction all{.largest = {&failed},
                .smallest = {&report.smallest_fraction, &report.smallest_step, &report.stable_step},
                .counts = {&report.rebuilt, &report.pairs, &report.regularized, &report.isolated}};
  const Ranks& ranks = ghosts.processes();
  ranks.reduce(all);
  if (failed > 0)
    throw ComputationError(
        ranks.gather(failure.empty() ? std::vector<std::string>{} : std::vector<std::string>{failure})
            .front());
  return report;
}

} // namespace spall
