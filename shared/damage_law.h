#pragma once

#include "shared/damage_table.h"

#include <vector>

namespace spall {

/// Which damage of the table weakens the macroscopic strength (Eq. 30).
enum class DamageDefinition {
  strength,              ///< damage_strength: dissipates the cell's fracture energy
  stiffness,             ///< damage: the paper to the letter
  stiffness_renormalised ///< damage_renormalised: the initial crack is part of the measured K and G
};

/// d_t(strain), tabulated or analytic. Of a table at any nodal spacing h, so that the energy dissipated per
/// crack area does not depend on the spacing (Ren et al. 2011). The curve of the size l nearest to h (in
/// ratio) is resized:
///
/// - Up to the peak everything grows with the cell, and stress against strain stays, but for the tip zones,
///   which a larger cell opens further down the softening curve. The work W(strain, l) is the least energy of
///   bulk and cracks; l enters it through the cracks alone, hence, exactly,
///     dW / d ln l = psi_cohesive - dissipation   at constant strain.
///   Its derivative with the strain changes the stress; as it grows with l the change is carried as
///   s_h = s / (1 + (h / l - 1) q), q = d(dissipation - psi_cohesive) / dW.
/// - After the peak the strain splits into a part that vanishes with the stress along the secant of the peak
///   and the opening of one crack over the cell, which is spread over h instead:
///     eps_h = e + (eps - e) l / h, e = eps_peak s / s_peak;   s_h / s stays that of the peak.
///
/// From the cell of 15.875 mm to cells computed directly at 5, 10, 20 and 40 mm the stiffness damage misses
/// by less than 0.001 and the strength damage by less than 0.001 (linear softening; 0.002 and 0.004 with
/// exponential and bilinear). Without q the former would be 0.006: the peak stress falls by 1 % from 5 to
/// 40 mm. A small value: copy it freely; evaluation allocates nothing.
class DamageLaw {
public:
  DamageLaw() = default;
  DamageLaw(const DamageTable& table, double spacing, DamageDefinition definition);
  /// An analytic law for verification: d = 1 - exp(-(kappa - threshold) / scale) beyond the threshold, the
  /// same at any spacing. Not regularised: the energy dissipated per crack area grows with the spacing, so it
  /// serves the comparison of solvers at equal spacing or at deformations that do not localise.
  static DamageLaw exponential(double threshold, double scale);
  /// Damage at a strain history kappa >= 0; constant beyond the last row.
  double operator()(double kappa) const;
  /// Strain at which damage first exceeds 0.
  double threshold() const;
  /// Factor on the strength that this damage reduces: DamageCurve::relative_strength for the strength
  /// damage, which is normalised by the peak of its own curve; 1 for the damages of stiffness, which hold the
  /// stress itself.
  double strength_factor() const { return factor; }

private:
  std::vector<double> strain, damage;
  double factor = 1;
  double start = 0, scale = 0; ///< of the exponential law; scale 0: tabulated
};

} // namespace spall
