#pragma once

#include "macro/points/points.h"

namespace spall {

/// Size and shape of the kernel support.
struct SupportInputs {
  double normalized_size = 2.0; ///< radius in undeformed spacings
  double min_stretch = 0.5;     ///< principal stretches the support follows, lower clip
  double max_stretch = 8.0;     ///< upper clip
};

/// Ellipsoidal support of one evaluation point: x_J is inside if |xi| < 1, xi = inverse (x_J - x_I). Without
/// clipping matrix = a h F, so that xi are the coordinates of the undeformed body in units of the support
/// radius a h: the ellipsoid has the axes of the left stretch V (paper Eq. 8 with a support measure that
/// follows the deformation), and xi turns with the material, so that quantities tied to a direction xi_k need
/// no rotation.
struct Support {
  Mat3 matrix, inverse;
  double smallest_stretch; ///< after clipping

  /// Half-widths of the axis-aligned box around the ellipsoid |xi| <= radius.
  Vec3 half_widths(double radius) const;
};

/// Support from the deformation gradient, its singular values clipped to the inputs' range. A singular or
/// inverted F gives a sphere.
Support make_support(const Mat3& deformation, double spacing, const SupportInputs& inputs);

} // namespace spall
