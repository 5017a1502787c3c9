#include "shared/damage_law.h"

#include <algorithm>
#include <cmath>

namespace spall {
namespace {

/// Returns q (see DamageLaw) at every row up to the peak, by central differences, and by a backward
/// difference at the peak.
std::vector<double> crack_share(const DamageCurve& curve, std::size_t peak) {
  std::vector<double> share(peak + 1, 0);
  const auto spent = [&](std::size_t i) { return curve.dissipation[i] - curve.psi_cohesive[i]; };
  for (std::size_t i = 1; i <= peak; ++i) {
    const std::size_t next = std::min(i + 1, peak);
    const double slope = (spent(next) - spent(i - 1)) / (curve.strain[next] - curve.strain[i - 1]);
    share[i] = std::clamp(slope / curve.stress[i], 0.0, 1.0);
  }
  return share;
}

} // namespace

DamageLaw::DamageLaw(const DamageTable& table, double spacing, DamageDefinition definition) {
  const auto distance = [spacing](const DamageCurve& c) { return std::abs(std::log(c.cell_size / spacing)); };
  const DamageCurve& curve = *std::min_element(
      table.curves.begin(), table.curves.end(),
      [&](const DamageCurve& a, const DamageCurve& b) { return distance(a) < distance(b); });
  const double modulus = table.oedometric_modulus(), ratio = curve.cell_size / spacing,
               first = curve.damage.front();
  const std::size_t peak = std::max_element(curve.stress.begin(), curve.stress.end()) - curve.stress.begin();
  const std::vector<double> share = crack_share(curve, peak);
  if (definition == DamageDefinition::strength) factor = curve.relative_strength;
  for (std::size_t i = 0; i < curve.strain.size(); ++i) {
    double mapped = curve.strain[i];
    if (i > peak) {
      const double elastic = curve.strain[peak] * curve.stress[i] / curve.stress[peak];
      mapped = elastic + (curve.strain[i] - elastic) * ratio;
    }
    const double stress = curve.stress[i] / (1 + (1 / ratio - 1) * share[std::min(i, peak)]);
    // The secant damage is computed from the rescaled stress and strain; the strength damage is a ratio of
    // stresses and does not change.
    const double secant = mapped > 0 ? 1 - stress / (modulus * mapped) : first;
    const double value =
        std::clamp(definition == DamageDefinition::strength    ? curve.damage_strength[i]
                   : definition == DamageDefinition::stiffness ? secant
                                                               : 1 - (1 - secant) / (1 - first),
                   0.0, 1.0);
    // At a spacing far above the cell size the branch after the peak snaps back. Then the envelope is kept,
    // which the strain-driven material point follows with a sudden drop.
    if (!strain.empty() && mapped <= strain.back()) {
      damage.back() = std::max(damage.back(), value);
      continue;
    }
    strain.push_back(mapped);
    damage.push_back(damage.empty() ? value : std::max(value, damage.back()));
  }
}

DamageLaw DamageLaw::exponential(double threshold, double scale) {
  DamageLaw law;
  law.start = threshold;
  law.scale = scale;
  return law;
}

double DamageLaw::operator()(double kappa) const {
  if (scale > 0) return kappa > start ? 1 - std::exp((start - kappa) / scale) : 0;
  const auto above = std::upper_bound(strain.begin(), strain.end(), kappa);
  if (above == strain.begin()) return damage.front();
  if (above == strain.end()) return damage.back();
  const auto i = above - strain.begin();
  const double t = (kappa - strain[i - 1]) / (strain[i] - strain[i - 1]);
  return damage[i - 1] + t * (damage[i] - damage[i - 1]);
}

double DamageLaw::threshold() const {
  if (scale > 0) return start;
  for (std::size_t i = 1; i < damage.size(); ++i)
    if (damage[i] > damage.front()) return strain[i - 1];
  return strain.back();
}

} // namespace spall
