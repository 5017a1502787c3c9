#pragma once

#include "macro/points/parallel.h"
#include "macro/solid/lanczos.h"
#include "macro/solid/solid_of.h"

namespace spall {

/// The largest eigenvalue is taken as known when the residual is this part of it (half of that part of the
/// step), or after so many applications of the stiffness, of which each costs somewhat less than a step.
constexpr double critical_tolerance = 0.02;
constexpr int critical_applications = 40;

template<class Material, class T, class Stress> double SolidOf<Material, T, Stress>::critical_step() {
  // The displacement takes the place of the velocity, and the force it causes that of the internal force: the
  // same loops and ghosts serve both.
  const VectorField velocity = points.velocity, force = points.force;
  const auto apply = [&](const std::vector<double>& x, std::vector<double>& y) {
    for (std::size_t i = 0; i < points.owned; ++i)
      for (int c = 0; c < 3; ++c) points.velocity.component[c][i] = x[3 * i + c] / std::sqrt(points.mass[i]);
    ghosts.refresh(points, {&points.velocity});
    for_each_index(blocks.size(), [&](std::size_t b) {
      stiffness_block(blocks[b]);
      contributions[b] = blocks[b].force.data();
    });
    reduction.sum<T>(stencils, contributions, points);
    ghosts.add_back(points);
    for (std::size_t i = 0; i < points.owned; ++i)
      for (int c = 0; c < 3; ++c) y[3 * i + c] = -points.force.component[c][i] / std::sqrt(points.mass[i]);
  };
  const EigenvalueEstimate largest =
      largest_eigenvalue(3 * points.owned, apply, critical_tolerance, critical_applications,
                         ghosts.processes(), 3 * ghosts.remote_points().first());
  points.velocity = velocity;
  points.force = force;
  return 2 / std::sqrt(largest.value + largest.residual);
}

template<class Material, class T, class Stress>
void SolidOf<Material, T, Stress>::stiffness_block(Block& block) {
  const GradientOperators<T>& operators = block.operators;
  if (operators.begin == operators.end) return;
  const Lanes<T>* displacement = stencil_velocities(block, points.velocity);
  block.force.assign(operators.stencil.size(), Lanes<T>{});
  for (std::size_t i = operators.begin; i < operators.end; ++i) {
    const std::uint32_t first = operators.start[i - operators.begin],
                        last = operators.start[i - operators.begin + 1];
    if (first != last) stiffness_point(block, i, first, last, displacement);
  }
}

template<class Material, class T, class Stress>
void SolidOf<Material, T, Stress>::stiffness_point(Block& block, std::size_t i, std::uint32_t first,
                                                   std::uint32_t last, const Lanes<T>* displacement) {
  constexpr int L = Stress::lanes;
  const Mat3& f = points.relative[i];
  const MatLanes<L> rate =
      convert_lanes<L, double, T>(gather_rates<L>(block.operators, first, last, displacement));
  const SymLanes<L> strain = symmetric_part(multiply(rate, inverse(f)));
  // Steps that are m times as long as those of the run see the stiffness m^2 times.
  const double volume = points.volume[i] * determinant(points.deformation(i)) * block.ratio * block.ratio;
  const MatLanes<L> nominal = nominal_stress(stresses.elastic(material, i, strain), f, -volume);
  scatter_forces<L>(block.operators, first, last, convert_lanes<L, T, double>(nominal), block.force.data());
}

} // namespace spall
