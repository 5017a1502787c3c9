#pragma once

#include "macro/integration/gradient_operators.h"
#include "macro/points/ghosts.h"

namespace spall {

/// The record of a point and a ring around the axis (see join_images). With several operators these are five
/// SIMD vectors, each with one number per operator: rr, rz, yy, zr, zz. With one operator they are two:
/// {rr, rz, yy, 0} and {zr, zz, 0, 0}.
template<class T, int Width> struct RingRecord {
  using Vector = Lanes<T, Width == 8 ? 8 : 4>;
  static constexpr std::uint32_t size = Width == 1 ? 2 : 5;
  static constexpr std::uint32_t size_of_image = Width == 1 ? 1 : 3;
  static constexpr std::uint32_t of_radial =
      Width == 1 ? 1 : 3; ///< vectors that multiply v_r; the others v_z
  /// Components of the rate of F that the vectors of several operators give.
  static constexpr std::array<int, 5> row = {0, 0, 1, 2, 2}, column = {0, 2, 1, 0, 2};

  /// Adds an image's gradients to the record of its ring.
  static void add(Vector* ring, const Vector* gradient, T cosine, T sine) {
    if constexpr (Width == 1) {
      const Vector g = *gradient;
      ring[0] += Vector{cosine * g[0], cosine * g[2], sine * g[1], 0};
      ring[1] += Vector{g[0], g[2], 0, 0};
    } else {
      ring[0] += cosine * gradient[0];
      ring[1] += cosine * gradient[2];
      ring[2] += sine * gradient[1];
      ring[3] += gradient[0];
      ring[4] += gradient[2];
    }
  }
};

/// Joins the images of each ring to one neighbour, for rotational symmetry. The image at the angle t of a
/// ring with the velocity (v_r, 0, v_z) has the velocity (v_r cos t, v_r sin t, v_z). With the gradients
/// (G_x, G_y, G_z) of the images, all that they give to the rates of F of a point in the half plane is
///
///   rate_xx = v_r rr,  rr = sum cos t G_x     rate_xz = v_r rz,  rz = sum cos t G_z
///   rate_zx = v_z zr,  zr = sum G_x           rate_zz = v_z zz,  zz = sum G_z
///   rate_yy = v_r yy,  yy = sum sin t G_y
///
/// The other rates are zero, because images come in pairs at t and -t. These five sums are the new record of
/// the pair. Nothing is approximated: the answers are those with the images, and there are about
/// a third as many neighbours.
/// @param operators of a block, whose stencil may contain images; afterwards it contains none
template<class T>
void join_images(GradientOperators<T>& operators, const Ghosts& ghosts, const Points& points);

} // namespace spall
