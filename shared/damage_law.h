#pragma once

#include "shared/damage_table.h"

#include <vector>

namespace spall {

/// The damage variable of the table that reduces the macroscopic strength (Eq. 30).
enum class DamageDefinition {
  strength,              ///< damage_strength, with which the point dissipates the cell's fracture energy
  stiffness,             ///< damage, which is Eq. 29 of the paper taken literally
  stiffness_renormalised ///< damage_renormalised, if the measured K and G include the effect of the initial
                         ///< crack
};

/// The tensile damage d_t as a function of strain, tabulated or analytic. A tabulated law is rescaled to the
/// nodal spacing h so that the energy dissipated per crack area does not depend on the spacing (Ren et al.
/// 2011). It uses the curve of the cell size l nearest to h (in ratio):
/// - Up to the peak all lengths scale with the cell and the stress-strain curve does not change, except for
/// the effect of the tip zones, which in a larger cell open further down the softening curve. The work
/// W(strain, l) is the minimum of the energy of bulk and cracks; it depends on l through the cracks alone, so
/// that exactly
///     dW / d ln l = psi_cohesive - dissipation   at constant strain.
///   The derivative of this equation with the strain is a change of the stress, which grows with l and is
///   approximated by s_h = s / (1 + (h / l - 1) q), q = d(dissipation - psi_cohesive) / dW.
/// - After the peak the strain is the sum of a part that unloads along the secant of the peak and the opening
/// of one crack over the cell size, which is distributed over h instead:
///     eps_h = e + (eps - e) l / h, e = eps_peak s / s_peak;   s_h / s keeps its value at the peak.
/// Rescaled from the cell of 15.875 mm, both damages differ by less than 0.001 from cells computed directly
/// at 5, 10, 20 and 40 mm (linear softening; 0.002 and 0.004 with exponential and bilinear softening).
/// Without q the error of the stiffness damage would be 0.006, because the peak stress falls by 1 % from 5 to
/// 40 mm. Objects are small and can be copied; evaluation allocates no memory.
class DamageLaw {
public:
  DamageLaw() = default;
  DamageLaw(const DamageTable& table, double spacing, DamageDefinition definition);
  /// Makes an analytic law for verification: d = 1 - exp(-(kappa - threshold) / scale) beyond the threshold,
  /// the same at any spacing. The law is not regularised: the energy dissipated per crack area grows with the
  /// spacing. So it can be used to compare solvers at equal spacing, or for deformations that do not
  /// localise.
  static DamageLaw exponential(double threshold, double scale);
  /// Returns the damage for a history variable kappa >= 0 (a strain); constant beyond the last row.
  double operator()(double kappa) const;
  /// Returns the strain at which damage begins to grow.
  double threshold() const;
  /// Returns the factor of the tensile strength that this damage refers to: DamageCurve::relative_strength
  /// for the strength damage, which is normalised by the peak of its own curve; 1 for the stiffness damages,
  /// which determine the stress itself.
  double strength_factor() const { return factor; }

private:
  std::vector<double> strain, damage;
  double factor = 1;
  double start = 0, scale = 0; ///< threshold and scale of the exponential law; scale 0: the law is tabulated
};

} // namespace spall
