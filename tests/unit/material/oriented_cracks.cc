// Concrete whose cracks have directions: what a crack takes across itself, and that it takes nothing along
// itself.

#include "tests/unit/material/cracking_cell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace spall::test {
namespace {

constexpr double T_max = 2.47 * MPa, fracture_energy = 80, cell = 16e-3; // Pa, N/m, m

OrientedAfc oriented(CrackModel model, double spacing = cell, std::vector<std::string> changes = {}) {
  Afc afc = wes5000(changes);
  afc.crack_model = model;
  afc.tensile.use(cracking_cell(afc, cell, T_max, fracture_energy), {spacing});
  return OrientedAfc(afc);
}

class Oriented : public ::testing::TestWithParam<CrackModel> {};
INSTANTIATE_TEST_SUITE_P(Models, Oriented, ::testing::Values(CrackModel::fixed, CrackModel::rotating),
                         [](const auto& info) {
                           return std::string(info.param == CrackModel::fixed ? "Fixed" : "Rotating");
                         });

void pull(SinglePoint<OrientedAfc>& point, const Sym3& strain, int steps = 2000) {
  for (int i = 0; i < steps; ++i) point.advance(1. / steps * strain, 1e-3);
}
void pull_free(SinglePoint<OrientedAfc>& point, double strain, int steps = 2000) {
  for (int i = 0; i < steps; ++i) point.advance_with_free_sides(strain / steps, 1e-3);
}

TEST_P(Oriented, StrengthIsThatOfOneTwoAndThreeDirections) {
  const OrientedAfc law = oriented(GetParam());
  for (const Sym3& direction : {Sym3{1, 0, 0, 0, 0, 0},
                                {1, 1, 0, 0, 0, 0},
                                {1, 1, 1, 0, 0, 0},
                                {1, -1, 0, 0, 0, 0},
                                {0, 0, 0, 1, 0, 0},
                                {1, 0.3, -0.2, 0.4, 0.1, -0.5}}) {
    SinglePoint point(law, cell);
    double largest = 0;
    for (int i = 0; i < 2000; ++i) {
      point.advance(1e-6 * direction, 1e-3);
      largest = std::max(largest, principal_values(point.stress)[0]);
    }
    EXPECT_NEAR(largest, T_max, 1e-3 * T_max) << direction[1] << ", " << direction[3];
  }
}

TEST_P(Oriented, FractureEnergyIsThatOfTheTableAtAnySpacing) {
  for (const double spacing : {16e-3, 8e-3, 4e-3})
    for (const bool free_sides : {false, true}) {
      const OrientedAfc law = oriented(GetParam(), spacing);
      SinglePoint point(law, spacing);
      const double strain = 90e-6 / spacing;
      if (free_sides)
        pull_free(point, strain, 20000);
      else
        pull(point, {strain, 0, 0, 0, 0, 0}, 20000);
      EXPECT_NEAR(point.state.tensile_damage, 1, 1e-9);
      EXPECT_NEAR(point.stress[0], 0, 1e-6 * T_max);
      EXPECT_NEAR(point.work * spacing, fracture_energy, 0.02 * fracture_energy)
          << spacing << (free_sides ? ", free sides" : "");
    }
}

// What is pulled across a crack feels nothing; what is pressed or pulled along it has the stiffness of the
// sound concrete in plane stress, and all of its strength in tension.
TEST_P(Oriented, ABrokenPointIsSoundAlongItsCrack) {
  const OrientedAfc law = oriented(GetParam());
  for (const double sign : {-1., 1.}) {
    if (sign > 0 && GetParam() == CrackModel::rotating) continue; // its history is that of all directions
    SinglePoint point(law, cell);
    pull(point, {6e-3, 0, 0, 0, 0, 0}, 6000);
    ASSERT_NEAR(point.stress[0], 0, 1);
    const Sym3 before = point.stress;
    const double e = sign * 2e-5; // below the strength
    pull(point, {0, e, 0, 0, 0, 0}, 200);
    const double E = law.afc.youngs_modulus(), nu = law.afc.poisson_ratio();
    const double share = std::exp(-point.state.opened); // of the cell that is not crack
    EXPECT_NEAR(point.stress[1] - before[1], share * E / (1 - nu * nu) * e, 2e-3 * E * std::abs(e)) << sign;
    EXPECT_NEAR(point.stress[2] - before[2], share * nu * E / (1 - nu * nu) * e, 2e-3 * E * std::abs(e))
        << sign;
    EXPECT_NEAR(point.stress[0], 0, 1);
  }
}

TEST(FixedCracks, LeaveTheStrengthAlongThem) {
  const OrientedAfc law = oriented(CrackModel::fixed);
  SinglePoint point(law, cell);
  pull(point, {6e-3, 0, 0, 0, 0, 0}, 6000);
  double largest = 0;
  for (int i = 0; i < 400; ++i) {
    point.advance({0, 1e-6, 0, 0, 0, 0}, 1e-3);
    largest = std::max(largest, point.stress[1]);
  }
  EXPECT_NEAR(largest, std::exp(-6e-3) * T_max, 1e-3 * T_max);
}

// Splitting: a side is pulled, the others are pressed, and the mean is pressure. The crack opens all the
// same, and the concrete beside it carries the pressure of the sides on with nothing across.
TEST_P(Oriented, ACrackOpensUnderPressureFromTheSides) {
  const OrientedAfc law = oriented(GetParam());
  SinglePoint point(law, cell);
  pull(point, {0, 0, -4e-4, 0, 0, 0}, 400);
  pull(point, {6e-3, 0, 0, 0, 0, 0}, 6000);
  EXPECT_LT(trace(point.stress), -1 * MPa); // pressed in the mean
  EXPECT_NEAR(point.stress[0], 0, 100);
  EXPECT_GT(point.state.total_opening(), 0.9 * 6e-3);
  const double E = law.afc.youngs_modulus(), nu = law.afc.poisson_ratio();
  EXPECT_NEAR(point.stress[2], -4e-4 * E / (1 - nu * nu), 0.01 * E * 4e-4); // plane stress, yy held
  EXPECT_EQ(point.state.plastic_strain, 0);
}

TEST_P(Oriented, ACrackClosesAlongTheSecantAndThenPresses) {
  const OrientedAfc law = oriented(GetParam());
  SinglePoint point(law, cell);
  pull(point, {2e-3, 0, 0, 0, 0, 0});
  const double open = point.stress[0];
  ASSERT_GT(open, 0.05 * T_max);
  for (const double share : {0.75, 0.5, 0.25, 0.9, 1.}) {
    pull(point, {share * 2e-3 - point.strain[0], 0, 0, 0, 0, 0}, 100);
    EXPECT_NEAR(point.stress[0], share * open, 1e-3 * open) << share;
  }
  pull(point, {-point.strain[0], 0, 0, 0, 0, 0}, 100);
  EXPECT_NEAR(point.stress[0], 0, 1e-3 * open);
  pull(point, {-1e-4, 0, 0, 0, 0, 0}, 100);
  EXPECT_NEAR(point.stress[0], -1e-4 * (law.bulk_modulus() + 4. / 3 * law.shear_modulus()), 0.01 * MPa);
}

// Turned as a whole, in large steps and small, a point has the same stresses, turned.
TEST_P(Oriented, CracksTurnWithThePoint) {
  const OrientedAfc law = oriented(GetParam());
  SinglePoint still(law, cell), turned(law, cell);
  const Mat3 q = rotation();
  const Sym3 first = {1e-3, 0, -2e-4, 3e-4, 0, 0}, second = {-5e-4, 8e-4, 1e-4, 0, 2e-4, -3e-4};
  pull(still, first), pull(still, second);
  pull(turned, first);
  turned.turn(q);
  pull(turned, rotate(q, second));
  EXPECT_SAME_STRESS(turned.stress, rotate(q, still.stress), 1e-6 * T_max);
  EXPECT_NEAR(turned.work, still.work, 1e-9 * still.work);
}

// A fixed crack that is open and broken carries no shear stress; its closed faces do.
TEST(FixedCracks, AnOpenCrackDropsItsShearStress) {
  const OrientedAfc law = oriented(CrackModel::fixed);
  SinglePoint point(law, cell);
  pull(point, {6e-3, 0, 0, 0, 0, 0}, 6000);
  pull(point, {0, 0, 0, 1e-3, 0, 2e-4}, 500);
  EXPECT_NEAR(point.stress[3], 0, 1);
  EXPECT_NEAR(point.stress[5], 0, 1);
  pull(point, {-6.1e-3, 0, 0, 0, 0, 0}, 6000);
  ASSERT_LT(point.stress[0], -1 * MPa);
  pull(point, {0, 0, 0, 1e-5, 0, 0}, 10);
  EXPECT_NEAR(point.stress[3], 2e-5 * law.shear_modulus(), 1e-3 * MPa);
}

// Willam, Pramono and Sture (1987): a point that is pulled until it cracks and then strained so that the
// principal directions turn. The directions of the stress follow those of the strain with a rotating crack
// alone.
TEST(RotatingCracks, StressAndStrainHaveTheSameDirections) {
  const auto misfit = [](CrackModel model) {
    const OrientedAfc law = oriented(model);
    SinglePoint point(law, cell);
    const double e = T_max / law.afc.youngs_modulus(), nu = law.afc.poisson_ratio();
    pull(point, e * Sym3{1.2, -nu, 0, 0, 0, 0}, 500);
    pull(point, 10 * e * Sym3{0.5, 0.75, 0, 0.5, 0, 0}, 5000);
    const Sym3 s =
        rotate(principal_directions(point.strain), point.stress); // no shear in axes of the strain?
    return largest_component(Vec3{s[3], s[4], s[5]}) / largest_component(s);
  };
  EXPECT_LT(misfit(CrackModel::rotating), 1e-3);
  EXPECT_GT(misfit(CrackModel::fixed), 0.01);
}

// Crushed concrete has other slopes of the pressure where it is loaded and unloaded, and steps of a fragment
// are many elastic strains long. An open crack carries what its limit lets it, and no pressure, all the same.
TEST_P(Oriented, OpenCracksOfCrushedConcreteCarryNoPressure) {
  const OrientedAfc law = oriented(GetParam());
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> range(-1, 1);
    SinglePoint point(law, cell);
    pull(point, {-0.03, -0.03, -0.03, 0, 0, 0}, 3000);
    pull(point, {0.1, 0.1, 0.1, 0, 0, 0}, 3000);
    int open_steps = 0, pressed_steps = 0;
    for (int i = 0; i < 400; ++i) {
      Sym3 increment;
      for (double& x : increment) x = 3e-3 * range(engine);
      point.advance(plus_spherical(increment, i % 200 < 100 ? -2e-3 : 2e-3), 1e-6);
      const Sym3 s = rotate(point.state.normals, point.stress);
      for (std::size_t c = 0; c < 3; ++c) {
        if (!point.state.open(c)) continue;
        ++open_steps;
        EXPECT_NEAR(s[c], 0, point.state.limit[c] + 1e3) << seed << ", " << i;
      }
      pressed_steps += trace(point.stress) < -100 * MPa;
    }
    EXPECT_GT(open_steps, 100);
    EXPECT_GT(pressed_steps, 10);
  }
}

// Cracks that open by as much as the cell.
TEST_P(Oriented, WideCracksGiveBackNoMoreThanIsStored) {
  const OrientedAfc law = oriented(GetParam());
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> range(-1, 1);
    SinglePoint point(law, cell);
    double most = 0, dissipated = 0;
    for (int piece = 0; piece < 12; ++piece) {
      Sym3 direction;
      for (double& x : direction) x = range(engine);
      // Wide openings, and between them small strains along the cracks, which store energy.
      const double size = piece % 3 == 0 ? 0.3 : 3e-4;
      if (piece % 3 == 0) direction = plus_spherical(direction, 0.5);
      const int steps = piece % 3 == 0 ? 20000 : 2000; // of at most an elastic strain
      for (int i = 0; i < steps; ++i) {
        point.advance(size / steps * direction, 1e-5);
        const double stored = point.volume() * law.stored_energy(point.stress, point.state).total();
        most = std::max(most, stored);
        ASSERT_GE(point.work - stored, 0.999 * dissipated - 0.05 * most - 1)
            << "seed " << seed << ", " << piece;
        dissipated = std::max(dissipated, point.work - stored);
      }
    }
  }
}

TEST(Oriented, WhatDoesNotGoWithDirectionsIsRefused) {
  for (const char* key : {"AFC/Opening=cut-off", "AFC/Volumetric strain=density ratio"}) {
    const std::string set = key, name = set.substr(0, set.find('='));
    EXPECT_NE(refusal("wes5000", {"AFC/Crack model=fixed", set}).find(name), std::string::npos);
    EXPECT_EQ(refusal("wes5000", {"AFC/Crack model=isotropic", set}), "");
  }
  EXPECT_EQ(refusal("wes5000", {"AFC/Crack model=fixed"}), "");
}

} // namespace
} // namespace spall::test
