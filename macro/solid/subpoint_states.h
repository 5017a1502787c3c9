#pragma once

#include "macro/material/material.h"
#include "macro/points/tensor_lanes.h"
#include "shared/archive.h"

#include <type_traits>
#include <vector>

namespace spall {

/// Whether a law advances several points at once: its state and its update take any number type V.
template<class Material, int L>
concept UpdatesLanes = requires {
  typename Material::template StateOf<Lanes<double, L>>;
};

/// What the sub-points of a cell have in common, in the last step.
struct MeanStiffness {
  double bulk = 0, limit = 0; ///< means over the sub-points, Pa (Stiffness)
};

/// Material states of the sub-points of all cells, one by one: for any law.
template<class Material, int L> class SubpointStates {
public:
  using State = typename Material::State;

  SubpointStates(std::size_t points, int count_)
      : count(count_), states(points * static_cast<std::size_t>(count)) {}

  State at(std::size_t i, int q) const { return states[place(i, q)]; }
  /// Advances the stresses of the sub-points of cell i. @param step all but the increments
  MeanStiffness update(const Material& material, std::size_t i, SymLanes<L>& stresses,
                       const StrainStepOf<Lanes<double, L>>& step) {
    MeanStiffness mean;
    for (int q = 0; q < count; ++q) {
      Sym3 s = lane<L>(stresses, q);
      const StrainStep one{lane<L>(step.increment, q), step.dt, step.volume_ratio, step.deformation,
                           step.spacing};
      const Stiffness stiffness = material.update(s, states[place(i, q)], one);
      mean.bulk += stiffness.bulk / count, mean.limit += stiffness.limit / count;
      put_lane<L>(stresses, q, s);
    }
    return mean;
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
    for (int q = 0; q < count; ++q) share[q] = 1. / count;
  }

  State at(std::size_t i, int q) const { return state_in_lane<L, Material::template StateOf>(states[i], q); }
  MeanStiffness update(const Material& material, std::size_t i, SymLanes<L>& stresses,
                       const StrainStepOf<Lanes<double, L>>& step) {
    const auto stiffness = material.update(stresses, states[i], step);
    return {sum_of_lanes(share * stiffness.bulk), sum_of_lanes(share * stiffness.limit)};
  }
  void transfer(Archive& archive) { archive("states", states); }
  std::size_t memory_bytes() const { return states.size() * sizeof(states[0]); }

private:
  Lanes<double, L> share{}; ///< of each lane in a mean: 0 beyond the sub-points
  std::vector<typename Material::template StateOf<Lanes<double, L>>> states;
};

} // namespace spall
