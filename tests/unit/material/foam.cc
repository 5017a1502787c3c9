// Soil and crushable foam at a point against its own equations. The numbers are those of soil.prm, written
// down a second time.

#include "shared/error.h"
#include "tests/unit/material/samples.h"

#include <gtest/gtest.h>

namespace spall::test::of_foam {
namespace {

constexpr double GPa = 1e9, kPa = 1e3, dt = 1e-6, K = 30 * GPa, G = 63.85 * MPa;

Foam soil(std::vector<std::string> changes = {}) {
  for (std::string& change : changes) change = "Foam/" + change;
  return std::get<Foam>(material("soil", changes));
}

/// Changes the volume of a point evenly until -ln J is e.
void press_to(SinglePoint<Foam>& point, double e, int steps = 1000) {
  const double step = (-e - trace(point.strain)) / 3 / steps;
  for (int i = 0; i < steps; ++i) point.advance({step, step, step, 0, 0, 0}, dt);
}
double pressure(const SinglePoint<Foam>& point) { return -trace(point.stress) / 3; }
/// Square of the equivalent stress that the strength allows at p.
double square_of_strength(double p) { return 3 * (3.4e9 + 70.33 * kPa * p + 0.3 * p * p); }

TEST(Foam, CrushesAlongItsCurve) {
  const Foam m = soil();
  SinglePoint point(m);
  const std::vector<std::pair<double, double>> curve = {{0.052, 10}, {0.104, 20},  {0.1325, 30}, {0.192, 60},
                                                        {0.208, 90}, {0.277, 500}, {0.4, 4100}};
  for (const auto& [e, p] : curve) {
    press_to(point, e);
    EXPECT_NEAR(pressure(point), p * MPa, 1e-9 * p * MPa) << e;
    EXPECT_NEAR(equivalent_stress(deviator(point.stress)), 0, 1);
  }
  press_to(point, 0.41);
  EXPECT_NEAR(pressure(point), 4400 * MPa, 1) << "the last slope goes on";
}

TEST(Foam, UnloadsAndReloadsWithItsModulus) {
  const Foam m = soil();
  for (const auto& [largest, p] : {std::pair(0.052, 10 * MPa), {0.192, 60 * MPa}, {0.277, 500 * MPa}}) {
    SinglePoint point(m);
    press_to(point, largest);
    press_to(point, largest - 0.75 * p / K);
    EXPECT_NEAR(pressure(point), 0.25 * p, 1e-6 * p);
    press_to(point, largest);
    EXPECT_NEAR(pressure(point), p, 1e-6 * p);
    // What has crushed stays: work less what is stored is the area under the curve less p^2 / 2 K.
    EXPECT_NEAR(point.state.compaction, largest, 1e-12);
    EXPECT_NEAR(m.stored_energy(point.stress, point.state).total(), p * p / (2 * K), 1e-6 * p * p / K);
  }
  SinglePoint point(m);
  press_to(point, 0.104, 4000);
  EXPECT_NEAR(point.work, 0.5 * 0.104 * 20 * MPa, 10) << "the triangle under the first piece";
}

TEST(Foam, ShearEndsOnTheStrengthOfItsPressure) {
  const Foam m = soil();
  for (const double e : {0., 0.052, 0.192}) {
    SinglePoint point(m);
    press_to(point, e);
    const double p = pressure(point);
    for (int i = 0; i < 200; ++i) point.advance({0, 0, 0, 1e-2, 0, 0}, dt);
    EXPECT_NEAR(pressure(point), p, 1e-6 * p + 1) << "flow keeps the volume";
    const double q = equivalent_stress(deviator(point.stress));
    EXPECT_NEAR(q * q, square_of_strength(p), 1e-6 * square_of_strength(p));
    EXPECT_NEAR(point.stress[3], q / std::sqrt(3.), 1e-9 * q);
    // 2 exy / sqrt(3) in all, less what is elastic.
    EXPECT_NEAR(point.state.plastic_strain, 2 * 2 / std::sqrt(3.) - q / (3 * G), 1e-9);
  }
}

TEST(Foam, TheCapLimitsTheStrength) {
  const Foam m = soil({"Strength cap=5 MPa"});
  SinglePoint point(m);
  press_to(point, 0.192);
  for (int i = 0; i < 200; ++i) point.advance({0, 0, 0, 1e-2, 0, 0}, dt);
  EXPECT_NEAR(equivalent_stress(deviator(point.stress)), 5 * MPa, 1);
  EXPECT_EQ(m.strength_limit(), 5 * MPa);
  EXPECT_TRUE(std::isinf(soil().strength_limit()));
}

TEST(Foam, SeparatesAtTheCutOffAndGivesNothingBack) {
  const Foam m = soil();
  const double at_cut_off = 6.9 * kPa / K;
  for (const double crushed : {0., 0.104}) {
    SinglePoint point(m);
    press_to(point, crushed);
    const double left = crushed - pressure(point) / K; // without pressure
    press_to(point, left - 0.99 * at_cut_off, 20000);
    EXPECT_NEAR(pressure(point), -0.99 * 6.9 * kPa, 1);
    EXPECT_EQ(point.state.tensile_damage, 0);
    press_to(point, left - 1e-3);
    EXPECT_EQ(point.state.tensile_damage, 1);
    EXPECT_EQ(point.stress, Sym3{});
    for (int i = 0; i < 10; ++i) point.advance({0, 0, 0, 1e-3, 0, 0}, dt);
    EXPECT_EQ(point.stress, Sym3{}) << "it carries no shear";
    const double before = point.work;
    press_to(point, left - 1e-9);
    EXPECT_EQ(point.work, before);
    press_to(point, left + 0.2 * (crushed - left) + 1e-4);
    EXPECT_GT(pressure(point), 0) << "closed, it is pressed again";
    press_to(point, left - 0.5 * at_cut_off);
    EXPECT_EQ(point.stress, Sym3{}) << "it has no tension any more";
  }
}

TEST(Foam, RotatedPathGivesRotatedStress) {
  const Foam m = soil();
  const Mat3 r = rotation();
  SinglePoint point(m), rotated(m);
  RandomStrain strain(5e-3);
  for (int step = 0; step < 50; ++step) {
    Sym3 e = strain();
    for (int c = 0; c < 3; ++c) e[c] -= 3e-3;
    point.advance(e, dt);
    rotated.advance(rotate(r, e), dt);
  }
  const Sym3 expected = rotate(r, point.stress);
  EXPECT_SAME_STRESS(rotated.stress, expected, 1e-6 * MPa);
}

TEST(Foam, RefusesConstantsThatAreNoFoam) {
  const auto said = [](const std::vector<std::string>& changes, const std::string& words) {
    const std::string message = refusal("soil", changes);
    EXPECT_NE(message.find(words), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  };
  EXPECT_EQ(refusal("soil", {}), "");
  said({"Foam/Strains="}, "Foam/Strains': found none");
  said({"Foam/Strains=0.1, 0.2"}, "allowed: as many as Strains, 2");
  said({"Foam/Strains=0.2, 0.1", "Foam/Pressures=1 MPa, 2 MPa"}, "Foam/Strains': found 0.1 after 0.2");
  said({"Foam/Strains=0.1, 0.2", "Foam/Pressures=2 MPa, 1 MPa"},
       "Foam/Pressures': found 1e+06 Pa after 2e+06 Pa");
  said({"Foam/Unloading modulus=1 GPa"}, "Foam/Unloading modulus': found 1e+09 Pa, allowed: at least");
  said({"Foam/Tension cut-off=1 MPa"}, "Foam/Tension cut-off': found 1e+06 Pa, allowed: at most");
}

} // namespace
} // namespace spall::test::of_foam
