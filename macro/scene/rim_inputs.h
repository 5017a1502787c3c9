#pragma once

#include "macro/contact/elastic_ring.h"
#include "shared/input/parameters.h"

namespace spall {

/// The `Rim` section of a scene file: what holds a slab together from outside. `slab`: whether there is one.
void declare_rim(Parameters& parameters, RingInputs& culvert, const std::function<bool()>& slab);

} // namespace spall
