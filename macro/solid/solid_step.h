#pragma once

#include "macro/points/parallel.h"
#include "macro/solid/solid_of.h"

#include <algorithm>
#include <bit>

namespace spall {

template<class Material, class T, class Stress>
SolidReport SolidOf<Material, T, Stress>::update(double dt, double time, const Subcycle& subcycle) {
  ghosts.refresh(points, {&points.velocity});
  travel(dt, subcycle);
  const bool timed = ghosts.processes().several(), last = subcycle.ends(subcycle.steps);
  for_each_index(blocks.size(), [&](std::size_t b) {
    Block& block = blocks[b];
    block.report = {};
    contributions[b] = nullptr;
    if (!subcycle.ends(block.ratio)) return;
    const CostTimer timer(block.cost, timed);
    // The forces act over the next period, whose length the ratios of the next cycle decide.
    const int next = last ? subcycle.ratio(block.stable_step) : block.ratio;
    update_block(block, block.ratio * dt, next);
    block.ratio = next;
    contributions[b] = block.force.data();
  });
  const SolidReport report = report_update(time);
  reduction.sum<T>(stencils, contributions, points);
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
    sum.updates += block.report.updates;
  }
  return sum;
}

template<class Material, class T, class Stress>
void SolidOf<Material, T, Stress>::travel(double dt, const Subcycle& subcycle) {
  for (std::size_t k = 0; k < travelled.size(); ++k) {
    const int period = 2 << k;
    if (std::none_of(blocks.begin(), blocks.end(), [&](const Block& block) { return block.ratio == period; }))
      continue;
    travelled[k].resize(points.owned + ghosts.size());
    for (int c = 0; c < 3; ++c) {
      const std::vector<double>& velocity = points.velocity.component[c];
      std::vector<double>& sum = travelled[k].component[c];
      const double before = subcycle.begins(period) ? 0 : 1;
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = before * sum[i] + dt * velocity[i];
    }
  }
}

template<class Material, class T, class Stress>
void SolidOf<Material, T, Stress>::update_block(Block& block, double dt, double impulse) {
  const GradientOperators<T>& operators = block.operators;
  block.bad = none;
  if (operators.begin == operators.end) return;
  const Lanes<T>* velocity =
      block.ratio == 1
          ? stencil_velocities(block, points.velocity)
          : stencil_velocities(block, travelled[std::countr_zero(unsigned(block.ratio)) - 1], 1 / dt);
  block.report.updates = static_cast<double>(operators.end - operators.begin);
  block.force.assign(operators.stencil.size(), Lanes<T>{});
  Group group;
  GroupReport report;
  for (std::size_t i = operators.begin; i < operators.end; ++i) {
    const std::size_t row = i - operators.begin;
    if (operators.start[row] != operators.start[row + 1]) group.add(i); // free flight otherwise
    if (group.count < Stress::group && (group.count == 0 || i + 1 < operators.end)) continue;
    group.fill();
    block.bad = update_group(block, group, velocity, dt, impulse, report);
    if (block.bad != none) return;
    group.count = 0;
  }
  report.add_to(block.report);
  block.change = std::max(block.change, block.report.largest_change);
}

template<class Material, class T, class Stress>
std::size_t SolidOf<Material, T, Stress>::update_group(Block& block, const Group& group,
                                                       const Lanes<T>* velocity, double dt, double impulse,
                                                       GroupReport& report) {
  constexpr int L = Stress::lanes, P = Stress::group;
  using V = typename Stress::V;
  const GradientOperators<T>& operators = block.operators;

  // Where the pairs of a point begin, and those after them.
  const auto first = [&](int m) { return operators.start[group.point[m] - operators.begin]; };
  const auto last = [&](int m) { return operators.start[group.point[m] - operators.begin + 1]; };

  // (i) rates of F, kinematics of the step
  std::array<Mat<Lanes<T, L>>, P> gathered;
  for (int m = 0; m < group.count; ++m) gathered[m] = gather_rates<L>(operators, first(m), last(m), velocity);
  std::fill(gathered.begin() + group.count, gathered.end(), gathered[group.count - 1]);
  const auto rates = Stress::arrange(gathered);
  const Mat<V> start = load(points.relative, group);
  const auto k = step_kinematics(rates, stresses.node_rate(rates), start, dt);
  const Mat<V> deformation = multiply(k.end, load(points.reference, group));
  const V volume_ratio = determinant(deformation);
  const Mask<V> bad = !((volume_ratio > 0) & (volume_ratio < std::numeric_limits<double>::infinity()) &
                        (k.middle_factor > 0));
  if (any(bad)) return group.point[first_of(bad)];
  const V change = largest_components(k.end - identity_of<V>());

  // (ii) objective stress update, and its work
  Sym<V> stress = load(points.stress, group);
  const V start_trace = trace(stress);
  const auto result = stresses.advance(
      material, group, stress, k,
      StressStep<V>{.dt = dt,
                    .volume_ratio = volume_ratio,
                    .deformation = deformation,
                    .spacing = group.numbers(points.spacing),
                    .radius = operators.rings ? group.numbers(points.position.component[0]) : V{}});
  store(points.relative, group, k.end);
  store(points.stress, group, stress);
  const V reference_volume = group.numbers(points.volume) * (volume_ratio / k.volume_factor),
          mean_stress = (start_trace + trace(stress)) / 6.0;
  report.largest_change = larger(report.largest_change, change);
  report.work += reference_volume * k.middle_factor * result.work;
  report.stabilization_work += reference_volume * k.middle_factor * result.stabilization_work;
  report.add_volumetric(mean_stress, reference_volume * (k.volume_factor - determinant(start)) * mean_stress);

  // (iii) force on the neighbours: -V s : grad Psi
  std::array<Mat<typename Stress::W>, Stress::N> nominal;
  for (std::size_t n = 0; n < nominal.size(); ++n)
    nominal[n] = nominal_stress(result.stresses[n], k.end, V(-impulse * reference_volume * k.volume_factor));
  const auto separated = Stress::separate(nominal);
  const std::size_t ahead = numbers_of_pair<L> * (last(group.count - 1) - first(0)); // the next group
  for (int m = 0; m < group.count; ++m)
    scatter_forces<L>(operators, first(m), last(m), separated[m], block.force.data(), ahead);
  return none;
}

template<class Material, class T, class Stress>
StressEnergy SolidOf<Material, T, Stress>::elastic_energy() const {
  std::vector<StressEnergy> parts(blocks.size());
  for_each_index(blocks.size(), [&](std::size_t b) {
    for (std::size_t i = blocks[b].operators.begin; i < blocks[b].operators.end; ++i)
      parts[b] += elastic_energy(i);
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
  const double volume = points.volume[i] * determinant(points.deformation(i));
  const StoredEnergy stored = stresses.stored(material, i, points.stress[i]);
  StressEnergy energy{.total = volume * stored.total()};
  energy.add_volumetric(trace(points.stress[i]), volume * stored.volume);
  return energy;
}

template<class Material, class T, class Stress>
const Lanes<T>* SolidOf<Material, T, Stress>::stencil_velocities(const Block& block, const VectorField& field,
                                                                 double factor) {
  // Relative to one point of the block: gradients do not see the difference, single precision does. A radial
  // velocity that all rings have is a hoop strain, though.
  const GradientOperators<T>& operators = block.operators;
  Vec3 frame = field[operators.begin];
  if (operators.rings) frame[0] = 0;
  std::vector<Lanes<T>>& velocity = velocities.local();
  velocity.resize(std::max(velocity.size(), operators.stencil.size()));
  for (std::size_t s = 0; s < operators.stencil.size(); ++s) {
    const auto [x, y, z] = convert<T>(factor * (field[operators.stencil[s]] - frame));
    velocity[s] = Lanes<T>{x, y, z, 0};
  }
  return velocity.data();
}

template<class Material, class T, class Stress>
std::string SolidOf<Material, T, Stress>::describe(std::size_t i) const {
  const Vec3 x = points.position[i];
  return "point " + std::to_string(i) + " at (" + std::to_string(x[0] * 1e3) + ", " +
         std::to_string(x[1] * 1e3) + ", " + std::to_string(x[2] * 1e3) + ") mm";
}

template<class Material, class T, class Stress>
std::string SolidOf<Material, T, Stress>::failure(std::size_t i, double time) const {
  return "t = " + std::to_string(time * 1e6) + " us: the cell of " + describe(i) +
         " has inverted (volume ratio " + std::to_string(determinant(points.deformation(i))) +
         "); a smaller Time/Step factor, a shorter refresh interval or more stabilisation may help";
}

} // namespace spall
