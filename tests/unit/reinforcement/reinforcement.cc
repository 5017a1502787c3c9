// Tests of bars in concrete against closed forms and conservation laws.

#include "macro/reinforcement/reinforcement.h"
#include "tests/unit/points/clouds.h"
#include "tests/unit/reinforcement/bars.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace spall::test {
namespace {

/// Points of a block around the x axis that do not move: 4 x 4 points across.
Points still_block(double from, double to, double spacing) {
  std::vector<Vec3> places;
  for (double x = from + 0.5 * spacing; x < to; x += spacing)
    for (int j = -2; j < 2; ++j)
      for (int k = -2; k < 2; ++k) places.push_back({x, (j + 0.5) * spacing, (k + 0.5) * spacing});
  return points_at(places, spacing);
}

/// A bar in concrete that does not move, with a force on its end at x = 0, at rest.
Reinforcement loaded_bar(double length, double node_spacing, double stiffness, const Vec3& load) {
  constexpr double spacing = 20e-3;
  Points concrete = still_block(-2 * spacing, length + 2 * spacing, spacing);
  const ReinforcementDesign design{.lines = {{.from = {0, 0, 0}, .to = {length, 0, 0}}},
                                   .diameter = diameter,
                                   .node_spacing = node_spacing,
                                   .steel = elastic_steel(),
                                   .bond = {.stiffness = stiffness}};
  const std::size_t nodes = Reinforcement::places(design, {}).component[0].size();
  Reinforcement bars(design, std::vector<double>(nodes, 1.9 * spacing), Profile::cubic_spline, {}, {});
  bars.connect(concrete);
  concrete.mass.assign(concrete.owned, 1e9);
  const double dt = bars.stable_step(1);
  double last = 1;
  for (int n = 0; n < 20000 && last > 1e-7; ++n) {
    bars.nodes().force.add(0, load);
    bars.kick(dt);
    for (auto& component : bars.nodes().velocity.component)
      for (double& v : component) v *= 0.99; // comes to rest
    bars.drift(dt);
    bars.update(concrete, dt);
    last = norm(bars.nodes().force[0] + load) / norm(load);
    if (n < 100) last = 1;
  }
  EXPECT_LT(last, 1e-6);
  return bars;
}

TEST(Reinforcement, PullOutFollowsTheShearLag) {
  // u(0) = P / (sqrt(k E A) tanh(b L)), s(x) = u(0) cosh(b (L - x)) / cosh(b L), b = sqrt(k / E A)
  constexpr double length = 0.2, stiffness = 1e9, load = 10e3;
  const Reinforcement bars = loaded_bar(length, 5e-3, stiffness, {-load, 0, 0});
  const double b = std::sqrt(stiffness / (200e9 * area));
  const double expected = load / (std::sqrt(stiffness * 200e9 * area) * std::tanh(b * length));
  EXPECT_NEAR(-bars.bonds()[0].slip, expected, 1e-3 * expected);
  for (std::size_t i = 0; i < bars.nodes().owned; ++i) {
    const double x = bars.nodes().initial_position[i][0];
    EXPECT_NEAR(-bars.bonds()[i].slip, expected * std::cosh(b * (length - x)) / std::cosh(b * length),
                2e-3 * expected);
  }
  RecordProperty("slip over closed form", std::to_string(-bars.bonds()[0].slip / expected));
}

TEST(Reinforcement, ADowelIsABeamOnAnElasticFoundation) {
  // A long beam with a load P at its end: y(0) = 2 P b / k, b = (k / 4 E I)^(1/4)
  constexpr double stiffness = 1e9, load = 100;
  const double b = std::pow(stiffness / (4 * 200e9 * inertia), 0.25);
  const auto deflection = [&](double node_spacing) {
    return loaded_bar(6 / b, node_spacing, stiffness, {0, 0, load}).nodes().position[0][2];
  };
  const double expected = 2 * load * b / stiffness;
  EXPECT_NEAR(deflection(0.1 / b), expected, 0.01 * expected);
  EXPECT_NEAR(deflection(0.4 / b), expected, 0.15 * expected);
  RecordProperty("deflection over closed form", std::to_string(deflection(0.1 / b) / expected));
}

/// Energy and momenta of bars and points that act on each other and on nothing else.
struct Cloud {
  Points points;
  Reinforcement bars;
  double work = 0;

  void advance(double dt) {
    for (std::size_t i = 0; i < points.owned; ++i)
      points.velocity.add(i, dt / points.mass[i] * points.force[i]);
    bars.kick(dt);
    for (std::size_t i = 0; i < points.owned; ++i) points.position.add(i, dt * points.velocity[i]);
    bars.drift(dt);
    for (auto& component : points.force.component) std::fill(component.begin(), component.end(), 0.0);
    bars.update(points, dt);
  }
  MomentumSums momenta() const {
    MomentumSums sum;
    sum.add(points, points.velocity, true);
    sum.add(bars.nodes(), bars.nodes().velocity, true);
    return sum;
  }
  double energy() const {
    double sum = bars.kinetic_energy() + bars.steel_work() + bars.bond_work();
    for (std::size_t i = 0; i < points.owned; ++i)
      sum += 0.5 * points.mass[i] * dot(points.velocity[i], points.velocity[i]);
    return sum;
  }
};

/// A block of loose points with bars in it, whose points fly apart: by much and with other velocities.
Cloud flying_cloud(BondKind kind, double speed) {
  constexpr double spacing = 20e-3;
  Points points = points_at(jittered_lattice(6, spacing, 0.3), spacing);
  for (double& m : points.mass) m *= 2400;
  const std::vector<Vec3> parts = random_cloud(points.owned, {-1, -1, -1}, {1, 1, 1}, 4);
  for (std::size_t i = 0; i < points.owned; ++i)
    points.velocity.set(i, speed * (parts[i] + 20 * (points.position[i] - Vec3{0.05, 0.06, 0.07})));
  const ReinforcementDesign design{
      .lines = {{{20e-3, 30e-3, 40e-3}, {100e-3, 30e-3, 40e-3}},
                {{40e-3, 20e-3, 50e-3}, {40e-3, 100e-3, 50e-3}}},
      .diameter = diameter,
      .node_spacing = spacing,
      .steel = steel(0.05),
      .bond = {.kind = kind, .stiffness = 60e9, .concrete_strength = 30e6, .rib_spacing = 5e-3}};
  const std::size_t nodes = Reinforcement::places(design, {}).component[0].size();
  Cloud cloud{std::move(points), Reinforcement(design, std::vector<double>(nodes, 1.9 * spacing),
                                               Profile::cubic_spline, {}, {}, {3, -2, 1})};
  cloud.bars.connect(cloud.points);
  return cloud;
}

class BothBonds : public ::testing::TestWithParam<BondKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, BothBonds, ::testing::Values(BondKind::rigid, BondKind::slip));

TEST_P(BothBonds, MomentumIsKeptExactlyAlsoWhenThePiecesFlyApart) {
  Cloud cloud = flying_cloud(GetParam(), 300);
  const MomentumSums before = cloud.momenta();
  const double dt = cloud.bars.stable_step(1e-6);
  for (int n = 0; n < 400; ++n) cloud.advance(dt);
  const MomentumSums after = cloud.momenta();
  EXPECT_LT(norm(after.linear - before.linear), 1e-12 * before.size);
  EXPECT_LT(norm(after.angular - before.angular), 1e-12 * before.angular_size);
  EXPECT_GT(cloud.bars.unbonded(), 0u); // the points have gone
  if (GetParam() == BondKind::rigid) {
    EXPECT_GT(cloud.bars.bars().ruptured(), 0u);
  }
}

TEST_P(BothBonds, EnergyIsKeptTheBetterTheShorterTheStep) {
  const auto error = [](double part) {
    Cloud cloud = flying_cloud(GetParam(), 30);
    const double dt = part * cloud.bars.stable_step(1e-6), initial = cloud.energy();
    double largest = 0;
    for (int n = 0; n < 200 / part; ++n) {
      cloud.advance(dt);
      largest = std::max(largest, std::abs(cloud.energy() - initial) / initial);
    }
    return largest;
  };
  const double coarse = error(1), fine = error(0.25);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_LT(fine, 0.35 * coarse);
  RecordProperty("energy error", std::to_string(coarse));
}

TEST(Reinforcement, TheWorkOfAnElasticBondIsItsStoredEnergy) {
  Cloud cloud = flying_cloud(BondKind::rigid, 10);
  const double dt = 0.1 * cloud.bars.stable_step(1e-6);
  for (int n = 0; n < 300; ++n) cloud.advance(dt);
  double stored = 0;
  for (std::size_t i = 0; i < cloud.bars.bonds().size(); ++i) {
    const BondState& bond = cloud.bars.bonds()[i];
    stored += 0.5 * cloud.bars.bars().lengths()[i] *
              (bond.along * bond.along + dot(bond.across, bond.across)) / 60e9;
  }
  EXPECT_GT(stored, 1e-3);
  EXPECT_NEAR(cloud.bars.bond_work(), stored, 0.02 * stored);
}

TEST(Reinforcement, TheStepIsStableAndNotMuchSmallerThanItMustBe) {
  const auto grows = [](double part) {
    Cloud cloud = flying_cloud(BondKind::rigid, 1e-3);
    const double dt = part * cloud.bars.stable_step(1), initial = cloud.energy();
    double largest = 0;
    for (int n = 0; n < 500; ++n) {
      cloud.advance(dt);
      double kinetic = cloud.bars.kinetic_energy();
      largest = std::max(largest, std::isfinite(kinetic) ? kinetic : 1e300);
      if (largest > 1e3 * initial) break;
    }
    return largest / initial;
  };
  EXPECT_LT(grows(1), 1.5);
  EXPECT_GT(grows(2), 1e3);
}

} // namespace
} // namespace spall::test
