// The law against an integration that shares nothing with it: principal values in MPa, the consistency
// condition in rate form instead of a return, steps twenty times smaller. In tension the damage of shear
// follows from the strain of a sound deviator.

#include "tests/unit/material/samples.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

using Triple = std::array<double, 3>;

/// Eqs. 20 to 24 of the paper with the constants of Table 1, mean stress as I1; tension positive, MPa.
struct RateForm {
  static constexpr double K = 55.14 / 0.0025, G = 6892.7, T = 2.47;
  Triple s{};                            ///< deviator
  double volume = 0, largest = 0, d = 0; ///< ln J, largest -ln J
  double P = 0;
  Triple sound{};    ///< in tension: the deviator of a sound point, of which s is a share
  double share = 1;  ///< of it
  bool open = false; ///< whether the point is in tension

  static double equivalent(const Triple& a) {
    return std::sqrt(1.5 * (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]));
  }
  static double crush(double mu) {
    const double m = mu - 0.0025;
    return mu <= 0.0025 ? K * mu : 55.14 + 4248.3 * m + 6196.5 * m * m + 68237 * m * m * m;
  }
  static double unloading(double mu) {
    return mu <= 0.0025 ? K : K + (68237 - K) * (mu - 0.0025) / (0.25 - 0.0025);
  }
  static double residual(double mu) { return mu <= 0.0025 ? 0 : mu - crush(mu) / unloading(mu); }
  double pressure() const {
    return -volume >= largest ? crush(-volume) : crush(largest) - unloading(largest) * (largest + volume);
  }
  static double strength(double p, double damage, double rate) {
    const double factor = 1 + 0.01 * std::log(std::max(rate, 1e-3));
    if (p < 0) return (501.05 - 476.3) * (1 - damage) * (T + p) / T * factor;
    return (501.05 - (476.3 + (501.05 - 476.3) * damage) * std::exp(-0.00324 * p) + 0.1 * p) * factor;
  }

  /// In tension: s = share * sound; the share falls where s would exceed the strength.
  void crack(const Triple& de, double rate) {
    if (!open) sound = s;
    open = true;
    const double before = (1 - share) * equivalent(sound);
    for (int i = 0; i < 3; ++i) sound[i] += 2 * G * de[i];
    const double q = equivalent(sound), S = strength(P, d, rate);
    if (share * q > S) {
      share = S / q;
      d = std::min(1.0, d + std::max(0.0, (1 - share) * q - before) / (3 * G) / 0.01);
    }
    for (int i = 0; i < 3; ++i) s[i] = share * sound[i];
  }

  void advance(const Triple& e, double dt) {
    const double theta = e[0] + e[1] + e[2];
    Triple de;
    double rate = 0;
    for (int i = 0; i < 3; ++i) de[i] = e[i] - theta / 3, rate += de[i] * de[i];
    rate = std::sqrt(2. / 3 * rate) / dt;
    const double before = P;
    volume += theta;
    if (-volume > largest) {
      d += (residual(-volume) - residual(largest)) / (1.5 * 0.25);
      largest = -volume;
    }
    P = pressure();
    if (P < 0) return crack(de, rate);
    const double q = equivalent(s);
    double multiplier = 0;
    if (q >= strength(P, d, rate)) {
      // dq = dS: 3 G (n : de - dl) = S_p dP + S_d dl / eps_f, with n = 3 s / (2 q) and q-work n : de.
      double along = 0;
      for (int i = 0; i < 3; ++i) along += s[i] / q * de[i];
      const double slope = (strength(P + 1e-4, d, rate) - strength(P - 1e-4, d, rate)) / 2e-4;
      const double softening = (strength(P, d + 1e-6, rate) - strength(P, d - 1e-6, rate)) / 2e-6;
      const double failure = std::max(0.01, 0.0006 * P);
      // Baumgarte's correction removes the drift of q above S.
      const double drift = q - strength(P, d, rate);
      multiplier =
          std::max(0.0, (3 * G * along - slope * (P - before) + drift) / (3 * G + softening / failure));
      d = std::min(1.0, d + multiplier / failure);
    }
    for (int i = 0; i < 3; ++i) s[i] += 2 * G * de[i] - (q > 0 ? 3 * G * multiplier * s[i] / q : 0);
  }
};

TEST(IndependentIntegration, AgreesAlongATriaxialPathWithUnloadingAndTension) {
  const Afc afc = wes5000();
  SinglePoint point(afc);
  RateForm reference;
  // The path: compression to the crushing branch, triaxial compression, triaxial extension, unloading,
  // tension up to half of the tension limit, shear.
  struct Leg {
    Triple strain;
    double duration;
  };
  const Leg path[] = {{{-2e-3, -2e-3, -2e-3}, 1e-3}, {{-2e-2, 2e-3, 3e-3}, 1e-2},
                      {{8e-3, -6e-3, -4e-3}, 1},     {{-6e-3, -1e-3, 2e-3}, 1e-4},
                      {{3e-3, 4e-3, 1e-3}, 1e-3},    {{1e-3, -4e-4, -6e-4}, 1e-3}};
  constexpr int coarse = 4000, fine = 20;
  double softest = 1e9, largest_shear = 0;
  for (const Leg& leg : path)
    for (int i = 0; i < coarse && !(&leg == path + 4 && reference.P < -1.2); ++i) {
      Triple e;
      for (int c = 0; c < 3; ++c) e[c] = leg.strain[c] / coarse;
      point.advance({e[0], e[1], e[2], 0, 0, 0}, leg.duration / coarse);
      for (double& x : e) x /= fine;
      for (int k = 0; k < fine; ++k) reference.advance(e, leg.duration / coarse / fine);
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(point.stress[c] / MPa, reference.s[c] - reference.P, 0.6) << "step " << i;
      ASSERT_NEAR(point.state.shear_damage, reference.d, 5e-3) << "step " << i << " of leg " << &leg - path;
      softest = std::min(softest, -trace(point.stress) / 3 / MPa);
      largest_shear = std::max(largest_shear, equivalent_stress(deviator(point.stress)) / MPa);
    }
  EXPECT_GT(point.state.plastic_strain, 0.01);
  EXPECT_GT(largest_shear, 100);
  EXPECT_GT(point.state.shear_damage, 0.3);
  EXPECT_LT(softest, -0.5); // the path reaches tension, but not the cut-off
  EXPECT_GT(softest, -2.4);
}

} // namespace
} // namespace spall::test
