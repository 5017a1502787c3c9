#pragma once

#include "macro/points/parallel.h"
#include "macro/solid/solid_of.h"

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
  for (std::size_t i = operators.begin; i < operators.end; ++i) {
    const std::uint32_t first = operators.start[i - operators.begin],
                        last = operators.start[i - operators.begin + 1];
    if (first == last) continue; // free flight
    if (!update_point(block, i, first, last, velocity, dt, impulse)) {
      block.bad = i;
      return;
    }
  }
  block.change = std::max(block.change, block.report.largest_change);
}

template<class Material, class T, class Stress>
bool SolidOf<Material, T, Stress>::update_point(Block& block, std::size_t i, std::uint32_t first,
                                                std::uint32_t last, const Lanes<T>* velocity, double dt,
                                                double impulse) {
  constexpr int L = Stress::lanes;

  // (i) rates of F, kinematics of the step
  const MatLanes<L> rate = gather_rates<L>(block.operators, first, last, velocity);
  const auto k =
      step_kinematics<L, typename Stress::Spin>(rate, stresses.node_rate(rate), points.relative[i], dt);
  const double start_factor = determinant(points.relative[i]);
  points.relative[i] = k.end;
  const Mat3 deformation = points.deformation(i);
  const double volume_ratio = determinant(deformation);
  if (!(volume_ratio > 0) || !std::isfinite(volume_ratio) || !(k.middle_factor > 0)) return false;
  block.report.largest_change = std::max(block.report.largest_change, largest_component(k.end - identity3));

  // (ii) objective stress update, and its work
  const double start_trace = trace(points.stress[i]);
  const auto result =
      stresses.advance(material, i, points.stress[i], k,
                       {.dt = dt,
                        .volume_ratio = volume_ratio,
                        .deformation = deformation,
                        .spacing = points.spacing[i],
                        .radius = block.operators.rings ? points.position.component[0][i] : 0});
  const double reference_volume = points.volume[i] * (volume_ratio / k.volume_factor);
  block.report.work.total += reference_volume * k.middle_factor * result.work;
  const double mean_stress = (start_trace + trace(points.stress[i])) / 6;
  block.report.work.add_volumetric(mean_stress,
                                   reference_volume * (k.volume_factor - start_factor) * mean_stress);
  block.report.stabilization_work += reference_volume * k.middle_factor * result.stabilization_work;

  // (iii) force on the neighbours: -V s : grad Psi
  scatter_forces<L>(block.operators, first, last,
                    nominal_stress(result.stresses, k.end, -impulse * reference_volume * k.volume_factor),
                    block.force.data());
  return true;
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
