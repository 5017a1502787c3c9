#pragma once

#include "micro/cohesive/cohesive_law.h"

#include <cmath>

namespace spall {

/// Exponential traction-separation law f_t (exp(-w / c) - exp(-k)) / (1 - exp(-k)) with k = w_f / c = 5: an
/// exponential decay, shifted down by 0.7 % of f_t so that the traction reaches zero at w_f. c follows from
/// the area G_f; w_f = 5.18 G_f / f_t, close to the 5.14 of Hordijk's fit (1991).
class ExponentialSoftening final : public CohesiveLaw {
public:
  ExponentialSoftening(double strength, double fracture_energy)
      : ft(strength), c(fracture_energy / strength * (1 - end) / (1 - end - decays * end)) {}
  double strength() const override { return ft; }
  double final_opening() const override { return decays * c; }
  double traction(double w) const override { return ft * (std::exp(-w / c) - end) / (1 - end); }
  double slope(double w) const override { return -ft / c * std::exp(-w / c) / (1 - end); }
  double work(double w) const override { return ft * (-c * std::expm1(-w / c) - w * end) / (1 - end); }
  double steepest_slope() const override { return ft / (c * (1 - end)); }

private:
  static constexpr double decays = 5; ///< k = w_f / c
  inline static const double end = std::exp(-decays);
  double ft, c;
};

} // namespace spall
