#include "macro/solid/solid.h"

namespace spall {

std::unique_ptr<Solid> make_solid(const Material& material, Points points, SymmetryPlanes planes,
                                  SolidInputs inputs) {
  return std::visit(
      [&](const auto& law) { return make_solid(law, std::move(points), planes, std::move(inputs)); },
      material);
}

} // namespace spall
