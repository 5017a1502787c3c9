#pragma once

#include "macro/points/tensor.h"

#include <limits>

namespace spall {

/// What one material point is told about a time step. Strains and stresses: tension positive.
struct StrainStep {
  Sym3 increment; ///< midpoint strain increment D dt (Hughes-Winget; the stress has been rotated already)
  double dt;      ///< s
  double volume_ratio;     ///< J = det F at the end of the step
  const Mat3& deformation; ///< F at the end of the step
  double spacing = 0;      ///< edge of the cell the point stands for, m: laws that soften are resized to it
};

/// Tangent of a material in the form C : e = bulk tr(e) 1 + 2 shear dev(e) - 2 flow n (n : e), with n a unit
/// deviator (n : n = 1): the elastic one has flow = 0, J2 with consistent return has flow > 0. Used by the
/// stabilisation terms only. Pa.
struct Tangent {
  double bulk = 0, shear = 0, flow = 0;
  Sym3 direction{};
  /// Largest equivalent and largest mean stress that a stress moment may hold, Pa: a crushed or cracked point
  /// must not be held together, or pushed apart, by its stabilisation. Infinite for materials that do not
  /// lose strength.
  double limit = std::numeric_limits<double>::infinity();

  Sym3 operator()(const Sym3& e) const {
    const Sym3 s = deviator(e);
    const double volume = bulk * trace(e), along = 2 * flow * contract(direction, s);
    Sym3 c;
    for (int i = 0; i < 6; ++i) c[i] = 2 * shear * s[i] - along * direction[i] + (i < 3 ? volume : 0);
    return c;
  }
};

} // namespace spall
