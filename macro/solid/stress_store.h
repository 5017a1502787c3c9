#pragma once

#include "macro/integration/cell_samples.h"
#include "macro/integration/integration.h"
#include "macro/solid/point_kinematics.h"
#include "macro/solid/point_states.h"
#include "macro/solid/subpoint_states.h"
#include "shared/archive.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace spall {

/// Kinematics of a point, or of several side by side, at the end of a step.
template<class V> struct StressStep {
  double dt;                 ///< s
  V volume_ratio;            ///< J at the end of the step
  const Mat<V>& deformation; ///< F at the end of the step
  V spacing = V{};           ///< undeformed edge of the point's cell, m
  V radius = V{};            ///< StrainStep::radius, m

  /// Returns the step as the input of a material, with the strain increments D dt and the rotation.
  template<class W>
  StrainStepOf<W, V> with(const Sym<W>& increment, const Mat<W>& rotation, const W& swelling = W{}) const {
    return {.increment = increment,
            .dt = dt,
            .volume_ratio = volume_ratio,
            .deformation = deformation,
            .spacing = spacing,
            .radius = radius,
            .rotation = &rotation,
            .swelling = swelling};
  }
};

/// Stresses of one point, or of several side by side, for their forces, and the work of the step per middle
/// volume (midpoint stress), J/m^3. W, V and N as in StepKinematics.
template<class W, class V, int N> struct StressResult {
  std::array<Sym<W>, N> stresses; ///< of the gradient operators, each on the volume of the whole cell, Pa
  V work, stabilization_work;
};

/// The stores below keep the state that the points of a scheme have besides their Cauchy stress (`stress`, at
/// the end of the last step on entry, of this step on return), and advance it. All have the same interface:
/// - lanes: numbers of a vector of a pair's record, one per gradient operator;
/// - group: points that are advanced at once, P; V, W, N: the types of their kinematics (StepKinematics);
/// - arrange: the rates of the operators in these types, from those of each point;
/// - node_rate: rates of F at the node, 1/s, from those of the operators;
/// - advance: the stresses of one step;
/// - separate: the nominal stresses of each point, from those of the operators;
/// - stored: the free energy of the point per present volume, J/m^3, without that of the moments;
/// - elastic: the stresses, Pa, of a small strain per operator with the elastic moduli of the present state,
///   for the stiffness;
/// - transfer: what the points remember;
/// - state, history: one state of the point, for its wave speed, and the mean of a history variable.
/// Those with one material state per point share it here, and advance eight points at once: L operators,
/// which turn with the point, for each of which a vector holds the numbers of the points.
template<class Material, class T, int L> class OneState {
public:
  static constexpr int lanes = L, group = 8, N = L;
  using State = typename Material::State;
  using V = Lanes<double, group>;
  using W = V;

  /// @param gathered of each point
  static std::array<Mat<W>, N> arrange(const std::array<Mat<Lanes<T, L>>, group>& gathered) {
    return by_operator<L, group, T>(places_of(gathered));
  }
  static Mat<V> node_rate(const std::array<Mat<W>, N>& rates) { return rates[0]; }
  static std::array<Mat<Lanes<T, L>>, group> separate(const std::array<Mat<W>, N>& nominal) {
    std::array<Mat<Lanes<T, L>>, group> separated;
    by_point<L, group, T>(nominal, places_of(separated));
    return separated;
  }

  const State& state(std::size_t i) const { return states[i]; }
  double history(std::size_t i, double State::*member) const { return states[i].*member; }
  StoredEnergy stored(const Material& material, std::size_t i, const Sym3& stress) const {
    return material.stored_energy(stress, states[i]);
  }
  void transfer(Archive& archive) { archive("states", states); }

protected:
  explicit OneState(std::size_t count) : states(count) {}
  std::vector<State> states;
};

/// One gradient per point: one stress.
template<class Material, class T> class PlainStress : public OneState<Material, T, 1> {
  using Base = OneState<Material, T, 1>;

public:
  using typename Base::V;

  PlainStress(std::size_t points, const IntegrationInputs&) : Base(points) {}

  StressResult<V, V, 1> advance(const Material& material, const PointGroup<Base::group>& points,
                                Sym<V>& stress, const StepKinematics<V, V, 1>& k, const StressStep<V>& step) {
    const Sym<V> before = rotate(k.rotation, stress), &increment = k.increment[0];
    stress = before;
    update_points(material, points, this->states, stress, step.with(increment, k.rotation));
    return {{stress}, 0.5 * (contract(before, increment) + contract(stress, increment)), V{}};
  }
  SymLanes<1> elastic(const Material& material, std::size_t i, const SymLanes<1>& strain) const {
    return material.elastic(this->states[i])(strain);
  }
  std::size_t memory_bytes() const { return this->states.size() * sizeof(typename Material::State); }
};

/// A stress and its moments, which go with the differences of the strain over the nodal cell: operator 0 is
/// the gradient at the node, operators 1 to L - 1 give the differences.
template<class Material, class T, int L> class MomentStress : public OneState<Material, T, L> {
  using Base = OneState<Material, T, L>;

public:
  using typename Base::V;

  MomentStress(std::size_t points, const IntegrationInputs& inputs)
      : Base(points), weight(inputs.stabilization), moments(points) {}

  StressResult<V, V, L> advance(const Material& material, const PointGroup<Base::group>& points,
                                Sym<V>& stress, const StepKinematics<V, V, L>& k, const StressStep<V>& step) {
    const Sym<V> before = rotate(k.rotation, stress);
    stress = before;
    const StiffnessOf<V> stiffness =
        update_points(material, points, this->states, stress, step.with(k.increment[0], k.rotation));
    StressResult<V, V, L> result{{stress}, contract_in_order(0.5 * (before + stress), k.increment[0]), V{}};
    // Lane 0 holds nothing: the stress itself is kept in double.
    std::array<Sym<V>, L> moment = by_operator<L, Base::group, T>(points.of(std::as_const(moments)));
    for (std::size_t m = 1; m < L; ++m) {
      const Sym<V> moment_before = rotate(k.rotation, moment[m]);
      moment[m] = advance_moment(moment_before, k.increment[m], stiffness, weight);
      result.stabilization_work += contract_in_order(0.5 * (moment_before + moment[m]), k.increment[m]);
      result.stresses[m] = moment[m];
    }
    by_point<L, Base::group, T>(moment, points.of(moments));
    return result;
  }
  SymLanes<L> elastic(const Material& material, std::size_t i, const SymLanes<L>& strain) const {
    Lanes<double, L> weights = Lanes<double, L>{} + weight;
    weights[0] = 1;
    return weights * apply(material.elastic(this->states[i]), strain);
  }
  void transfer(Archive& archive) {
    Base::transfer(archive);
    archive("stress_moments", moments);
  }
  std::size_t memory_bytes() const {
    return this->states.size() * (sizeof(typename Material::State) + sizeof(moments[0]));
  }

private:
  double weight;
  std::vector<Sym<Lanes<T, L>>> moments; ///< lane 0 unused: the stress itself is kept in double
};

/// Stresses at sub-points of the nodal cell that share its volume equally. Each has its own deviatoric
/// strain, spin and material history; all share the volume ratio of the node and its rate, and the mean of
/// their pressures. With a volume ratio of their own they would crush and open one by one, and grow softer
/// with every refinement. A law may ask for it all the same where cracks have directions (own_volume): a
/// crack at one sub-point, whose opening the others had to share, would press that point together along the
/// crack.
///
/// The part of the volume rate that varies linearly over the cell is resisted elastically instead: each
/// sub-point has a moment of the mean stress, of rate K times that part of tr D with the bulk modulus K that
/// the material has, held below its strength as the moments of MomentStress are. Without them the cells of
/// concrete that flows change their real volume at no cost where the shared volume ratio does not see it, and
/// a third of the resistance of a tunnel is lost. Resisting the rest too, quadratic with four sub-points
/// around an axis, would be two constraints of volume per unknown of a point, and the cells of concrete that
/// flows would lock: the tunnel in a block is then a fifth too stiff where the projectile is deep.
///
/// The node's stress is the mean; what the sub-points work beyond that of the mean on the mean strain is
/// booked as stabilisation.
template<class Material, class T, int L> class SubpointStress {
public:
  static constexpr int lanes = L, group = 1, N = 1;
  using State = typename Material::State;
  using V = double;
  using W = Lanes<double, L>; ///< each sub-point turns by its own spin

  SubpointStress(std::size_t points, const IntegrationInputs& inputs)
      : count(layout_of(inputs).count), states(points, count), differences(points), moments(points) {
    const CellSamples samples = cell_samples(inputs);
    for (int q = 0; q < count; ++q) {
      share[q] = 1. / count;
      for (int c = 0; c < 3; ++c) slope[c][q] = samples.offset[q][c];
    }
    for (Lanes<double, L>& s : slope)
      if (const double square = sum_of_lanes(s * s); square > 0) s /= std::sqrt(square);
  }

  static std::array<Mat<W>, N> arrange(const std::array<Mat<Lanes<T, L>>, group>& gathered) {
    return {convert_lanes<L, double, T>(gathered[0])};
  }
  Mat3 node_rate(const std::array<Mat<W>, N>& rates) const { return mean(rates[0]); }
  static std::array<Mat<Lanes<T, L>>, group> separate(const std::array<Mat<W>, N>& nominal) {
    return {convert_lanes<L, T, double>(nominal[0])};
  }
  StressResult<W, V, N> advance(const Material& material, const PointGroup<group>& points, Sym3& stress,
                                const StepKinematics<W, V, N>& k, const StressStep<V>& step) {
    const std::size_t i = points.point[0];
    SymLanes<L> before = convert_lanes<L, double, T>(differences[i]);
    for (int c = 0; c < 6; ++c) before[c] = stress[c] + before[c];
    before = rotate(k.rotation, before);
    const Lanes<double, L> own = states.own_volume(i), volume = trace(k.increment[0]),
                           swelling = own * (volume - mean(volume));
    const SymLanes<L> increment = with_trace(k.increment[0], mean(volume) + swelling);
    SymLanes<L> after = before;
    const SubpointStiffness<L> stiffness =
        states.update(material, i, after, step.with(increment, k.rotation, swelling));
    // Volumes of their own are resisted by the material itself: such a cell has no moments.
    const double bulk = mean(stiffness.bulk), limit = mean(own) > 0 ? 0 : mean(stiffness.limit);
    stress = mean(after);
    SymLanes<L> difference = after;
    for (int c = 0; c < 6; ++c) difference[c] -= stress[c];
    differences[i] = convert_lanes<L, T, double>(difference);
    const auto [work, work_of_means] = works(0.5 * (before + after), increment);
    const Lanes<double, L> slanted = linear_part(volume),
                           moment_before = __builtin_convertvector(moments[i], Lanes<double, L>),
                           moment = held(moment_before + bulk * slanted, limit);
    moments[i] = __builtin_convertvector(moment, Lanes<T, L>);
    const double work_of_moments = mean(0.5 * (moment_before + moment) * slanted);
    return {{plus_spherical(share_of(after, own), moment / static_cast<double>(count))},
            work_of_means,
            work - work_of_means + work_of_moments};
  }
  SymLanes<L> elastic(const Material& material, std::size_t i, const SymLanes<L>& strain) const {
    const Lanes<double, L> volume = trace(strain);
    return 1.0 / count *
           apply(material.elastic(state(i)), with_trace(strain, mean(volume) + linear_part(volume)));
  }
  StoredEnergy stored(const Material& material, std::size_t i, const Sym3& stress) const {
    SymLanes<L> stresses = convert_lanes<L, double, T>(differences[i]);
    for (int c = 0; c < 6; ++c) stresses[c] = stress[c] + stresses[c];
    StoredEnergy sum;
    for (int q = 0; q < count; ++q) {
      const StoredEnergy one = material.stored_energy(lane<L>(stresses, q), states.at(i, q));
      sum.volume += one.volume / count, sum.shape += one.shape / count;
    }
    return sum;
  }
  State state(std::size_t i) const { return states.at(i, 0); }
  double history(std::size_t i, double State::*member) const {
    double sum = 0;
    for (int q = 0; q < count; ++q) sum += states.at(i, q).*member;
    return sum / count;
  }
  void transfer(Archive& archive) {
    states.transfer(archive);
    archive("subpoint_stresses", differences);
    archive("subpoint_moments", moments);
  }
  std::size_t memory_bytes() const {
    return states.memory_bytes() + differences.size() * sizeof(differences[0]) +
           moments.size() * sizeof(moments[0]);
  }

private:
  double mean(const Lanes<double, L>& a) const { return sum_of_lanes(share * a); }
  template<template<class> class A> A<double> mean(const A<Lanes<double, L>>& a) const {
    A<double> means;
    for (std::size_t c = 0; c < means.size(); ++c) means[c] = mean(a[c]);
    return means;
  }
  /// The part of values at the sub-points that varies linearly over the cell, without their mean.
  Lanes<double, L> linear_part(const Lanes<double, L>& a) const {
    Lanes<double, L> part{};
    for (const Lanes<double, L>& s : slope) part += sum_of_lanes(s * a) * s;
    return part;
  }
  /// Moments that vary linearly over the cell, of a magnitude of at most about the limit, Pa.
  Lanes<double, L> held(const Lanes<double, L>& a, double limit) const {
    return linear_part(smaller(limit, larger(-limit, a)));
  }
  /// The mean over the sub-points of stress : increment, and mean stress : mean increment, J/m^3.
  std::array<double, 2> works(const SymLanes<L>& stress, const SymLanes<L>& increment) const {
    double work = 0, of_means = 0;
    for (int c = 0; c < 6; ++c) {
      const Lanes<double, L> twice_shear = c < 3 ? stress[c] : 2.0 * stress[c];
      work += mean(twice_shear * increment[c]);
      of_means += mean(twice_shear) * mean(increment[c]);
    }
    return {work, of_means};
  }
  /// Deviators of all lanes with other traces: one for all, or one of each.
  template<class Trace> static SymLanes<L> with_trace(const SymLanes<L>& a, const Trace& trace) {
    return plus_spherical(a, (trace - a[0] - a[1] - a[2]) / 3.0);
  }
  /// Each sub-point's share of the force: its deviator and the mean pressure over their number; of those with
  /// a volume of their own also what their pressure differs by. @param own 1 of these, 0 of others
  SymLanes<L> share_of(const SymLanes<L>& stress, const Lanes<double, L>& own) const {
    const Lanes<double, L> all = trace(stress), of_own = own * all;
    return with_trace(stress, mean(all) + of_own - mean(of_own)) / static_cast<double>(count);
  }

  int count;                ///< sub-points per cell
  Lanes<double, L> share{}; ///< of each lane in a mean: 0 beyond the sub-points
  std::array<Lanes<double, L>, 3>
      slope{}; ///< values that grow along x, y, z, of norm 1: the linear functions
  SubpointStates<Material, L> states;
  std::vector<Sym<Lanes<T, L>>> differences; ///< differences from the mean, which is the stress of the node
  std::vector<Lanes<T, L>> moments;          ///< of the mean stress, Pa
};

} // namespace spall
