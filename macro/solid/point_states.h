#pragma once

#include "macro/material/material.h"
#include "macro/points/tensor_lanes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <vector>

namespace spall {

/// Points that are advanced at once, one per lane. Lanes beyond their number hold the last one again.
template<int P> struct PointGroup {
  std::array<std::size_t, P> point; ///< index
  int count = 0;

  void add(std::size_t i) { point[static_cast<std::size_t>(count++)] = i; }
  void fill() {
    for (std::size_t m = static_cast<std::size_t>(count); m < P; ++m) point[m] = point[m - 1];
  }
  /// Where the values of the points are.
  template<class Value> std::array<const Value*, P> of(const std::vector<Value>& values) const {
    std::array<const Value*, P> at;
    for (std::size_t m = 0; m < P; ++m) at[m] = &values[point[m]];
    return at;
  }
  template<class Value> std::array<Value*, P> of(std::vector<Value>& values) const {
    std::array<Value*, P> at;
    for (std::size_t m = 0; m < P; ++m) at[m] = &values[point[m]];
    return at;
  }
  /// The numbers of the points, 0 in the lanes beyond them.
  Lanes<double, P> numbers(const std::vector<double>& values) const {
    Lanes<double, P> all;
    for (int m = 0; m < P; ++m)
      set_lane<P, double>(all, m, m < count ? values[point[static_cast<std::size_t>(m)]] : 0);
    return all;
  }
};

/// Tensors of the points of a group, and back.
template<int P, template<class> class A>
A<Lanes<double, P>> load(const std::vector<A<double>>& tensors, const PointGroup<P>& group) {
  return side_by_side<P, A, double>(group.of(tensors));
}
template<int P, template<class> class A>
void store(std::vector<A<double>>& tensors, const PointGroup<P>& group, const A<Lanes<double, P>>& values) {
  one_by_one<P, A, double>(values, group.of(tensors));
}

/// Whether a law advances several points at once: its state and its update take any number type V.
template<class Material, int P>
concept UpdatesPoints = requires(const Material& material, SymLanes<P>& stress,
                                 typename Material::template StateOf<Lanes<double, P>>& state,
                                 const StrainStepOf<Lanes<double, P>, Lanes<double, P>>& step) {
  material.update(stress, state, step);
};

/// Advances the stresses and the states of a group of points: all at once, or one by one, as the law can.
template<int P, class Material>
StiffnessOf<Lanes<double, P>> update_points(const Material& material, const PointGroup<P>& group,
                                            std::vector<typename Material::State>& states,
                                            SymLanes<P>& stress,
                                            const StrainStepOf<Lanes<double, P>, Lanes<double, P>>& step) {
  using V = Lanes<double, P>;
  if constexpr (UpdatesPoints<Material, P>) {
    using StateOf = typename Material::template StateOf<V>;
    constexpr int numbers = sizeof(StateOf) / sizeof(V);
    std::array<double*, P> at;
    for (std::size_t m = 0; m < P; ++m) at[m] = reinterpret_cast<double*>(&states[group.point[m]]);
    std::array<const double*, P> before;
    std::copy(at.begin(), at.end(), before.begin());
    StateOf state = std::bit_cast<StateOf>(side_by_side<numbers, P, double, double>(before));
    const StiffnessOf<V> stiffness = material.update(stress, state, step);
    one_by_one<numbers, P, double, double>(std::bit_cast<std::array<V, numbers>>(state), at);
    return stiffness;
  } else {
    StiffnessOf<V> all;
    Sym3 one;
    Stiffness stiffness;
    for (int m = 0; m < P; ++m) {
      if (m < group.count) { // the lanes beyond hold what the last point has come to
        one = lane<P>(stress, m);
        const Mat3 deformation = lane<P>(step.deformation, m), rotation = lane<P>(*step.rotation, m);
        const StrainStep step_of_one{.increment = lane<P>(step.increment, m),
                                     .dt = step.dt,
                                     .volume_ratio = get_lane<P, double>(step.volume_ratio, m),
                                     .deformation = deformation,
                                     .spacing = get_lane<P, double>(step.spacing, m),
                                     .radius = get_lane<P, double>(step.radius, m),
                                     .rotation = &rotation,
                                     .swelling = get_lane<P, double>(step.swelling, m)};
        stiffness = material.update(one, states[group.point[static_cast<std::size_t>(m)]], step_of_one);
      }
      put_lane<P>(stress, m, one);
      set_lane<P, double>(all.bulk, m, stiffness.bulk);
      set_lane<P, double>(all.shear, m, stiffness.shear);
      set_lane<P, double>(all.flow, m, stiffness.flow);
      set_lane<P, double>(all.limit, m, stiffness.limit);
      put_lane<P>(all.direction, m, stiffness.direction);
    }
    return all;
  }
}

} // namespace spall
