#include "macro/dynamics/solid_correction.h"
#include "macro/dynamics/solid_of.h"
#include "macro/dynamics/solid_stiffness.h"
#include "macro/dynamics/solid_transfer.h"
#include "macro/material/j2.h"

namespace spall {

template std::unique_ptr<Solid> make_solid(const J2&, Points, SymmetryPlanes, SolidInputs);

} // namespace spall
