// Tests of the bands that the measured numerical error leaves open: laws, whatever the measured numbers are.

#include "macro/output/numerical_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace spall::test {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
/// Resolutions of the 127 mm slab that have been measured with sub-points around the axis.
constexpr double measured[] = {25.4 / 11, 25.4 / 8, 25.4 / 5.3};

NumericalError subpoints(double across, double path = 5) {
  return error_of_resistance({.scheme = Scheme::subpoint, .axis = true, .across = across}, path);
}

TEST(ErrorOfResistance, IsKnownWithoutRemarkWhereItHasBeenMeasured) {
  for (const double across : measured) {
    const NumericalError error = subpoints(across);
    EXPECT_TRUE(error.known());
    EXPECT_EQ(error.remark, "");
    EXPECT_GT(error.relative(), 0);
    EXPECT_NEAR(std::pow(error.relative(), 2), std::pow(error.spacing, 2) + std::pow(2 * error.layout, 2),
                1e-15);
  }
}

TEST(ErrorOfResistance, IsLinearInTheSpacingBetweenMeasuredResolutions) {
  for (int i = 0; i < 2; ++i) {
    const NumericalError coarse = subpoints(measured[i]), fine = subpoints(measured[i + 1]);
    for (const double part : {0.0, 0.25, 0.9, 1.0}) {
      const NumericalError error = subpoints(1 / std::lerp(1 / measured[i], 1 / measured[i + 1], part));
      EXPECT_NEAR(error.spacing, std::lerp(coarse.spacing, fine.spacing, part), 1e-12);
      EXPECT_NEAR(error.layout, std::lerp(coarse.layout, fine.layout, part), 1e-12);
    }
  }
}

TEST(ErrorOfResistance, GrowsBeyondTheCoarsestAndStaysBeyondTheFinestAndSaysSo) {
  const NumericalError coarsest = subpoints(measured[0]), coarser = subpoints(0.5 * measured[0]);
  EXPECT_NEAR(coarser.spacing, 2 * coarsest.spacing, 1e-12);
  EXPECT_NEAR(coarser.layout, 2 * coarsest.layout, 1e-12);
  EXPECT_NE(coarser.in_words("shot").find("coarser than any measured"), std::string::npos);
  const NumericalError finest = subpoints(measured[2]), finer = subpoints(3 * measured[2]);
  EXPECT_EQ(finer.spacing, finest.spacing);
  EXPECT_EQ(finer.layout, finest.layout);
  EXPECT_NE(finer.in_words("shot").find("finer than any measured"), std::string::npos);
  EXPECT_EQ(subpoints(0.97 * measured[0]).remark, ""); // cells rarely fit a body exactly
}

TEST(ErrorOfResistance, ScatterAveragesOutAlongThePathButIsNotExtrapolatedToShortOnes) {
  const NumericalError once = subpoints(3), longer = subpoints(3, 20);
  EXPECT_NEAR(longer.layout, 0.5 * once.layout, 1e-12);
  EXPECT_EQ(longer.spacing, once.spacing);
  for (const double path : {0.0, 1.0}) EXPECT_EQ(subpoints(3, path).layout, once.layout);
}

TEST(ErrorOfResistance, ASchemeOrWeightWithoutStudyHasNone) {
  const Numerics dni = {.scheme = Scheme::dni, .axis = true, .across = 3},
                 light = {.scheme = Scheme::nsni, .weight = 0.3, .axis = true, .across = 3};
  EXPECT_EQ(error_of_resistance(dni, 5).in_words("shot"),
            "not measured for scheme DNI with rotational symmetry");
  EXPECT_EQ(error_of_resistance(light, 5).in_words("shot"),
            "not measured for scheme NSNI of weight 0.3 with rotational symmetry");
  Numerics heavy = light;
  heavy.weight = 1;
  EXPECT_TRUE(error_of_resistance(heavy, 5).known());
  // Sub-points have no weight.
  EXPECT_EQ(
      error_of_resistance({.scheme = Scheme::subpoint, .weight = 0.3, .axis = true, .across = 3}, 5).spacing,
      subpoints(3).spacing);
}

/// Tunnels need more points over the radius than slabs do.
TEST(NumericalError, OfThickTargetsIsThatOfTunnels) {
  const auto error = [](Scheme scheme, bool axis, double thickness) {
    return error_of_resistance({.scheme = scheme, .weight = 1, .axis = axis, .across = 2.8}, 9, thickness);
  };
  EXPECT_GT(error(Scheme::subpoint, false, 37).spacing, error(Scheme::subpoint, false, 10).spacing);
  EXPECT_GT(error(Scheme::subpoint, true, 37).spacing, error(Scheme::subpoint, true, 10).spacing);
  EXPECT_LT(error(Scheme::nsni, false, 37).spacing, error(Scheme::subpoint, false, 37).spacing);
  EXPECT_FALSE(error(Scheme::m_snni, false, 37).known());
  // A sphere that is not deep has no tunnel behind it.
  const Numerics axis = {.scheme = Scheme::subpoint, .axis = true, .across = 2.8};
  EXPECT_LT(error_of_resistance(axis, 5, 37).spacing, error_of_resistance(axis, 9, 37).spacing);
}

/// The solid part of cells is better in tunnels, whole cells are in slabs. Not measured in three dimensions.
TEST(NumericalError, DependsOnWhatTouchesTheProjectile) {
  const auto error = [](TouchingPart touching, bool axis, double thickness) {
    return error_of_resistance(
        {.scheme = Scheme::subpoint, .axis = axis, .across = 2.8, .touching = touching}, 9, thickness);
  };
  EXPECT_LT(error(TouchingPart::solid, true, 37).spacing, error(TouchingPart::cell, true, 37).spacing);
  EXPECT_NE(error(TouchingPart::cell, true, 37).remark.find("Touching part = solid"), std::string::npos);
  EXPECT_GT(error(TouchingPart::solid, true, 10).spacing, error(TouchingPart::cell, true, 10).spacing);
  EXPECT_FALSE(error(TouchingPart::solid, false, 10).known());
}

TEST(ErrorOfResistance, WhatIsNotMeasuredIsNullWithTheReason) {
  Summary summary;
  not_measured("resistance", "a wish").add_to(summary, "a_");
  exit_band(300, 200, unknown).add_to(summary, "a_exit_velocity");
  const std::string json = summary.json();
  for (const char* text :
       {"\"a_numerical_error_percent\": null", "\"a_numerical_error_spacing_percent\": null",
        "\"a_numerical_error_layout_percent\": null", "\"a_exit_velocity_low\": null",
        "\"a_numerical_error_remark\": \"not measured for a wish\""})
    EXPECT_NE(json.find(text), std::string::npos) << text << " in " << json;
}

TEST(ErrorOfShortening, FallsWithTheSpacingAndIsThatOfTheStudiedWeight) {
  const auto error = [](double across, double weight = 0.05) {
    return error_of_shortening({.scheme = Scheme::nsni, .weight = weight, .across = across});
  };
  EXPECT_GT(error(5).relative(), error(10).relative());
  EXPECT_GT(error(10).relative(), error(20).relative());
  EXPECT_FALSE(error(10, 0.5).known());
}

TEST(Bands, HoldTheAnswerHaveNoWidthWithoutErrorAndGrowWithIt) {
  const auto all = [](double error) {
    return std::array{exit_band(300, 200, error), depth_band(0.1, 0.5, error), length_band(0.7, error)};
  };
  const std::array answers = {200.0, 0.1, 0.7};
  for (std::size_t i = 0; i < answers.size(); ++i) {
    EXPECT_NEAR(all(0)[i].low, answers[i], 1e-12 * answers[i]);
    EXPECT_NEAR(all(0)[i].high, answers[i], 1e-12 * answers[i]);
    Band before = all(0)[i];
    for (const double error : {0.01, 0.1, 0.3, 0.5}) {
      const Band band = all(error)[i];
      EXPECT_LT(band.low, before.low);
      EXPECT_GT(band.high, before.high);
      before = band;
    }
    EXPECT_FALSE(all(unknown)[i].known());
    EXPECT_EQ(all(unknown)[i].in_words(1), "");
  }
}

TEST(Bands, OfExitVelocitiesHaveTheAbsorbedEnergyPlusAndMinusTheError) {
  const double in = 313, out = 220, error = 0.08, lost = in * in - out * out;
  const Band band = exit_band(in, out, error);
  EXPECT_NEAR(in * in - band.low * band.low, (1 + error) * lost, 1e-8);
  EXPECT_NEAR(in * in - band.high * band.high, (1 - error) * lost, 1e-8);
}

TEST(Bands, AnExitThatLosesNearlyAllEnergyMayBeAStopAndNoneIsFasterThanTheImpact) {
  EXPECT_EQ(exit_band(300, 30, 0.1).low, 0);
  EXPECT_GT(exit_band(300, 30, 0.1).high, 30);
  EXPECT_EQ(exit_band(300, 200, 5).high, 300);
}

TEST(Bands, AStoppedBodyMayPerforateIfItsDepthMayReachTheBack) {
  for (const double depth : {0.1, 0.2, 0.23, 0.25, 0.254, 0.26}) {
    const Band depths = depth_band(depth, 0.254, 0.1), exits = exit_band_of_stopped(300, depth, 0.254, 0.1);
    EXPECT_EQ(exits.low, 0);
    EXPECT_EQ(exits.high > 0, depths.high >= 0.254) << depth;
    EXPECT_LE(depths.high, std::max(depth, 0.254));
    EXPECT_GE(depths.high, depth);
  }
  // One that has just reached the back keeps the part of its energy by which the resistance may be less.
  EXPECT_NEAR(exit_band_of_stopped(300, 0.254, 0.254, 0.1).high, 300 * std::sqrt(0.1), 1e-9);
  EXPECT_EQ(exit_band_of_stopped(300, 0, 0.254, 0.1).high, 0);
  EXPECT_FALSE(exit_band_of_stopped(300, 0.2, 0.254, unknown).known());
}

TEST(Bands, OfDepthsAreInverseToTheResistance) {
  const Band band = depth_band(0.1, 1, 0.25);
  EXPECT_NEAR(band.low, 0.08, 1e-15);
  EXPECT_NEAR(band.high, 0.1 / 0.75, 1e-15);
  EXPECT_EQ(depth_band(0.1, 0.5, 1).high, 0.5);
}

TEST(Bands, AreSaidInTheUnitsOfTheAnswer) {
  EXPECT_EQ((Band{0.1, 0.25}).in_words(0, 1e3), " (numerically 100 to 250)");
}

} // namespace
} // namespace spall::test
