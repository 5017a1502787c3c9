#pragma once

#include "micro/cohesive/cohesive_law.h"

namespace spall {

/// Bilinear traction-separation law: two straight lines that meet at f_t / 3 and 0.8 G_f / f_t and end at w_f
/// = 3.6 G_f / f_t, Petersson's fit to concrete (1981, report TVBM-1006, Lund). The first line is steep while
/// microcracks localise, the second one flat while aggregates bridge the crack.
class BilinearSoftening final : public CohesiveLaw {
public:
  BilinearSoftening(double strength, double fracture_energy)
      : ft(strength), w1(0.8 * fracture_energy / strength), wf(3.6 * fracture_energy / strength) {}
  double strength() const override { return ft; }
  double final_opening() const override { return wf; }
  double traction(double w) const override {
    return w < w1 ? ft * (1 - (1 - knee) * w / w1) : knee * ft * (wf - w) / (wf - w1);
  }
  double slope(double w) const override { return w < w1 ? -steepest_slope() : -knee * ft / (wf - w1); }
  double work(double w) const override {
    const double steep = w < w1 ? w : w1;
    return 0.5 * steep * (ft + traction(steep)) + (w < w1 ? 0 : 0.5 * (w - w1) * (knee * ft + traction(w)));
  }
  double steepest_slope() const override { return (1 - knee) * ft / w1; }

private:
  static constexpr double knee = 1.0 / 3; ///< traction at which the two lines meet, as a fraction of f_t
  double ft, w1, wf;
};

} // namespace spall
