#include "macro/material/afc.h"
#include "macro/solid/solid_correction.h"
#include "macro/solid/solid_of.h"
#include "macro/solid/solid_stiffness.h"
#include "macro/solid/solid_transfer.h"

namespace spall {

template std::unique_ptr<Solid> make_solid(const Afc&, Points, SymmetryPlanes, SolidInputs);

} // namespace spall
