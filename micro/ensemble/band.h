#pragma once

#include "shared/damage_table.h"

#include <vector>

namespace spall {

/// Curves of many cells of one size put together, strain by strain.
struct Band {
  DamageCurve mean;   ///< mean stress
  DamageCurve weak;   ///< quantile of the stress
  DamageCurve strong; ///< its opposite
};

/// Mean and quantiles (`quantile` and 1 - `quantile`, linear between samples) of the stress at each strain of
/// a common grid, which goes as far as the shortest curve. Damage follows from that stress as for a single
/// curve: the quantile of the secant damage is exactly that of the stress. Energies and opening are means, in
/// the quantiles in proportion to the stress. Damages are kept from decreasing where curves of different
/// peaks overlap. The strength damage of each curve is normalised by its own peak; what the peak is in units
/// of the mean's is the curve's relative_strength.
/// @param curves of one size, at least one, each as envelope() gives it
/// @param modulus of the loading (stress of the uncracked cell per strain), Pa
/// @param growth of the grid's strains, as in SteppingSettings; @param unit strain up to which they are
/// equidistant
Band make_band(const std::vector<const DamageCurve*>& curves, double modulus, double quantile, double growth,
               double unit);

} // namespace spall
