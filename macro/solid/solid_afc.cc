#include "macro/material/afc.h"
#include "macro/solid/make_solid.h"

namespace spall {

template std::unique_ptr<Solid> make_solid(const Afc&, Points, SymmetryPlanes, SolidInputs);

} // namespace spall
