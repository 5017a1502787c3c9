#pragma once

#include "shared/damage_table.h"

#include <vector>

namespace spall {

/// Mean and quantile curves of many cells of one size, computed at each strain.
struct Band {
  DamageCurve mean;   ///< curve of the mean stress
  DamageCurve weak;   ///< curve of the lower quantile of the stress
  DamageCurve strong; ///< curve of the upper quantile of the stress
};

/// Computes mean and quantiles (`quantile` and 1 - `quantile`, linear between samples) of the stress at each
/// strain of a common grid, which extends to the end of the shortest curve. The damage variables follow from
/// that stress as for a single curve: a quantile of the secant damage corresponds exactly to one of the
/// stress. Energies and opening are means; the energies of the quantile curves are scaled in proportion to
/// the stress. Where curves of different peaks overlap, damage is kept from decreasing. The strength damage
/// of each curve is normalised by the curve's own peak; the ratio of that peak to the mean curve's peak is
/// its relative_strength.
/// @param curves at least one curve, all of one cell size, each as envelope() returns it
/// @param modulus stress of the uncracked cell per unit of strain along the loading, Pa
/// @param growth relative step of the strain grid, as in SteppingSettings @param unit strain up to which the
/// grid is equidistant
Band make_band(const std::vector<const DamageCurve*>& curves, double modulus, double quantile, double growth,
               double unit);

} // namespace spall
