#pragma once

#include "macro/scene/shape_inputs.h"

namespace spall {

/// Size and points of a cylindrical body (bar, slab, anvil), as a section of a scene file.
struct CylinderInputs : FillingInputs {
  double diameter = required, height = required; ///< m
  double hole_diameter = 0;                      ///< of a hole along the axis, m

  Cylinder cylinder(double bottom) const {
    return {.radius = 0.5 * diameter, .height = height, .bottom = bottom, .hole = 0.5 * hole_diameter};
  }
  /// `needed`: whether keys without default must be set.
  void declare_cylinder(Parameters& parameters, const std::string& section,
                        const std::function<bool()>& needed);
  /// @throws InputError: what no single key can check. `file` names the input in messages.
  void validate_cylinder(const std::string& file, const std::string& section) const;
};

} // namespace spall
