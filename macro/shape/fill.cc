#include "macro/shape/fill.h"

#include "macro/shape/fill_revolution.h"

#include <stdexcept>

namespace spall {
namespace {

template<class S>
Points fill_shape(const S& shape, const Filling& filling, const SymmetryPlanes& planes, double density) {
  if constexpr (std::is_same_v<S, Cylinder>) {
    return fill_cylinder(shape, filling, planes, density);
  } else if constexpr (std::is_same_v<S, Block>) {
    return fill_block(shape, filling, planes, density);
  } else if constexpr (std::is_same_v<S, ClosedSurface>) {
    return fill_surface(shape, filling, planes, density);
  } else if constexpr (std::is_same_v<S, Revolution>) {
    return fill_revolution(shape.sections(), filling.rings, shape.length() / filling.layers, planes, density);
  } else {
    throw std::invalid_argument("this shape cannot be filled with points");
  }
}

} // namespace

Points fill(const Shape& shape, const Filling& filling, const SymmetryPlanes& planes, double density) {
  return std::visit([&](const auto& s) { return fill_shape(s, filling, planes, density); }, shape);
}

} // namespace spall
