#include "micro/ensemble/band.h"

#include "micro/homogenization/damage.h"

#include <algorithm>
#include <cmath>

namespace spall {
namespace {

/// Interpolates y(x) linearly; beyond the last x it is constant.
double interpolate(const std::vector<double>& x, const std::vector<double>& y, double where) {
  const auto above = std::upper_bound(x.begin(), x.end(), where) - x.begin();
  if (above == static_cast<std::ptrdiff_t>(x.size())) return y.back();
  return y[above - 1] + (y[above] - y[above - 1]) * (where - x[above - 1]) / (x[above] - x[above - 1]);
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double quantile_of(std::vector<double> values, double quantile) {
  std::sort(values.begin(), values.end());
  const double place = quantile * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  if (below + 1 == values.size()) return values.back();
  return values[below] + (place - static_cast<double>(below)) * (values[below + 1] - values[below]);
}

void make_monotonic(std::vector<double>& damage) {
  for (std::size_t i = 0; i < damage.size(); ++i)
    damage[i] = std::clamp(std::max(damage[i], i > 0 ? damage[i - 1] : 0.0), 0.0, 1.0);
}

/// Fills the columns that follow from strain and stress; the other columns are filled already.
void complete(DamageCurve& curve, double modulus, double tensile_share, double initial) {
  double work = 0;
  for (std::size_t i = 0; i < curve.strain.size(); ++i) {
    const double strain = curve.strain[i], stress = curve.stress[i];
    if (i > 0) work += 0.5 * (stress + curve.stress[i - 1]) * (strain - curve.strain[i - 1]);
    curve.work.push_back(work);
    curve.psi.push_back(0.5 * stress * strain);
    curve.dissipation.push_back(std::max(0.0, work - curve.psi.back()));
    curve.psi_undamaged.push_back(0.5 * modulus * strain * strain);
    curve.damage.push_back(i == 0 ? initial : 1 - stress / (modulus * strain));
    const double change = i == 0 ? 0 : curve.psi_undamaged[i] - curve.psi_undamaged[i - 1];
    curve.damage_path.push_back(i == 0 ? initial : 1 - (curve.psi[i] - curve.psi[i - 1]) / change);
  }
  make_monotonic(curve.damage);
  for (const double damage : curve.damage)
    curve.damage_renormalised.push_back(1 - (1 - damage) / (1 - curve.damage.front()));
  set_strength_damage(curve, 1e-8);
  make_monotonic(curve.damage_strength);
  set_damage_plus(curve, {0.5 * modulus * tensile_share, 0.5 * modulus * (1 - tensile_share)});
}

} // namespace

Band make_band(const std::vector<const DamageCurve*>& curves, double modulus, double quantile, double growth,
               double unit) {
  Band band;
  double last = curves.front()->strain.back();
  for (const DamageCurve* curve : curves) last = std::min(last, curve->strain.back());
  std::vector<double> initial;
  for (const DamageCurve* curve : curves) initial.push_back(curve->damage.front());
  for (DamageCurve* curve : {&band.mean, &band.weak, &band.strong})
    curve->cell_size = curves.front()->cell_size;

  for (double strain = 0;; strain += growth * std::max(unit, strain)) {
    if (strain > last - 0.5 * growth * std::max(unit, strain)) strain = last;
    const auto all = [&](std::vector<double> DamageCurve::*column) {
      std::vector<double> values;
      for (const DamageCurve* curve : curves)
        values.push_back(interpolate(curve->strain, curve->*column, strain));
      return values;
    };
    const std::vector<double> stress = all(&DamageCurve::stress);
    const double mean = mean_of(stress), bulk = mean_of(all(&DamageCurve::psi_bulk)),
                 cohesive = mean_of(all(&DamageCurve::psi_cohesive)),
                 opening = mean_of(all(&DamageCurve::opening));
    const auto add = [&](DamageCurve& curve, double value) {
      const double share = mean > 0 ? value / mean : 1;
      curve.strain.push_back(strain);
      curve.stress.push_back(value);
      curve.psi_bulk.push_back(share * bulk);
      curve.psi_cohesive.push_back(share * cohesive);
      curve.opening.push_back(opening);
    };
    add(band.mean, mean);
    add(band.weak, quantile_of(stress, quantile));
    add(band.strong, quantile_of(stress, 1 - quantile));
    if (strain >= last) break;
  }
  // Share of Psi0+ in the energy of the uncracked cell, which is the same in all samples as they have the
  // same strain.
  const double tensile_share =
      curves.front()->psi_undamaged_plus.back() / curves.front()->psi_undamaged.back();
  complete(band.mean, modulus, tensile_share, mean_of(initial));
  complete(band.weak, modulus, tensile_share, quantile_of(initial, 1 - quantile));
  complete(band.strong, modulus, tensile_share, quantile_of(initial, quantile));
  const auto peak = [](const DamageCurve& curve) {
    return *std::max_element(curve.stress.begin(), curve.stress.end());
  };
  for (DamageCurve* curve : {&band.weak, &band.strong})
    curve->relative_strength = peak(*curve) / peak(band.mean);
  return band;
}

} // namespace spall
