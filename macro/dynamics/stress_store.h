#pragma once

#include "macro/dynamics/point_kinematics.h"

#include <vector>

namespace spall {

/// What a point knows at the end of a step's kinematics.
struct StressStep {
  double dt;               ///< s
  double volume_ratio;     ///< J at the end of the step
  const Mat3& deformation; ///< F at the end of the step
};

/// Stresses of one point for its force, and the work of the step per middle volume (midpoint stress), J/m^3.
template<int L> struct StressResult {
  SymLanes<L> lanes; ///< one per lane of the rows, Pa
  double work, stabilization_work;
};

/// The stores below keep what the points of a scheme remember besides their Cauchy stress (`stress`, at the
/// end of the last step on entry, of this step on return), and advance it. All have the same interface.

/// One gradient per point: one stress, one material state.
template<class Material, class T> class PlainStress {
public:
  static constexpr int lanes = 1;
  using Spin = double; ///< all lanes turn with the point
  using Kinematics = StepKinematics<1>;
  using State = typename Material::State;

  explicit PlainStress(std::size_t count, double = 0) : states(count) {}

  StressResult<1> advance(const Material& material, std::size_t i, Sym3& stress, const Kinematics& k,
                          const StressStep& step) {
    const Sym3 before = rotate(k.rotation, stress);
    stress = before;
    material.update(stress, states[i],
                    {.increment = k.increment,
                     .dt = step.dt,
                     .volume_ratio = step.volume_ratio,
                     .deformation = step.deformation});
    return {stress, 0.5 * (contract(before, k.increment) + contract(stress, k.increment)), 0};
  }
  const State& state(std::size_t i) const { return states[i]; }
  double history(std::size_t i, double State::*member) const { return states[i].*member; }
  std::size_t memory_bytes() const { return states.size() * sizeof(State); }

private:
  std::vector<State> states;
};

/// A stress and its moments, which go with the derivatives of the strain over the nodal cell (lanes 1 to L -
/// 1).
template<class Material, class T, int L> class MomentStress {
public:
  static constexpr int lanes = L;
  using Spin = double;
  using Kinematics = StepKinematics<L>;
  using State = typename Material::State;

  MomentStress(std::size_t count, double weight_) : weight(weight_), states(count), moments(count) {}

  StressResult<L> advance(const Material& material, std::size_t i, Sym3& stress, const Kinematics& k,
                          const StressStep& step) {
    SymLanes<L> before;
    for (int c = 0; c < 6; ++c) {
      before[c] = convert_lanes<L, double, T>(moments[i][c]);
      before[c][0] = stress[c];
    }
    before = rotate(k.rotation, before);
    Sym3 increment;
    for (int c = 0; c < 6; ++c) stress[c] = before[c][0], increment[c] = k.increment[c][0];
    const Tangent tangent = material.update(stress, states[i],
                                            {.increment = increment,
                                             .dt = step.dt,
                                             .volume_ratio = step.volume_ratio,
                                             .deformation = step.deformation});
    SymLanes<L> after = before;
    add_moment_increment<L>(after, k.increment, tangent, weight);
    Lanes<double, L> work{};
    for (int c = 0; c < 6; ++c) {
      after[c][0] = stress[c];
      moments[i][c] = convert_lanes<L, T, double>(after[c]);
      work += (c < 3 ? 0.5 : 1.0) * (before[c] + after[c]) * k.increment[c];
    }
    double stabilization_work = 0;
    for (int m = 1; m < L; ++m) stabilization_work += work[m];
    return {after, work[0], stabilization_work};
  }
  const State& state(std::size_t i) const { return states[i]; }
  double history(std::size_t i, double State::*member) const { return states[i].*member; }
  std::size_t memory_bytes() const { return states.size() * (sizeof(State) + sizeof(moments[0])); }

private:
  double weight;
  std::vector<State> states;
  std::vector<std::array<Lanes<T, L>, 6>> moments; ///< lane 0 unused: the stress itself is kept in double
};

} // namespace spall
