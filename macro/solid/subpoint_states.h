#pragma once

#include "macro/material/material.h"
#include "macro/points/tensor_lanes.h"
#include "shared/archive.h"

#include <vector>

namespace spall {

/// Whether a law advances several points at once: its state and its update take any number type V.
template<class Material, int L>
concept UpdatesLanes = requires {
  typename Material::template StateOf<Lanes<double, L>>;
};

/// What the moments of a cell need of its sub-points, one per lane, Pa (Stiffness).
template<int L> struct SubpointStiffness { Lanes<double, L> bulk{}, limit{}; };

/// Material states of the sub-points of all cells, one by one: for any law.
template<class Material, int L> class SubpointStates {
public:
  using State = typename Material::State;

  SubpointStates(std::size_t points, int count_)
      : count(count_), states(points * static_cast<std::size_t>(count)) {}

  State at(std::size_t i, int q) const { return states[place(i, q)]; }
  /// 1 in the lanes of sub-points of cell i that have a volume of their own.
  Lanes<double, L> own_volume(std::size_t i) const {
    Lanes<double, L> own{};
    if constexpr (requires(const State& state) { Material::own_volume(state); })
      for (int q = 0; q < count; ++q) own[q] = Material::own_volume(states[place(i, q)]) ? 1 : 0;
    return own;
  }
  /// Advances the stresses of the sub-points of cell i. @param step all but the increments
  SubpointStiffness<L> update(const Material& material, std::size_t i, SymLanes<L>& stresses,
                              const StrainStepOf<Lanes<double, L>>& step) {
    SubpointStiffness<L> all;
    for (int q = 0; q < count; ++q) {
      Sym3 s = lane<L>(stresses, q);
      const Mat3 rotation = lane<L>(*step.rotation, q);
      const StrainStep one{.increment = lane<L>(step.increment, q),
                           .dt = step.dt,
                           .volume_ratio = step.volume_ratio,
                           .deformation = step.deformation,
                           .spacing = step.spacing,
                           .radius = step.radius,
                           .rotation = &rotation,
                           .swelling = step.swelling[q]};
      const Stiffness stiffness = material.update(s, states[place(i, q)], one);
      all.bulk[q] = stiffness.bulk, all.limit[q] = stiffness.limit;
      put_lane<L>(stresses, q, s);
    }
    return all;
  }
  void transfer(Archive& archive) { archive("states", states); }
  std::size_t memory_bytes() const { return states.size() * sizeof(State); }

private:
  std::size_t place(std::size_t i, int q) const {
    return i * static_cast<std::size_t>(count) + static_cast<std::size_t>(q);
  }

  int count; ///< sub-points per cell
  std::vector<State> states;
};

/// The same for a law that advances all sub-points of a cell at once. Lanes beyond their number hold a point
/// that is not sheared.
template<class Material, int L>
requires UpdatesLanes<Material, L>
class SubpointStates<Material, L> {
public:
  using State = typename Material::State;

  SubpointStates(std::size_t points, int count) : states(points) {
    for (int q = 0; q < count; ++q) used[q] = 1;
  }

  State at(std::size_t i, int q) const { return state_in_lane<L, Material::template StateOf>(states[i], q); }
  Lanes<double, L> own_volume(std::size_t) const { return Lanes<double, L>{}; }
  SubpointStiffness<L> update(const Material& material, std::size_t i, SymLanes<L>& stresses,
                              const StrainStepOf<Lanes<double, L>>& step) {
    const auto stiffness = material.update(stresses, states[i], step);
    // The limit of a law that keeps its strength is infinite: beyond the sub-points it must not count.
    return {select(used > 0, stiffness.bulk, 0), select(used > 0, stiffness.limit, 0)};
  }
  void transfer(Archive& archive) { archive("states", states); }
  std::size_t memory_bytes() const { return states.size() * sizeof(states[0]); }

private:
  Lanes<double, L> used{}; ///< 1 in the lanes of sub-points
  std::vector<typename Material::template StateOf<Lanes<double, L>>> states;
};

} // namespace spall
