#pragma once

#include <Eigen/Core>

#include <cmath>

namespace spall {

/// Opening or traction of a crack: component 0 is normal to it (opening positive), the others tangential.
template<int dim> using Opening = Eigen::Matrix<double, dim, 1>;
/// The tangential part of an opening or traction.
template<int dim> using Slip = Eigen::Matrix<double, dim - 1, 1>;

/// Mixed-mode coupling of normal and tangential opening. The traction (f_n, f_t) of an opening (w_n, w_t) is
/// T(d) / d (w_n, a w_t) with the effective opening d^2 = w_n^2 + g^2 |w_t|^2. With g = r / q and a = r^2 /
/// q, pure shear has strength r f_t and fracture energy q G_f. The default treats all modes alike. With q !=
/// 1 the law has no potential: its tangent is not symmetric and its dissipation depends on the path.
struct MixedMode {
  double strength_ratio = 1; ///< ratio r of shear strength to tensile strength
  double energy_ratio = 1;   ///< ratio q of mode II fracture energy G_II to G_f
  double friction = 0;       ///< Coulomb friction coefficient of crack faces in contact

  double opening_weight() const {
    return strength_ratio / energy_ratio;
  } ///< factor g of the effective opening
  double traction_weight() const {
    return strength_ratio * strength_ratio / energy_ratio;
  } ///< factor a of the tangential traction
  bool symmetric() const { return energy_ratio == 1 && friction == 0; }
  /// Effective opening d of an opening vector, m.
  template<int dim> double effective(const Opening<dim>& w) const {
    return strength_ratio == 1 && energy_ratio == 1
               ? w.norm()
               : std::hypot(w[0], opening_weight() * w.template tail<dim - 1>().norm());
  }
  /// Twice the stored energy of an opening, divided by the secant stiffness T(d) / d, m^2.
  template<int dim> double stored(const Opening<dim>& w) const {
    return w[0] * w[0] + traction_weight() * w.template tail<dim - 1>().squaredNorm();
  }
};

} // namespace spall
