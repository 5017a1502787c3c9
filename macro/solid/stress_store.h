#pragma once

#include "macro/integration/integration.h"
#include "macro/solid/point_kinematics.h"
#include "shared/archive.h"

#include <vector>

namespace spall {

/// What a point knows at the end of a step's kinematics.
struct StressStep {
  double dt;               ///< s
  double volume_ratio;     ///< J at the end of the step
  const Mat3& deformation; ///< F at the end of the step
  double spacing = 0;      ///< of the point, m
};

/// Stresses of one point for its force, and the work of the step per middle volume (midpoint stress), J/m^3.
template<int L> struct StressResult {
  SymLanes<L> lanes; ///< each works on the gradient of its lane and the volume of the whole cell, Pa
  double work, stabilization_work;
};

/// What the stores need to know of a scheme.
struct StressStoreInputs {
  LaneLayout layout;
  double weight = 0; ///< of the stress moments
};

/// The stores below keep what the points of a scheme remember besides their Cauchy stress (`stress`, at the
/// end of the last step on entry, of this step on return), and advance it. All have the same interface:
/// - node_rate: rates of F at the node, from those of the lanes;
/// - advance: the stresses of one step;
/// - elastic: lanes of stress for the lanes of a small strain, elastic moduli of the present state, for the
///   stiffness;
/// - transfer: what the points remember;
/// - state, history: one state of the point, for its wave speed, and the mean of a history variable.
/// Those with one material state per point share it here.
template<class Material> class OneState {
public:
  using State = typename Material::State;
  using Spin = double; ///< all lanes turn with the point

  const State& state(std::size_t i) const { return states[i]; }
  double history(std::size_t i, double State::*member) const { return states[i].*member; }
  void transfer(Archive& archive) { archive("states", states); }

protected:
  explicit OneState(std::size_t count) : states(count) {}
  std::vector<State> states;
};

/// One gradient per point: one stress.
template<class Material, class T> class PlainStress : public OneState<Material> {
public:
  static constexpr int lanes = 1;

  PlainStress(std::size_t points, const StressStoreInputs&) : OneState<Material>(points) {}

  Mat3 node_rate(const MatLanes<1>& rate) const {
    Mat3 node;
    for (int c = 0; c < 9; ++c) node[c] = rate[c / 3][c % 3];
    return node;
  }
  StressResult<1> advance(const Material& material, std::size_t i, Sym3& stress, const StepKinematics<1>& k,
                          const StressStep& step) {
    const Sym3 before = rotate(k.rotation, stress);
    stress = before;
    material.update(stress, this->states[i],
                    {.increment = k.increment,
                     .dt = step.dt,
                     .volume_ratio = step.volume_ratio,
                     .deformation = step.deformation,
                     .spacing = step.spacing});
    return {stress, 0.5 * (contract(before, k.increment) + contract(stress, k.increment)), 0};
  }
  SymLanes<1> elastic(const Material& material, std::size_t i, const SymLanes<1>& strain) const {
    return material.elastic(this->states[i])(strain);
  }
  std::size_t memory_bytes() const { return this->states.size() * sizeof(typename Material::State); }
};

/// A stress and its moments, which go with the differences of the strain over the nodal cell (lanes 1 to L -
/// 1).
template<class Material, class T, int L> class MomentStress : public OneState<Material> {
public:
  static constexpr int lanes = L;

  MomentStress(std::size_t points, const StressStoreInputs& inputs)
      : OneState<Material>(points), weight(inputs.weight), moments(points) {}

  Mat3 node_rate(const MatLanes<L>& rate) const {
    Mat3 node;
    for (int c = 0; c < 9; ++c) node[c] = rate[c / 3][c % 3][0];
    return node;
  }
  StressResult<L> advance(const Material& material, std::size_t i, Sym3& stress, const StepKinematics<L>& k,
                          const StressStep& step) {
    SymLanes<L> before;
    for (int c = 0; c < 6; ++c) {
      before[c] = convert_lanes<L, double, T>(moments[i][c]);
      before[c][0] = stress[c];
    }
    before = rotate(k.rotation, before);
    Sym3 increment;
    for (int c = 0; c < 6; ++c) stress[c] = before[c][0], increment[c] = k.increment[c][0];
    const Stiffness tangent = material.update(stress, this->states[i],
                                            {.increment = increment,
                                             .dt = step.dt,
                                             .volume_ratio = step.volume_ratio,
                                             .deformation = step.deformation,
                                             .spacing = step.spacing});
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
  SymLanes<L> elastic(const Material& material, std::size_t i, const SymLanes<L>& strain) const {
    SymLanes<L> stress = apply<L>(material.elastic(this->states[i]), strain);
    Lanes<double, L> share = Lanes<double, L>{} + weight;
    share[0] = 1;
    for (auto& component : stress) component *= share;
    return stress;
  }
  void transfer(Archive& archive) {
    OneState<Material>::transfer(archive);
    archive("stress_moments", moments);
  }
  std::size_t memory_bytes() const {
    return this->states.size() * (sizeof(typename Material::State) + sizeof(moments[0]));
  }

private:
  double weight;
  std::vector<std::array<Lanes<T, L>, 6>> moments; ///< lane 0 unused: the stress itself is kept in double
};

/// Stresses at sub-points of the nodal cell that share its volume equally. Each has its own deviatoric
/// strain, spin and material history; all share the volume ratio of the node and its rate, and the mean of
/// their pressures, so that differences of volume inside a cell, which its neighbours cannot follow, cost
/// nothing. The node's stress is the mean; what the sub-points work beyond that of the mean on the mean
/// strain is booked as stabilisation.
template<class Material, class T, int L> class SubpointStress {
public:
  static constexpr int lanes = L;
  using State = typename Material::State;
  using Spin = Lanes<double, L>;

  SubpointStress(std::size_t points, const StressStoreInputs& inputs)
      : count(inputs.layout.used), states(points * count), differences(points) {}

  Mat3 node_rate(const MatLanes<L>& rate) const {
    Mat3 node;
    for (int c = 0; c < 9; ++c) node[c] = mean(rate[c / 3][c % 3]);
    return node;
  }
  StressResult<L> advance(const Material& material, std::size_t i, Sym3& stress,
                          const StepKinematics<L, Spin>& k, const StressStep& step) {
    SymLanes<L> before;
    for (int c = 0; c < 6; ++c) before[c] = stress[c] + convert_lanes<L, double, T>(differences[i][c]);
    before = rotate(k.rotation, before);
    const SymLanes<L> increment =
        with_trace(k.increment, mean(k.increment[0] + k.increment[1] + k.increment[2]));
    SymLanes<L> after{};
    for (int q = 0; q < count; ++q) {
      Sym3 s, e;
      for (int c = 0; c < 6; ++c) s[c] = before[c][q], e[c] = increment[c][q];
      material.update(s, states[i * count + q],
                      {.increment = e,
                       .dt = step.dt,
                       .volume_ratio = step.volume_ratio,
                       .deformation = step.deformation,
                       .spacing = step.spacing});
      for (int c = 0; c < 6; ++c) after[c][q] = s[c];
    }
    double work = 0, work_of_means = 0;
    for (int c = 0; c < 6; ++c) {
      const Lanes<double, L> middle = (c < 3 ? 0.5 : 1.0) * (before[c] + after[c]);
      work += mean(middle * increment[c]);
      work_of_means += mean(middle) * mean(increment[c]);
      stress[c] = mean(after[c]);
      differences[i][c] = convert_lanes<L, T, double>(after[c] - stress[c]);
    }
    return {shared(after), work_of_means, work - work_of_means};
  }
  SymLanes<L> elastic(const Material& material, std::size_t i, const SymLanes<L>& strain) const {
    return shared(apply<L>(material.elastic(states[i * count]),
                           with_trace(strain, mean(strain[0] + strain[1] + strain[2]))));
  }
  const State& state(std::size_t i) const { return states[i * count]; }
  double history(std::size_t i, double State::*member) const {
    double sum = 0;
    for (int q = 0; q < count; ++q) sum += states[i * count + q].*member;
    return sum / count;
  }
  void transfer(Archive& archive) {
    archive("states", states);
    archive("subpoint_stresses", differences);
  }
  std::size_t memory_bytes() const {
    return states.size() * sizeof(State) + differences.size() * sizeof(differences[0]);
  }

private:
  double mean(const Lanes<double, L>& a) const {
    double sum = 0;
    for (int q = 0; q < count; ++q) sum += a[q];
    return sum / count;
  }
  /// Deviators of all lanes with the same trace.
  static SymLanes<L> with_trace(SymLanes<L> a, double trace) {
    const Lanes<double, L> excess = (trace - a[0] - a[1] - a[2]) / 3.0;
    for (int c = 0; c < 3; ++c) a[c] += excess;
    return a;
  }
  /// Each sub-point's share of the force: its deviator and the mean pressure over their number.
  SymLanes<L> shared(const SymLanes<L>& stress) const {
    SymLanes<L> s = with_trace(stress, mean(stress[0] + stress[1] + stress[2]));
    for (auto& component : s) component /= static_cast<double>(count);
    return s;
  }

  int count; ///< sub-points per cell
  std::vector<State> states;
  std::vector<std::array<Lanes<T, L>, 6>> differences; ///< from the mean, the stress of the node
};

} // namespace spall
