#pragma once

#include "macro/solid/solid_correction.h"
#include "macro/solid/solid_of.h"
#include "macro/solid/solid_refresh.h"
#include "macro/solid/solid_step.h"
#include "macro/solid/solid_stiffness.h"
#include "macro/solid/solid_transfer.h"

namespace spall {

/// A solid with the stress store that the scheme needs.
template<class Material, class T>
std::unique_ptr<Solid> make_solid_of(const Material& material, Points points, SymmetryPlanes planes,
                                     const SolidInputs& inputs) {
  const auto with = [&]<class Stress>() -> std::unique_ptr<Solid> {
    return std::make_unique<SolidOf<Material, T, Stress>>(material, std::move(points), planes, inputs);
  };
  const OperatorLayout layout = layout_of(inputs.integration);
  switch (layout.use) {
  case OperatorUse::gradient:
    break;
  case OperatorUse::moments:
    return layout.width == 4 ? with.template operator()<MomentStress<Material, T, 4>>()
                             : with.template operator()<MomentStress<Material, T, 8>>();
  case OperatorUse::subpoints:
    return layout.width == 4 ? with.template operator()<SubpointStress<Material, T, 4>>()
                             : with.template operator()<SubpointStress<Material, T, 8>>();
  }
  return with.template operator()<PlainStress<Material, T>>();
}

template<MaterialLaw Law>
std::unique_ptr<Solid> make_solid(const Law& law, Points points, SymmetryPlanes planes, SolidInputs inputs) {
  inputs.integration.axisymmetric = planes.axis;
  const Share share = share_of(points.owned, inputs.ranks, points_per_block(planes));
  if (inputs.ranks.several() && inputs.cells)
    inputs.cells = std::make_shared<const ConformingCells>(part_of(*inputs.cells, share));
  points = part_of(std::move(points), share);
  if (inputs.double_precision) return make_solid_of<Law, double>(law, std::move(points), planes, inputs);
  return make_solid_of<Law, float>(law, std::move(points), planes, inputs);
}

} // namespace spall
