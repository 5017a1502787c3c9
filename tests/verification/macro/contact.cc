// Tests of contact between deformable bodies: impact of bars compared with one-dimensional theory, gap,
// friction, and a Taylor bar on a modelled anvil compared with the rigid wall.

#include "macro/output/length_answer.h"
#include "tests/support/scenes.h"
#include "tests/verification/macro/bodies.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

/// Two equal elastic bars along z; the upper one moves down at `velocity`. With Poisson's ratio 0
/// one-dimensional theory is exact.
struct TwoBars {
  J2 material = elastic(78.6e9, 0);
  double length = 0.05, c = std::sqrt(material.youngs_modulus / material.density);
  int layers = 40;
  double h, mass = 0;
  Simulation run;

  explicit TwoBars(const ContactInputs& contact = {}, Boundary boundary = Boundary::on_surface,
                   const Vec3& velocity = {0, 0, -1})
      : h(length / (boundary == Boundary::on_surface ? layers - 1 : layers)),
        run({.solids = solids(boundary, velocity)}, contact, {.end_time = 1},
            Numerics{}.solid().integration) {
    for (const double m : run.bodies.solids[0]->points.mass) mass += m;
  }
  std::vector<std::unique_ptr<Solid>> solids(Boundary boundary, const Vec3& velocity) const {
    std::vector<std::unique_ptr<Solid>> list;
    for (const double bottom : {0.0, -length}) {
      Points points = fill_cylinder({.radius = 2 * length / layers, .height = length, .bottom = bottom},
                                    {2, layers, boundary}, SymmetryPlanes{}, material.density);
      if (bottom == 0) set_velocity(points, [&](const Vec3&) { return velocity; });
      list.push_back(make_solid(material, std::move(points), SymmetryPlanes{}, Numerics{}.solid()));
      list.back()->label = bottom == 0 ? "upper" : "lower";
    }
    return list;
  }
  /// Returns the mean height of the points of a bar's lowest (side -1) or highest layer.
  double face(std::size_t bar, int side) const {
    const Points& points = run.bodies.solids[bar]->points;
    double extreme = -1e9, sum = 0;
    int count = 0;
    for (const double z : points.initial_position.component[2]) extreme = std::max(extreme, side * z);
    for (std::size_t i = 0; i < points.owned; ++i)
      if (side * points.initial_position[i][2] > extreme - 0.5 * h) sum += points.position[i][2], ++count;
    return sum / count;
  }
};

class Bars : public ::testing::TestWithParam<Boundary> {};
INSTANTIATE_TEST_SUITE_P(Boundaries, Bars, ::testing::Values(Boundary::on_surface, Boundary::centred),
                         [](const auto& instance) {
                           return instance.param == Boundary::centred ? "centred" : "on_surface";
                         });

TEST_P(Bars, InImpactExchangeTheirVelocities) {
  TwoBars bars({}, GetParam());
  Simulation& run = bars.run;
  const double p = bars.mass, whole = run.energies.initial_momentum; // 1 m/s
  double last_touch = 0, gap = 0;
  while (run.time < 2.6 * bars.length / bars.c) {
    run.advance();
    if (run.exchange.of_step.received(0)[2] != 0) last_touch = run.time;
    if (run.time < bars.length / bars.c) // the full stress is rho c v / 2, the strain v / (2 c)
      gap = bars.face(0, -1) - bars.face(1, 1) - (GetParam() == Boundary::centred ? bars.h : 0);
    EXPECT_NEAR(run.energies.points_momentum, whole, 1e-12 * p);
  }
  const double restitution = (run.energies.solid_momentum[0] - run.energies.solid_momentum[1]) / p;
  std::printf(
      "contact time %.3f of 2 L / c, restitution %.4f, upper bar keeps %.4f of its velocity, gap %.1e "
      "spacings, lost in the contact %.4f of the energy\n",
      last_touch / (2 * bars.length / bars.c), restitution, -run.energies.solid_momentum[0] / p, gap / bars.h,
      run.energies.contact / run.energies.initial);
  EXPECT_NEAR(last_touch, 2 * bars.length / bars.c, 0.1 * 2 * bars.length / bars.c);
  EXPECT_NEAR(restitution, 1,
              0.06); // the rest is in vibrations that remain, of the order h / L
  EXPECT_LT(std::abs(gap), 0.01 * bars.h);
  EXPECT_LT(std::abs(run.energies.error()), 1e-3);
  // The bars separate, and there is no further contact force.
  for (int n = 0; n < 50; ++n) {
    run.advance();
    EXPECT_EQ(run.exchange.of_step.received(0), Vec3{});
  }
}

TEST(KnownSurface, OfTheLowerBarMakesTheSameImpact) {
  TwoBars fitted, known;
  const Cylinder bar{.radius = 1, .height = known.length}; // a radius so large that no point lies on the rim
  known.run.bodies.solids[1]->surface =
      known_surface(bar, identity3, {0, 0, -known.length}, known.run.bodies.solids[1]->points);
  for (Simulation* run : {&fitted.run, &known.run})
    while (run->time < 2.6 * fitted.length / fitted.c) run->advance();
  const auto restitution = [](const TwoBars& bars) {
    return (bars.run.energies.solid_momentum[0] - bars.run.energies.solid_momentum[1]) / bars.mass;
  };
  std::printf("restitution %.4f with the known surface, %.4f with the fitted one; gap %.1e, %.1e spacings\n",
              restitution(known), restitution(fitted), known.run.exchange.mean_gap() / known.h,
              fitted.run.exchange.mean_gap() / known.h);
  EXPECT_NEAR(restitution(known), restitution(fitted), 0.01);
  EXPECT_NEAR(known.run.energies.points_momentum, known.run.energies.initial_momentum, 1e-12 * known.mass);
  EXPECT_LT(std::abs(known.run.energies.error()), 1e-3);
  EXPECT_LT(known.run.exchange.mean_gap(), 0.01 * known.h);
}

/// Makes an elastic block at rest and one point of another body above it, which touches the block's known or
/// fitted face z = 0.
Simulation block_and_point(bool known, double height, double speed) {
  const J2 material = elastic();
  const double h = 1e-3;
  Points target = block(material, 6, h, 0), lone = points_at({{3.2e-3, 2.9e-3, height}}, h);
  for (std::size_t i = 0; i < target.owned; ++i) {
    Vec3 x = target.position[i];
    target.position.set(i, {x[0], x[1], x[2] - 6 * h});
  }
  target.initial_position = target.position;
  lone.mass[0] *= material.density;
  lone.velocity.set(0, {0, 0, -speed});
  const SolidInputs inputs = Numerics{}.solid();
  std::vector<std::unique_ptr<Solid>> list;
  list.push_back(make_solid(material, std::move(lone), SymmetryPlanes{}, inputs));
  list.push_back(make_solid(material, std::move(target), SymmetryPlanes{}, inputs));
  list[0]->label = "point", list[1]->label = "block";
  if (known)
    list[1]->surface =
        known_surface(Cylinder{.radius = 1, .height = 6 * h}, identity3, {0, 0, -6 * h}, list[1]->points);
  return {{.solids = std::move(list)}, {}, {.end_time = 1}, inputs.integration};
}

class LonePoint : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Surfaces, LonePoint, ::testing::Bool(),
                         [](const auto& instance) { return instance.param ? "known" : "fitted"; });

TEST_P(LonePoint, HittingABodyStaysOutOfItAndKeepsMomentumAndEnergy) {
  Simulation run = block_and_point(GetParam(), 1e-3, 20);
  const double mass = run.bodies.solids[0]->points.mass[0], offset = GetParam() ? 0 : 0.5e-3;
  double lowest = 1;
  for (int n = 0; n < 1500; ++n) {
    run.advance();
    lowest = std::min(lowest, run.bodies.solids[0]->points.position[0][2] - offset);
  }
  const double rebound = run.bodies.solids[0]->points.velocity[0][2];
  std::printf(
      "a lone point at 20 m/s leaves with %.2f m/s, lowest %.4f mm, %.3f of the energy lost in the contact\n",
      rebound, lowest * 1e3, run.energies.contact / run.energies.initial);
  EXPECT_LT(run.bodies.solids[0]->points.velocity[0][2], 20);
  EXPECT_GT(rebound, -20);
  EXPECT_GT(lowest, -0.1e-3); // the block is dented by this depth
  EXPECT_NEAR(run.energies.points_momentum, -20 * mass, 1e-9 * 20 * mass);
  EXPECT_LT(run.momentum_error().angular,
            1e-5); // contact conserves it exactly, the solid up to the order of its dent
  EXPECT_GT(run.energies.contact, 0);
  EXPECT_LT(std::abs(run.energies.error()), 1e-2);
}

TEST_P(LonePoint, DeepInsideAtTheStartIsPushedOutSlowly) {
  const double offset = GetParam() ? 0 : 0.5e-3;
  Simulation run = block_and_point(GetParam(), offset - 0.5e-3, 0);
  const double allowed = ContactInputs{}.release_speed, mass = run.bodies.solids[0]->points.mass[0];
  double fastest = 0;
  while (run.time < 0.3e-3) {
    run.advance();
    fastest = std::max(fastest, std::abs(run.bodies.solids[0]->points.velocity[0][2]));
  }
  EXPECT_GT(run.bodies.solids[0]->points.position[0][2], offset - 0.05e-3);
  EXPECT_LT(fastest, 1.5 * allowed);
  EXPECT_LT(run.energies.kinetic, 1.5 * mass * allowed * allowed);
  EXPECT_NEAR(run.energies.points_momentum, 0, 1e-9 * mass * allowed);
}

TEST(KernelContact, LeavesAGapThatTheSurfaceSchemeDoesNot) {
  const auto gap = [](const char* law) {
    TwoBars bars({.law = law}, Boundary::on_surface, {0, 0, -50});
    // The start is beyond the reach of both schemes.
    for (double& z : bars.run.bodies.solids[0]->points.position.component[2]) z += 2.2 * bars.h;
    double least = 1;
    while (bars.run.time < 2.5 * bars.h / 50 + 1.5 * bars.length / bars.c) {
      bars.run.advance();
      least = std::min(least, bars.face(0, -1) - bars.face(1, 1));
      EXPECT_NEAR(bars.run.energies.points_momentum, bars.run.energies.initial_momentum,
                  1e-10 * 50 * bars.mass);
      if (bars.run.energies.solid_momentum[0] > -0.05 * 50 * bars.mass)
        break; // the upper bar has transferred its momentum
    }
    EXPECT_LT(std::abs(bars.run.energies.error()), 2e-2);
    return least / bars.h;
  };
  const double kernel = gap("kernel"), surface = gap("surface");
  std::printf("bars in impact stop %.2f spacings apart where kernels overlap, %.1e where surfaces touch\n",
              kernel, surface);
  EXPECT_GT(kernel, 0.5);
  EXPECT_LT(std::abs(surface), 0.01);
}

TEST(Sliding, LosesTangentialMomentumInTheRatioOfFrictionAndSticksBelowIt) {
  for (const auto& [friction, along] : {std::pair(0.1, 5.0), {0.3, 5.0}, {0.5, 0.02}}) {
    TwoBars bars({.friction = friction}, Boundary::on_surface, {along, 0, -1});
    Simulation& run = bars.run;
    Vec3 impulse{};
    while (run.time < 0.5 * bars.length / bars.c) {
      run.advance();
      impulse -= run.exchange.of_step.received(0);
    }
    const double ratio = impulse[0] / -impulse[2];
    std::printf("friction %.1f, sliding at %.2f of the normal velocity: tangential / normal impulse %.4f\n",
                friction, along, ratio);
    if (along > 1)
      EXPECT_NEAR(ratio, friction, 1e-3 * friction);
    else
      EXPECT_LT(ratio, 0.1 * friction);
    EXPECT_NEAR(impulse[1], 0, 1e-2 * std::abs(impulse[0]));
    EXPECT_LT(std::abs(run.energies.error()), 1e-3);
  }
}

/// Runs the paper's aluminium bar at a coarse resolution until it rebounds.
Simulation rebounding(const std::string& scene, std::vector<std::string> coarse) {
  coarse.insert(coarse.end(), {"bar/Rings=5", "bar/Layers=31"});
  Simulation run = start(*shipped(scene, coarse));
  while (run.energies.solid_momentum[0] < 0 && run.time < 100e-6) run.advance();
  return run;
}

TEST(TaylorBar, OnAModelledAnvilIsThatOnARigidWall) {
  const Simulation a = rebounding("taylor_aluminium_anvil.prm", {"anvil/Rings=10", "anvil/Layers=9"}),
                   b = rebounding("taylor_aluminium.prm", {});
  const BarShape p = measure_bar(*a.bodies.solids[0], Boundary::on_surface),
                 q = measure_bar(*b.bodies.solids[0], Boundary::on_surface);
  const double spacing = a.bodies.solids[0]->points.spacing.front(), height = 23.47e-3;
  std::printf(
      "L/L0 %.4f on the anvil, %.4f on the wall; foot %.2f, %.2f mm; gap mean %.1e, most %.3f spacings; "
      "energy error %.1e\n",
      p.length / height, q.length / height, p.foot_diameter * 1e3, q.foot_diameter * 1e3,
      a.exchange.mean_gap() / spacing, a.exchange.gap_max / spacing, a.energies.error());
  EXPECT_NEAR(p.length / height, q.length / height, 0.01);
  EXPECT_NEAR(p.foot_diameter, q.foot_diameter, 0.5e-3);
  EXPECT_LT(std::abs(a.energies.error()), 1e-3);
  EXPECT_LT(a.exchange.gap_max, 0.1 * spacing);
  EXPECT_NEAR(p.max_plastic_strain, q.max_plastic_strain, 0.5); // no single point is ejected or squeezed out
  EXPECT_EQ(a.health.most_isolated, 0u);
}

} // namespace
} // namespace spall::test
