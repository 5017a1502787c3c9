// Tests that chains of nodes resist extension and bending, and nothing else.

#include "tests/unit/reinforcement/bars.h"

#include <gtest/gtest.h>

#include <random>

namespace spall::test {
namespace {

BarChain straight_bar(double spacing, const BarSteel& steel, double length = 0.2) {
  return {{{.from = {0, 0, 0}, .to = {length, 0, 0}}}, diameter, spacing, steel, {}};
}

void move_randomly(Points& nodes, double most) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> part(-most, most);
  for (std::size_t i = 0; i < nodes.owned; ++i)
    nodes.position.add(i, {part(engine), part(engine), part(engine)});
}

TEST(BarChain, HasTheMassOfTheBar) {
  const BarChain bar = straight_bar(12e-3, steel());
  EXPECT_EQ(bar.nodes.owned, 19u); // 18 equal segments of at most 12 mm
  double mass = 0;
  for (const double m : bar.nodes.mass) mass += m;
  EXPECT_NEAR(mass, 7850 * area * 0.2, 1e-12);
  EXPECT_NEAR(bar.nodes.mass[0], 0.5 * bar.nodes.mass[1], 1e-15);
}

TEST(BarChain, KeepsLinearAndAngularMomentumHoweverItIsBent) {
  BarChain bar = straight_bar(20e-3, steel());
  move_randomly(bar.nodes, 15e-3);
  bar.update();
  MomentumSums sum;
  sum.add(bar.nodes, bar.nodes.force, false);
  EXPECT_GT(sum.size, 1e4);
  EXPECT_LT(norm(sum.linear), 1e-12 * sum.size);
  EXPECT_LT(norm(sum.angular), 1e-12 * sum.angular_size);
}

TEST(BarChain, DoesNotFeelARigidMotion) {
  BarChain bar = straight_bar(20e-3, steel());
  const double c = std::cos(1.1), s = std::sin(1.1);
  for (std::size_t i = 0; i < bar.nodes.owned; ++i) {
    const Vec3 x = bar.nodes.position[i];
    bar.nodes.position.set(i, {c * x[0] + 3, s * x[0] - 1, 2});
  }
  bar.update();
  for (std::size_t i = 0; i < bar.nodes.owned; ++i) EXPECT_LT(norm(bar.nodes.force[i]), 1e-3);
}

/// Energy of extension and bending of an elastic chain, J.
double stored_energy(BarChain bar) {
  bar.update();
  double sum = 0;
  for (const auto& link : bar.segments())
    sum += 0.5 * link.area * link.length * link.steel.stress * link.steel.stress / 200e9;
  for (const auto& joint : bar.hinges())
    sum += 0.5 * joint.state.moment * joint.state.moment * joint.length / (200e9 * inertia);
  return sum;
}

TEST(BarChain, ForcesAreTheGradientOfItsEnergy) {
  BarChain bar = straight_bar(20e-3, elastic_steel());
  move_randomly(bar.nodes, 3e-3);
  BarChain there = bar;
  there.update();
  for (const std::size_t i : {0u, 1u, 4u, 10u})
    for (int c = 0; c < 3; ++c) {
      const double d = 1e-8;
      BarChain more = bar, less = bar;
      more.nodes.position.component[c][i] += d;
      less.nodes.position.component[c][i] -= d;
      const double slope = (stored_energy(more) - stored_energy(less)) / (2 * d);
      EXPECT_NEAR(there.nodes.force[i][c], -slope, 1e-5 * std::abs(slope) + 1);
    }
}

TEST(BarChain, WorkIsTheStoredEnergy) {
  BarChain bar = straight_bar(20e-3, elastic_steel());
  double work = 0;
  for (int n = 0; n < 200; ++n) {
    move_randomly(bar.nodes, 1e-5);
    const BarChain::Work step = bar.update();
    work += step.before + step.after;
  }
  BarChain again = bar;
  EXPECT_NEAR(work, stored_energy(again), 1e-9 * work);
}

TEST(BarChain, ACircleHasTheMomentOfItsCurvatureUpToThePlasticOne) {
  const auto moment = [](double curvature, const BarSteel& material) {
    BarChain bar = straight_bar(10e-3, material);
    for (std::size_t i = 0; i < bar.nodes.owned; ++i) {
      const double angle = bar.nodes.position[i][0] * curvature;
      bar.nodes.position.set(i, {std::sin(angle) / curvature, 0, (1 - std::cos(angle)) / curvature});
    }
    bar.update();
    return bar.hinges()[5].state.moment;
  };
  EXPECT_NEAR(moment(0.1, elastic_steel()), 200e9 * inertia * 0.1, 1e-6 * 200e9 * inertia * 0.1);
  EXPECT_NEAR(moment(10, steel()), 500e6 * std::pow(diameter, 3) / 6, 1e-6);
}

TEST(BarChain, ARupturedSegmentCarriesNothingAndSetsTheNodesFree) {
  BarChain bar = straight_bar(20e-3, steel(0.05));
  for (std::size_t i = 5; i < bar.nodes.owned; ++i) bar.nodes.position.add(i, {2e-3, 0, 0});
  for (std::size_t i = 7; i < bar.nodes.owned; ++i) bar.nodes.position.add(i, {0, 0, 3e-3});
  bar.update();
  EXPECT_EQ(bar.ruptured(), 1u);
  EXPECT_EQ(bar.segments()[4].steel.stress, 0);
  EXPECT_EQ(bar.hinges()[3].state.moment, 0);
  EXPECT_GT(std::abs(bar.hinges()[6].state.moment), 1);
  MomentumSums sum;
  sum.add(bar.nodes, bar.nodes.force, false);
  EXPECT_LT(norm(sum.linear), 1e-12 * sum.size);
}

TEST(BarChain, HalfABarAtAPlaneOfSymmetryBehavesAsHalfOfTheWhole) {
  const auto bend = [](Points& nodes) {
    for (std::size_t i = 0; i < nodes.owned; ++i) {
      const double x = nodes.position[i][0];
      nodes.position.set(i, {1.001 * x, 0.5 * x * x, std::cos(8 * x)});
    }
  };
  BarChain whole({{.from = {-0.1, 0, 0}, .to = {0.1, 0, 0}}}, diameter, 20e-3, elastic_steel(), {}),
      half({{.from = {0, 0, 0}, .to = {0.1, 0, 0}}}, diameter, 20e-3, elastic_steel(), {true, false, false});
  bend(whole.nodes), bend(half.nodes);
  const BarChain::Work all = whole.update(), part = half.update();
  half.hold_in_planes();
  EXPECT_NEAR(2 * part.after, all.after, 1e-9 * all.after);
  for (std::size_t i = 0; i < half.nodes.owned; ++i) {
    const Vec3 of_whole = (i == 0 ? 0.5 : 1) * whole.nodes.force[5 + i];
    EXPECT_LT(norm(half.nodes.force[i] - of_whole), 1e-6 * norm(of_whole) + 1e-6) << i;
    EXPECT_NEAR(half.nodes.mass[i], (i == 0 ? 0.5 : 1) * whole.nodes.mass[5 + i], 1e-12);
  }
}

} // namespace
} // namespace spall::test
