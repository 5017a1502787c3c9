#pragma once

#include <Eigen/Core>

#include <cmath>

namespace spall {

/// Opening or traction of a crack: component 0 is normal to it (opening positive), the others tangential.
template<int dim> using Opening = Eigen::Matrix<double, dim, 1>;
/// Its tangential part.
template<int dim> using Slip = Eigen::Matrix<double, dim - 1, 1>;

/// How shear counts beside opening. Traction (f_n, f_t) of an opening (w_n, w_t) is T(d) / d (w_n, a w_t)
/// with the effective opening d^2 = w_n^2 + g^2 |w_t|^2: pure shear then has strength r f_t and energy q G_f
/// for g = r / q and a = r^2 / q. The default counts all modes alike. With q != 1 the law has no potential:
/// its tangent is not symmetric and its dissipation depends on the path.
struct MixedMode {
  double strength_ratio = 1; ///< r: shear strength over tensile strength
  double energy_ratio = 1;   ///< q: G_II over G_f
  double friction = 0;       ///< Coulomb coefficient where the faces press on each other

  double opening_weight() const { return strength_ratio / energy_ratio; }                   ///< g
  double traction_weight() const { return strength_ratio * strength_ratio / energy_ratio; } ///< a
  bool symmetric() const { return energy_ratio == 1 && friction == 0; }
  /// Effective opening d of an opening vector.
  template<int dim> double effective(const Opening<dim>& w) const {
    return strength_ratio == 1 && energy_ratio == 1
               ? w.norm()
               : std::hypot(w[0], opening_weight() * w.template tail<dim - 1>().norm());
  }
  /// Twice the energy stored in an opening over the secant stiffness T(d) / d.
  template<int dim> double stored(const Opening<dim>& w) const {
    return w[0] * w[0] + traction_weight() * w.template tail<dim - 1>().squaredNorm();
  }
};

} // namespace spall
