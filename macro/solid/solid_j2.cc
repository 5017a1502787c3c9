#include "macro/material/j2.h"
#include "macro/solid/solid_correction.h"
#include "macro/solid/solid_of.h"
#include "macro/solid/solid_stiffness.h"
#include "macro/solid/solid_transfer.h"

namespace spall {

template std::unique_ptr<Solid> make_solid(const J2&, Points, SymmetryPlanes, SolidInputs);

} // namespace spall
