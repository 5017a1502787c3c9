#include "macro/scene/rim_inputs.h"

namespace spall {

void declare_rim(Parameters& parameters, RingInputs& culvert, const std::function<bool()>& slab) {
  parameters.section("Rim").choice("Model", culvert.present, {{"free", false}, {"culvert", true}},
                                   "of a slab: nothing around it, or a steel ring, which touches it at the "
                                   "start, pushes and slides; the keys below are the ring's");
  auto ring = parameters.section("Rim", [&culvert, slab] { return culvert.present && slab(); });
  ring.quantity("Thickness", culvert.thickness, Dimension::length, {above_zero, 1}, "of the ring's wall");
  ring.quantity("Young's modulus", culvert.youngs_modulus, Dimension::stress, {above_zero, 1e13},
                "along its circumference");
  ring.quantity("Yield stress", culvert.yield_stress, Dimension::stress, {above_zero, 1e13},
                "without hardening");
  ring.quantity("Density", culvert.density, Dimension::density, {above_zero, 1e5}, "of the ring");
}

} // namespace spall
