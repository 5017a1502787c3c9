// The law of Johnson and Cook at a point against its own equations.

#include "shared/error.h"
#include "tests/unit/material/samples.h"

#include <gtest/gtest.h>

namespace spall::test::of_johnson_cook {
namespace {

JohnsonCook law(const std::string& name, std::vector<std::string> changes = {}) {
  for (std::string& change : changes) change = "Johnson-Cook/" + change;
  return std::get<JohnsonCook>(material(name, changes));
}
JohnsonCook copper(const std::vector<std::string>& changes = {}) { return law("copper_ofhc_jc", changes); }

// The constants of copper_ofhc_jc.prm, written down a second time.
double strength_of_copper(double p, double rate, double heating) {
  return (90e6 + 292e6 * std::pow(p, 0.31)) * (1 + 0.025 * std::log(std::max(1., rate))) *
         (1 - std::pow(heating / (1356 - 298), 1.09));
}

TEST(JohnsonCook, StressIsTheStrengthAtThePlasticRateAndTemperatureOfTheStep) {
  const JohnsonCook m = copper();
  for (const double rate : {1e-3, 1., 10., 1e3, 1e5}) {
    SinglePoint point(m);
    const double shear = 1e-3, dt = shear / rate;
    double previous = 0;
    for (int i = 0; i < 1000; ++i) {
      const JohnsonCook::State before = point.state;
      point.advance({0, 0, 0, shear, 0, 0}, dt);
      const double grown = point.state.plastic_strain - before.plastic_strain;
      ASSERT_GT(grown, 0);
      const double expected = strength_of_copper(point.state.plastic_strain, grown / dt, before.heating);
      ASSERT_NEAR(equivalent_stress(point.stress), expected, 1e-10 * expected) << rate << " " << i;
      previous = expected;
    }
    // One shear strain unit: 2 / sqrt(3) of equivalent strain, but for the elastic part.
    EXPECT_NEAR(point.state.plastic_strain, 2 / std::sqrt(3.) - previous / (3 * m.shear_modulus()), 1e-9);
  }
}

TEST(JohnsonCook, RatesBelowTheReferenceRateDoNotMatter) {
  const JohnsonCook m = copper();
  SinglePoint slow(m), slower(m);
  for (int i = 0; i < 100; ++i) {
    slow.advance({0, 0, 0, 1e-3, 0, 0}, 1e-2);
    slower.advance({0, 0, 0, 1e-3, 0, 0}, 1e2);
  }
  EXPECT_SAME_STRESS(slow.stress, slower.stress, 1);
}

TEST(JohnsonCook, HeatsByTheShareOfPlasticWork) {
  const JohnsonCook m = copper();
  SinglePoint point(m);
  double plastic_work = 0;
  for (int i = 0; i < 5000; ++i) {
    const double before = point.state.plastic_strain;
    point.advance({0, 0, 0, 2e-4, 0, 0}, 1e-7);
    plastic_work += equivalent_stress(point.stress) * (point.state.plastic_strain - before);
  }
  EXPECT_NEAR(point.state.heating, 0.9 * plastic_work / (8960 * 383), 1e-9 * point.state.heating);
  // By the energy balance: what is neither stored nor heat is the tenth that stays in the lattice.
  const double dissipated = point.work - m.stored_energy(point.stress, point.state).total();
  EXPECT_NEAR(point.state.heating * 8960 * 383, 0.9 * dissipated, 2e-3 * dissipated);
  EXPECT_GT(point.state.heating, 80); // about 400 MPa over a strain of 1.15
  EXPECT_EQ(SinglePoint<JohnsonCook>(m).state.heating, 0);
}

TEST(JohnsonCook, WithoutHeatingTheTemperatureStays) {
  const JohnsonCook m = copper({"Taylor-Quinney coefficient=0"});
  SinglePoint point(m);
  for (int i = 0; i < 500; ++i) point.advance({0, 0, 0, 1e-3, 0, 0}, 1e-6);
  EXPECT_EQ(point.state.heating, 0);
}

TEST(JohnsonCook, MeltsToAFluidWithItsBulkModulus) {
  const JohnsonCook m = copper({"Specific heat=0.5 J/(kg K)"});
  SinglePoint point(m);
  for (int i = 0; i < 2000; ++i) point.advance({0, 0, 0, 1e-3, 0, 0}, 1e-6);
  EXPECT_NEAR(point.state.heating, 1356 - 298, 1) << "it heats less and less as it softens";
  point.state.heating = 1356 - 298;
  point.advance({-1e-3, 0, 0, 1e-2, 0, 0}, 1e-6);
  EXPECT_NEAR(equivalent_stress(deviator(point.stress)), 0, 1);
  EXPECT_NEAR(trace(point.stress) / 3, m.bulk_modulus() * trace(point.strain), 1e-3);
}

TEST(JohnsonCook, WithLinearHardeningAloneIsJ2) {
  J2 j2;
  j2.youngs_modulus = 124e9, j2.poisson_ratio = 0.34, j2.density = 8960;
  j2.initial_yield = 90e6, j2.hardening_modulus = 292e6;
  const JohnsonCook m = copper({"n=1", "C=0", "Taylor-Quinney coefficient=0"});
  SinglePoint<J2> reference(j2);
  SinglePoint<JohnsonCook> point(m);
  RandomStrain strain(5e-3);
  for (int i = 0; i < 300; ++i) {
    const Sym3 e = strain();
    const Stiffness expected = reference.advance(e, 1e-6), found = point.advance(e, 1e-6);
    EXPECT_SAME_STRESS(point.stress, reference.stress, 1e-9 * j2.youngs_modulus);
    ASSERT_NEAR(found.flow, expected.flow, 1e-9 * j2.youngs_modulus);
  }
  EXPECT_GT(point.state.plastic_strain, 0.5);
}

/// Follows a path until the point fails, and returns its plastic strain.
template<class Step> double failure_of(const JohnsonCook& m, Step step) {
  SinglePoint point(m);
  for (int i = 0; i < 200000 && point.state.damage < 1; ++i) step(point);
  EXPECT_EQ(point.state.damage, 1);
  return point.state.plastic_strain;
}

// The stress ratio of uniaxial stress and of shear does not change while they flow.
TEST(JohnsonCook, FailsAtTheStrainOfItsTriaxiality) {
  const JohnsonCook m = copper({"Failure=yes", "Taylor-Quinney coefficient=0", "C=0"});
  const auto strain = [](double s, double rate) {
    return (0.54 + 4.89 * std::exp(-3.03 * s)) * (1 + 0.014 * std::log(rate));
  };
  for (const double rate : {1., 1e4}) {
    const auto pull = [&](SinglePoint<JohnsonCook>& p) { p.advance_with_free_sides(1e-3, 1e-3 / rate); };
    const auto shear = [&](SinglePoint<JohnsonCook>& p) {
      p.advance({0, 0, 0, 1e-3, 0, 0}, 2e-3 / std::sqrt(3.) / rate);
    };
    EXPECT_NEAR(failure_of(m, pull), strain(1. / 3, rate), 2e-2 * strain(1. / 3, rate));
    EXPECT_NEAR(failure_of(m, shear), strain(0, rate), 3e-3);
  }
  // Pressed, it fails later; in plane tension with a bulk modulus, sooner.
  EXPECT_NEAR(m.failure_strain(-1. / 3, 1, 0), 0.54 + 4.89 * std::exp(1.01), 1e-12);
  EXPECT_NEAR(m.failure_strain(0, 1, 529), 5.43 * (1 + 1.12 / 2), 1e-12); // half way to melting
  EXPECT_EQ(m.failure_strain(1.5, 1, 0), m.failure_strain(9, 1, 0));
}

TEST(JohnsonCook, AFailedPointCarriesNeitherShearNorTension) {
  const JohnsonCook m = copper({"Failure=yes", "D1=1e-3", "D2=0"});
  SinglePoint point(m);
  const auto is_broken = [&] {
    const Sym3 s = deviator(point.stress);
    return equivalent_stress(s) < 1e-6 && trace(point.stress) <= 0;
  };
  const auto strain_on = [&] { point.advance({1e-4, 0, 0, 1e-4, 0, 0}, 1e-6); };
  for (strain_on(); point.state.damage < 1; strain_on()) EXPECT_FALSE(is_broken());
  EXPECT_TRUE(is_broken()) << "in the step in which it fails";
  RandomStrain strain(1e-3);
  for (int i = 0; i < 100; ++i) {
    const Stiffness stiffness = point.advance(strain(), 1e-6);
    const double volume = trace(point.strain);
    EXPECT_TRUE(is_broken());
    EXPECT_NEAR(trace(point.stress) / 3, m.bulk_modulus() * std::min(0., volume), 1);
    EXPECT_EQ(stiffness.bulk, volume < 0 ? m.bulk_modulus() : 0);
    EXPECT_EQ(stiffness.shear, 0);
    EXPECT_EQ(stiffness.limit, 0);
  }
}

TEST(JohnsonCook, TheStrainToFailureIsNeverBelowTheLeast) {
  const JohnsonCook m = copper({"Failure=yes", "D1=-1", "D2=0.1", "Least failure strain=1e-4"});
  EXPECT_EQ(m.failure_strain(1, 1, 0), 1e-4);
}

TEST(JohnsonCook, RotatedPathGivesRotatedStress) {
  const JohnsonCook m = law("steel_4340_jc", {"Failure=yes"});
  const Mat3 r = rotation();
  SinglePoint point(m), rotated(m);
  RandomStrain strain(5e-3);
  for (int i = 0; i < 50; ++i) {
    const Sym3 e = strain();
    point.advance(e, 1e-6);
    rotated.advance(rotate(r, e), 1e-6);
  }
  const Sym3 expected = rotate(r, point.stress);
  EXPECT_SAME_STRESS(rotated.stress, expected, 1e-9 * m.A);
  EXPECT_NEAR(rotated.state.damage, point.state.damage, 1e-10);
  EXPECT_GT(point.state.damage, 0);
}

TEST(JohnsonCook, TangentIsTheDerivativeOfTheUpdate) {
  const JohnsonCook m = law("steel_4340_jc");
  SinglePoint point(m);
  RandomStrain strain(1e-2);
  for (int i = 0; i < 20; ++i) point.advance(strain(), 1e-6);
  const Sym3 e = strain();
  const auto result = [&](const Sym3& increment, Sym3& stress) {
    JohnsonCook::State state = point.state;
    stress = point.stress;
    return m.update(stress, state,
                    {increment, 1e-6, std::exp(trace(point.strain) + trace(increment)), identity3});
  };
  Sym3 stress;
  const Stiffness tangent = result(e, stress);
  ASSERT_GT(tangent.flow, 0);
  for (int k = 0; k < 6; ++k) {
    constexpr double h = 1e-6;
    Sym3 up = e, down = e, direction{}, stress_up, stress_down;
    up[k] += h, down[k] -= h, direction[k] = 1;
    result(up, stress_up), result(down, stress_down);
    const Sym3 derivative = 1 / (2 * h) * (stress_up - stress_down);
    EXPECT_SAME_STRESS(tangent(direction), derivative, 1e-5 * m.youngs_modulus);
  }
}

TEST(JohnsonCook, AnElasticCycleGivesEverythingBack) {
  const JohnsonCook m = law("steel_4340_jc");
  SinglePoint point(m);
  point.advance({1e-3, -2e-4, 0, 5e-4, 0, 0}, 1e-6);
  EXPECT_NEAR(point.work, m.stored_energy(point.stress, point.state).total(), 1e-9 * point.work);
  EXPECT_GT(point.work, 0);
  point.advance({-1e-3, 2e-4, 0, -5e-4, 0, 0}, 1e-6);
  EXPECT_NEAR(point.work, 0, 1e-6);
}

TEST(JohnsonCook, RefusesToMeltBelowRoomTemperature) {
  JohnsonCook m = copper();
  m.melting_temperature = 290;
  try {
    m.validate("scene.prm", "bar/Johnson-Cook");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "scene.prm: key 'bar/Johnson-Cook/Melting temperature': found '290 K', "
              "allowed: > Room temperature = 298 K");
  }
}

// The constants of failure are needed only where it is on.
TEST(JohnsonCook, AsksForTheConstantsOfFailureOnlyWithFailure) {
  MaterialInputs inputs;
  Parameters parameters;
  inputs.declare(parameters);
  const std::string help = parameters.help("Johnson-Cook/D3");
  EXPECT_NE(help.find("Failure = yes"), std::string::npos) << help;
}

} // namespace
} // namespace spall::test::of_johnson_cook
