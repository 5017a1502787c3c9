#include "macro/scene/cylinder_inputs.h"

#include "shared/error.h"

namespace spall {

void CylinderInputs::declare_cylinder(Parameters& parameters, const std::string& name,
                                      const std::function<bool()>& needed) {
  auto section = parameters.section(name, needed);
  section.quantity("Diameter", diameter, Dimension::length, {above_zero, 1e3}, "of the slab, bar or anvil");
  section.quantity("Height", height, Dimension::length, {above_zero, 1e3},
                   "thickness of the slab or anvil, length of the bar");
  section.quantity("Hole diameter", hole_diameter, Dimension::length, {0, 1e3},
                   "of a hole along the axis: a pilot hole; 0: none; rings are counted from its wall");
  FillingInputs::declare(parameters, name, needed);
}

void CylinderInputs::validate_cylinder(const std::string& file, const std::string& section) const {
  if (!(hole_diameter < diameter))
    throw InputError(file + ": key '" + section + "/Hole diameter': found " +
                     format_quantity(hole_diameter, Dimension::length) + ", allowed: less than Diameter, " +
                     format_quantity(diameter, Dimension::length));
  FillingInputs::validate(file, section, cylinder(0));
}

} // namespace spall
