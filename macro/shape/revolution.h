#pragma once

#include "macro/shape/contour.h"

#include <functional>
#include <optional>

namespace spall {

/// The sections of a body of revolution along its axis, for filling it with points.
struct Sections {
  std::function<double(double)> outer, inner; ///< radii of the section at z, m; inner 0: solid there
  std::vector<double> kinks;  ///< ascending: from end to end, and where layers of points shall begin, m
  std::vector<double> breaks; ///< ascending: where the radii are not smooth, besides the kinks, m
};

/// A body of revolution about z, solid or with a cavity. Contact sees its outer surface.
struct Revolution {
  Contour outer;
  std::optional<Contour> inner = {}; ///< contour of a closed cavity
  double inner_z = 0;                ///< z at which the cavity's contour has its zero, m

  SurfacePoint surface(const Vec3& x) const { return outer.surface(x); }
  double lower_bound(const Vec3& x) const { return outer.lower_bound(x); }
  double extent(const Vec3& direction) const { return outer.extent(direction); }
  double outer_radius(double z) const { return outer.section_radius(z); }
  double inner_radius(double z) const { return inner ? inner->section_radius(z - inner_z) : 0; }
  double length() const { return outer.largest_z() - outer.smallest_z(); }
  MassProperties mass_properties() const {
    const MassProperties whole = outer.mass_properties();
    if (!inner) return whole;
    MassProperties cavity = inner->mass_properties();
    cavity.centre[2] += inner_z;
    return without(whole, cavity);
  }
  std::vector<ContourPoint> outline() const { return outer.outline(); }
  std::vector<Vec3> surface_samples(double spacing) const { return turned(outer.outline(spacing), spacing); }
  /// Refers to this body, which must outlive it.
  Sections sections() const;
};

} // namespace spall
