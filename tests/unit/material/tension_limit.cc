// Tension of concrete whose largest principal stress is limited, as tests have it, and the fracture energy
// that it takes at any spacing, loading and rate.

#include "tests/unit/material/cracking_cell.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace spall::test {
namespace {

constexpr double T_max = 2.47 * MPa, fracture_energy = 80, cell = 16e-3; // Pa, N/m, m
const std::vector<std::string> principal = {"AFC/Tension limits=principal stress"};

std::vector<std::string> principal_and(std::vector<std::string> changes) {
  changes.insert(changes.begin(), principal.begin(), principal.end());
  return changes;
}

/// Largest principal stress, Pa, on a path of equal increments of strain.
double peak(const Afc& afc, const Sym3& increment, int steps, double dt = 1e-3) {
  SinglePoint point(afc);
  double largest = 0;
  for (int i = 0; i < steps; ++i) {
    point.advance(increment, dt);
    largest = std::max(largest, principal_values(point.stress)[0]);
  }
  return largest;
}

TEST(TensionLimit, IsThatOfOneTwoAndThreeDirections) {
  const Afc afc = wes5000(principal);
  for (const Sym3& direction : {Sym3{1, 0, 0, 0, 0, 0},
                                {1, 1, 0, 0, 0, 0},
                                {1, 1, 1, 0, 0, 0},
                                {1, -0.2, -0.2, 0, 0, 0},
                                {1, -1, 0, 0, 0, 0},
                                {0, 0, 0, 1, 0, 0}})
    EXPECT_NEAR(peak(afc, 1e-6 * direction, 1000), T_max, 1e-3 * T_max)
        << direction[1] << ", " << direction[2];
  // Kupfer, Hilsdorf and Ruesch (1969): biaxial and uniaxial tensile strength are equal. With free sides:
  SinglePoint point(afc);
  double uniaxial = 0;
  for (int i = 0; i < 400; ++i) {
    point.advance_with_free_sides(1e-6, 1e-3);
    uniaxial = std::max(uniaxial, point.stress[0]);
  }
  EXPECT_NEAR(uniaxial, T_max, 1e-6 * T_max);
}

TEST(TensionLimit, LeavesCompressionAsItIs) {
  const Sym3 compression = {-2, 1, 1, 0, 0, 0}, extension = {2, -1, -1, 0, 0, 0};
  const Afc limited = concrete("wes5000", principal),
            mean = concrete("wes5000", {"AFC/Tension limits=mean stress"});
  const auto strength = [](const Afc& afc, double pressure, const Sym3& s) {
    return afc.surface(pressure, 0, T_max, 1, s).stress;
  };
  for (const double pressure : {15.3 * MPa, 50 * MPa, 400 * MPa}) // from that of uniaxial compression on
    EXPECT_DOUBLE_EQ(strength(limited, pressure, compression), strength(mean, pressure, compression));
  for (const double pressure : {38 * MPa, 100 * MPa, 400 * MPa}) // from that of biaxial compression on
    EXPECT_DOUBLE_EQ(strength(limited, pressure, extension), strength(mean, pressure, extension));
  // Shear without pressure: its tension is the limit.
  EXPECT_NEAR(strength(limited, 0, {0, 0, 0, 1, 0, 0}), std::sqrt(3.) * T_max, 1e-6 * T_max);
}

/// Work per area of a point pulled along x until it is broken, N/m.
double work_to_break(const Afc& afc, double spacing, bool free_sides) {
  constexpr double rate = 1e-3;
  SinglePoint point(afc, spacing);
  const double step = 90e-6 / spacing / 20000;
  for (int i = 0; i < 20000; ++i)
    if (free_sides)
      point.advance_with_free_sides(step, step / rate);
    else
      point.advance({step, 0, 0, 0, 0, 0}, step / rate);
  // With free sides the last of the shear stiffness goes just before d_t = 1, and with it the strain that
  // drives d_t.
  EXPECT_NEAR(point.state.tensile_damage, 1, free_sides ? 2e-4 : 1e-9);
  return point.work * spacing;
}

Afc cracking(double spacing, const std::vector<std::string>& changes = {}) {
  std::vector<std::string> all = principal_and(changes);
  all.push_back("AFC/Shear damage=no"); // Eq. 24 would break a small cell in tension first
  Afc afc = wes5000(all);
  afc.tensile.use(cracking_cell(afc, cell, T_max, fracture_energy), {spacing});
  return afc;
}

TEST(TensionLimit, FractureEnergyIsThatOfTheTableWithAndWithoutFreeSides) {
  for (const double spacing : {16e-3, 8e-3, 4e-3})
    for (const bool free_sides : {false, true})
      EXPECT_NEAR(work_to_break(cracking(spacing), spacing, free_sides), fracture_energy,
                  0.03 * fracture_energy)
          << "spacing " << spacing << (free_sides ? ", free sides" : "");
}

// A crack of an isotropic band: volume and shape lose the same share of their stiffness, so that a point that
// is pulled in one direction keeps the ratio of its stresses, and one with free sides its Poisson ratio. Met
// by the deviator alone, the limit makes it flow at constant volume.
TEST(TensionLimit, AnOpenPointLosesVolumeAndShapeStiffnessAlike) {
  const double spacing = 8e-3, strain = 4e-3;
  for (const bool by_deviator : {false, true}) {
    std::vector<std::string> changes;
    if (by_deviator) changes = {"AFC/Tension limits=principal deviator"};
    const Afc afc = cracking(spacing, changes);
    SinglePoint held(afc, spacing), free(afc, spacing);
    for (int i = 0; i < 4000; ++i) {
      held.advance({strain / 4000, 0, 0, 0, 0, 0}, 1e-6);
      free.advance_with_free_sides(strain / 4000, 1e-6);
    }
    ASSERT_GT(held.state.tensile_damage, 0.3);
    const double nu = afc.poisson_ratio(), contraction = -free.strain[1] / free.strain[0];
    if (by_deviator) {
      EXPECT_NEAR(contraction, 0.5, 0.01);
      continue;
    }
    EXPECT_NEAR(held.state.shear_left / held.state.bulk_left, 1, 1e-2);
    EXPECT_NEAR(held.stress[1] / held.stress[0], nu / (1 - nu), 1e-2);
    EXPECT_NEAR(contraction, nu, 1e-2);
    EXPECT_NEAR(held.stress[0], T_max * (1 - held.state.tensile_damage), 1e-3 * T_max);
    EXPECT_NEAR(free.stress[0], T_max * (1 - free.state.tensile_damage), 1e-3 * T_max);
  }
}

// The energy per crack area of a point by itself, times the layers that the approximation spreads a crack
// over.
TEST(TensionLimit, LayersOfACrackBandTakeTheFractureEnergyTogether) {
  const double spacing = 8e-3;
  for (const double layers : {1., 2., 3.}) {
    const Afc afc = cracking(spacing, {"AFC/Crack band=" + std::to_string(layers)});
    EXPECT_NEAR(layers * work_to_break(afc, spacing, false), fracture_energy, 0.03 * fracture_energy);
  }
}

TEST(RadialCracks, HaveTheMaterialBetweenThemToThemselves) {
  const double spacing = 8e-3, radius = 0.06;
  for (const double band : {1., 2.})
    for (const double cracks : {0., 12., 24., 100.}) {
      const Afc afc = cracking(
          spacing, {"AFC/Radial cracks=" + std::to_string(cracks), "AFC/Crack band=" + std::to_string(band)});
      const double width = band * spacing,
                   arc = cracks > 0 ? std::max(width, 2 * std::numbers::pi * radius / cracks) : width;
      for (const int direction : {0, 1, 2}) {
        SinglePoint point(afc, spacing, radius);
        Sym3 increment{};
        increment[direction] = 70e-6 / spacing / 20000;
        for (int i = 0; i < 20000; ++i) point.advance(increment, 1e-6);
        EXPECT_NEAR(point.state.tensile_damage, 1, 1e-9);
        EXPECT_NEAR(point.work * (direction == 1 ? arc : width), fracture_energy, 0.04 * fracture_energy)
            << band << " layers, " << cracks << " cracks, direction " << direction;
      }
    }
}

TEST(TensionLimit, FractureEnergyGrowsAsTheExponentOfTheStrength) {
  // Factors up to that of the mean curve at 37 1/s. The elastic energy before the crack, R^2 of the static
  // one, is part of the fracture energy as long as it is less.
  for (const double factor : {2.3, 4.07, 5.2})
    for (const double exponent : {0.24, 1.})
      for (const double spacing : {4e-3, 8e-3}) {
        const Afc afc = cracking(spacing, {"AFC/Tensile rate factor=" + std::to_string(factor),
                                           "AFC/Fracture energy rate exponent=" + std::to_string(exponent)});
        SinglePoint point(afc, spacing);
        const double end = std::max(1., std::pow(factor, exponent - 1)) * 90e-6 / spacing + 2e-3,
                     step = end / 40000;
        double peak = 0;
        for (int i = 0; i < 40000; ++i) {
          point.advance({step, 0, 0, 0, 0, 0}, step);
          peak = std::max(peak, point.stress[0]);
        }
        EXPECT_NEAR(peak, factor * T_max, 1e-3 * T_max);
        const double expected = std::pow(factor, exponent) * fracture_energy;
        EXPECT_NEAR(point.work * spacing, expected, 0.05 * expected)
            << "factor " << factor << ", exponent " << exponent << ", spacing " << spacing;
      }
}

} // namespace
} // namespace spall::test
