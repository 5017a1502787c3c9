#pragma once

#include "micro/cohesive/cohesive_law.h"

namespace spall {

/// Linear traction-separation law: a straight line from f_t to zero at w_f = 2 G_f / f_t.
class LinearSoftening final : public CohesiveLaw {
public:
  LinearSoftening(double strength, double fracture_energy)
      : ft(strength), wf(2 * fracture_energy / strength) {}
  double strength() const override { return ft; }
  double final_opening() const override { return wf; }
  double traction(double opening) const override { return ft * (1 - opening / wf); }
  double slope(double) const override { return -ft / wf; }
  double work(double opening) const override { return ft * opening * (1 - 0.5 * opening / wf); }
  double steepest_slope() const override { return ft / wf; }

private:
  double ft, wf;
};

} // namespace spall
