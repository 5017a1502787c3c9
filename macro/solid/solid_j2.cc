#include "macro/material/j2.h"
#include "macro/solid/make_solid.h"

namespace spall {

template std::unique_ptr<Solid> make_solid(const J2&, Points, SymmetryPlanes, SolidInputs);

} // namespace spall
