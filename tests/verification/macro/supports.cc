// Tests of the supports of deformable bodies: plates vibrate according to plate theory, and the reaction of a
// support balances the momentum of the body.

#include "shared/error.h"
#include "tests/support/scenes.h"
#include "tests/verification/macro/bodies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace spall::test {
namespace {

constexpr double radius = 0.1, thickness = 0.01; // m

/// Lowest frequency parameter lambda^2 = omega a^2 sqrt(rho h / D) of a round plate that is held at its rim,
/// from half a period of its centre after a push.
double frequency_parameter(BodySupportKind kind) {
  const J2 material = elastic(200e9, 0.3);
  const SymmetryPlanes planes = {.axis = true};
  Points points = fill_cylinder({.radius = radius, .height = thickness}, {51, 6, Boundary::on_surface},
                                planes, material.density);
  HeldPoints support({.kind = kind}, {}, points, {}, "plate");
  set_velocity(points, [&](const Vec3& x) {
    const double bowl = 1 - (x[0] * x[0] + x[1] * x[1]) / (radius * radius);
    return Vec3{0, 0, kind == BodySupportKind::clamped ? bowl * bowl : bowl};
  });
  const SolidInputs inputs = Numerics{}.solid();
  Bodies bodies = bodies_of(make_solid(material, points, planes, inputs));
  bodies.supports.push_back(support);
  Simulation run(std::move(bodies), ContactInputs{}, TimeInputs{.end_time = 1}, inputs.integration);
  const auto height = [&run] {
    const Points& p = run.bodies.solids[0]->points;
    return p.position.component[2][0] - p.initial_position.component[2][0]; // next to the axis
  };
  double before = 0, now = 0;
  do {
    before = now;
    run.advance();
    now = height();
  } while (now > 0 && run.time < 2e-3);
  const double half_period = run.time - run.step * now / (now - before);
  const double plate_speed =
      std::sqrt(200e9 / (material.density * (1 - 0.3 * 0.3))); // speed of membrane waves
  EXPECT_LT(run.momentum_error().linear, 1e-12);
  EXPECT_LT(std::abs(run.energies.error()), 1e-3);
  return std::numbers::pi / half_period * radius * radius * std::sqrt(12.0) / (thickness * plate_speed);
}

// Mindlin's plates, nu = 0.3, thickness a tenth of the radius: Irie, Yamada & Takagi (1982), J. Sound
// Vib. 80. Thin plates have 10.216 and 4.935.
TEST(Supports, AClampedPlateVibratesAsTheTheoryOfThickPlatesSays) {
  const double parameter = frequency_parameter(BodySupportKind::clamped);
  std::printf("lambda^2 = %.3f for 9.941\n", parameter);
  EXPECT_NEAR(parameter, 9.941, 0.02 * 9.941);
}

TEST(Supports, ASimplySupportedPlateVibratesAsTheTheoryOfThickPlatesSays) {
  const double parameter = frequency_parameter(BodySupportKind::simple);
  std::printf("lambda^2 = %.3f for 4.894\n", parameter);
  EXPECT_NEAR(parameter, 4.894, 0.02 * 4.894);
}

/// A few layers of concrete struck by the shipped projectile.
Simulation struck(const std::vector<std::string>& more) {
  std::vector<std::string> overrides = {"AFC/Damage table=", "slab/Diameter=0.3 m", "slab/Rings=8",
                                        "slab/Layers=4", "Approximation/Double precision=yes"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return start(*shipped("slab_127.prm", overrides));
}

class Struck : public ::testing::TestWithParam<std::vector<std::string>> {};
INSTANTIATE_TEST_SUITE_P(
    Supports, Struck,
    ::testing::Values(std::vector<std::string>{"slab/Supports=clamped"},
                      std::vector<std::string>{"slab/Supports=simple", "slab/Support diameter=0.2 m"},
                      std::vector<std::string>{"slab/Supports=clamped", "Scene/Symmetry planes=none"}),
    [](const auto& instance) { return std::string("case_") + std::to_string(instance.index); });

TEST_P(Struck, MomentumIsThatOfTheStartAndTheReactions) {
  Simulation run = struck(GetParam());
  while (run.time < 0.3e-3) run.advance();
  const double start = run.energies.initial_momentum, reaction = run.exchange.reaction_of_run.impulse[2];
  EXPECT_LT(reaction, -1e-3 * start); // it holds the slab back
  EXPECT_NEAR(run.energies.momentum, start + reaction, 1e-10 * start);
  EXPECT_LT(run.momentum_error().linear, 1e-10);
  // Between refreshes the angular momentum of a whole slab is kept to 2e-5 to 4e-5 with supports that follow
  // cells to a fifth of their width (5e-6 with a half), whatever the steps.
  EXPECT_LT(run.momentum_error().angular, 5e-5);
  EXPECT_LT(std::abs(run.energies.error()), 2e-3);
}

TEST_P(Struck, HeldPointsStayInTheirPlaces) {
  Simulation run = struck(GetParam());
  while (run.time < 0.1e-3) run.advance();
  const Points& points = run.bodies.solids[0]->points;
  const bool clamped = GetParam().front() == "slab/Supports=clamped";
  std::size_t still = 0, moving = 0;
  for (std::size_t i = 0; i < points.owned; ++i) {
    const bool rim = (points.faces[i] & rim_face) != 0;
    if (points.velocity.component[2][i] != 0) moving += !clamped || !rim;
    if (clamped && rim) {
      EXPECT_EQ(points.position[i], points.initial_position[i]);
    }
    still += points.position.component[2][i] == points.initial_position.component[2][i];
  }
  EXPECT_EQ(still, run.bodies.supports[0].count());
  EXPECT_EQ(moving, points.owned - still);
}

TEST(Supports, ARingBesideTheSlabIsRefused) {
  try {
    struck({"slab/Supports=simple", "slab/Support diameter=0.4 m"});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("slab/Support diameter"), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace spall::test
