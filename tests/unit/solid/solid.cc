// Tests of the inputs that a solid refuses, and of its messages when it cannot continue.

#include "macro/solid/solid.h"

#include "macro/material/j2.h"
#include "shared/error.h"
#include "tests/unit/solid/crowded_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace spall::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const J2 metal{.youngs_modulus = 80e9,
               .poisson_ratio = 0.3,
               .initial_yield = 1e12,
               .hardening_modulus = 0,
               .density = 2700};

/// Returns the message of the exception of type E that an action throws; empty if there is none.
template<class E, class Action> std::string message_of(const Action& action) {
  try {
    action();
  } catch (const E& error) {
    return error.what();
  }
  return {};
}

TEST(Solid, RefusesFieldsThatTheMaterialDoesNotHaveAndNamesThoseItHas) {
  const auto solid = make_solid(metal, points_at(jittered_lattice(4, 1, 0)), {}, {});
  solid->label = "bar";
  for (const std::string& name : solid->field_names())
    EXPECT_EQ(solid->field(name).size(), solid->points.owned) << name;
  EXPECT_THAT(message_of<std::invalid_argument>([&] { solid->field("plastic_stain"); }),
              AllOf(HasSubstr("bar"), HasSubstr("plastic_stain"), HasSubstr("plastic_strain")));
}

TEST(Solid, NamesTheBlockThatHasTooManyNeighbours) {
  const auto solid = make_solid(metal, crowded_points(), {}, {});
  solid->label = "bar";
  EXPECT_THAT(message_of<ComputationError>([&] { solid->refresh(); }),
              AllOf(HasSubstr("bar: the block of point 0 has 66688 neighbours"), HasSubstr("collapsed")));
}

TEST(Solid, ReportsHowTheLinearCorrectionHasConverged) {
  SolidInputs inputs;
  inputs.integration.correction = Correction::linear;
  const auto regular = make_solid(metal, points_at(jittered_lattice(8, 1, 0)), {}, inputs),
             jittered = make_solid(metal, points_at(jittered_lattice(8, 1, 0.1)), {}, inputs);
  const RefreshReport report = jittered->refresh();
  EXPECT_GT(report.correction_iterations, 0);
  EXPECT_GT(report.correction_residual, 0);
  EXPECT_LE(report.correction_residual, 1e-8);
  EXPECT_LE(regular->refresh().correction_iterations, report.correction_iterations);
  inputs.integration.correction = Correction::none;
  const auto none = make_solid(metal, points_at(jittered_lattice(8, 1, 0.1)), {}, inputs);
  EXPECT_EQ(none->refresh().correction_iterations, 0);
}

} // namespace
} // namespace spall::test
