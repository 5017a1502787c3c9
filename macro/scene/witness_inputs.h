#pragma once

#include "macro/contact/carried_surface.h"
#include "macro/material/j2.h"
#include "macro/shape/fill.h"
#include "shared/input/parameters.h"

namespace spall {

/// A metal plate behind the slab, parallel to it, that debris and projectile hit: what comes out of a wall.
struct WitnessInputs {
  bool present = false;
  double diameter = required, thickness = required; ///< m
  double distance = required;                       ///< from the slab's back to the plate's front, m
  int rings = 20, layers = 2;
  bool stop_when_passed = false;
  J2 j2;

  /// `in_scene`: whether the scene has a slab.
  void declare(Parameters& parameters, const std::function<bool()>& in_scene);

  /// @param slab thickness of the slab, whose front is z = 0, m
  Cylinder cylinder(double slab) const;
  Points fill(double slab, const SymmetryPlanes& planes) const;
  KnownSurface surface(double slab, const Points& points) const;
};

} // namespace spall
