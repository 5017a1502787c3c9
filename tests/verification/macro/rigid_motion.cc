// Tests of objectivity: rigid motion does not change the stress, a superposed rotation commutes with loading,
// and a free body conserves momentum and angular momentum.

#include "tests/verification/macro/bodies.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

Points cylinder(const J2& material) {
  return fill_cylinder({.radius = 4e-3, .height = 10e-3}, {4, 10, Boundary::centred}, SymmetryPlanes{},
                       material.density);
}

Mat3 turn(double angle) {
  // The axis is skew: z rotated by a fixed rotation.
  const double a = 0.8;
  const Mat3 tilt = {1, 0, 0, 0, std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a)};
  const Mat3 z = {std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0, 0, 0, 1};
  return multiply(multiply(tilt, z), transpose(tilt));
}
Vec3 mapped(const Mat3& a, const Vec3& x) {
  return {a[0] * x[0] + a[1] * x[1] + a[2] * x[2], a[3] * x[0] + a[4] * x[1] + a[5] * x[2],
          a[6] * x[0] + a[7] * x[1] + a[8] * x[2]};
}
Sym3 turned(const Mat3& q, const Sym3& s) {
  const Mat3 full = {s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]};
  const Mat3 r = multiply(multiply(q, full), transpose(q));
  return {r[0], r[4], r[8], r[1], r[5], r[2]};
}

/// Drives all points along x = map(t) X in equal steps with exact end positions, with refreshes. @return the
/// body
std::unique_ptr<Solid> drive(const J2& material, const Numerics& numerics, const Sym3& initial_stress,
                             int steps, const std::function<Mat3(double)>& map) {
  Points start = cylinder(material);
  const SolidInputs inputs = numerics.solid(start, cylinder_outline(4e-3, 0, 10e-3));
  auto solid = make_solid(material, start, SymmetryPlanes{}, inputs);
  Points& points = solid->points;
  points.stress.assign(points.owned, initial_stress);
  const double dt = 1e-6;
  for (int n = 0; n < steps; ++n) {
    if (n % numerics.refresh_interval == 0) solid->refresh();
    const Mat3 end = map((n + 1.0) / steps);
    for (std::size_t i = 0; i < points.owned; ++i) {
      const Vec3 x = points.position[i], y = mapped(end, points.initial_position[i]);
      points.velocity.set(i, {(y[0] - x[0]) / dt, (y[1] - x[1]) / dt, (y[2] - x[2]) / dt});
      points.position.set(i, y);
    }
    solid->update(dt, n * dt);
  }
  return solid;
}

/// Returns the largest difference of any stress component of any point from `expected`, in units of `scale`.
double largest_error(const Solid& solid, const Sym3& expected, double scale) {
  double error = 0;
  for (std::size_t i = 0; i < solid.points.owned; ++i) {
    const Sym3 s = solid.points.cauchy(i);
    for (int c = 0; c < 6; ++c) error = std::max(error, std::abs(s[c] - expected[c]) / scale);
  }
  return error;
}

class RigidMotion : public ::testing::TestWithParam<Scheme> {};
INSTANTIATE_TEST_SUITE_P(Schemes, RigidMotion,
                         ::testing::Values(Scheme::nsni, Scheme::dni, Scheme::snni, Scheme::m_snni,
                                           Scheme::scni, Scheme::m_scni, Scheme::subpoint),
                         scheme_label);

TEST_P(RigidMotion, ARotationTurnsTheStressAndAddsNone) {
  const J2 material = elastic();
  const Sym3 stress = {1e8, -2e8, 3e8, 5e7, -4e7, 2e7};
  for (const bool precise : {true, false}) {
    const Numerics numerics{.scheme = GetParam(), .double_precision = precise};
    const double angle = 1.7;
    const auto solid = drive(material, numerics, stress, 40, [&](double t) { return turn(t * angle); });
    // The error of the stress is the round-off of the gradients times the elastic modulus; smoothing
    // subtracts shape functions of nearly the same size.
    EXPECT_LT(largest_error(*solid, turned(turn(angle), stress), material.youngs_modulus),
              precise ? 1e-12 : 4e-5);
  }
}

TEST_P(RigidMotion, ATranslationChangesNothing) {
  const J2 material = elastic();
  for (const bool precise : {true, false}) {
    Points points = cylinder(material);
    set_velocity(points, [](const Vec3&) { return Vec3{300, -200, 700}; });
    Simulation run = free_flight(material, points, {.scheme = GetParam(), .double_precision = precise},
                                 cylinder_outline(4e-3, 0, 10e-3));
    for (int n = 0; n < 60; ++n) run.advance();
    EXPECT_LT(largest_error(*run.bodies.solids[0], {}, material.youngs_modulus), precise ? 1e-12 : 1e-6);
    for (std::size_t i = 0; i < run.bodies.solids[0]->points.owned; ++i) {
      const Vec3 v = run.bodies.solids[0]->points.velocity[i];
      EXPECT_NEAR(v[0], 300, 1e-3);
      EXPECT_NEAR(v[2], 700, 1e-3);
    }
  }
}

// The error is of second order in the step, because the strain at the middle of the step is rotated by half
// of the step's rotation (if it were added after the whole rotation, as by Hughes and Winget, the error would
// be of first order).
TEST_P(RigidMotion, ASuperposedRotationCommutesWithLoading) {
  J2 material = elastic();
  material.initial_yield = 420e6, material.hardening_modulus = 1e9;
  const double angle = 0.9;
  // The loading is plastic compression along z at nearly constant volume, and a shear.
  const auto stretch = [](double t) {
    return Mat3{1 + 0.04 * t, 0.03 * t, 0, 0, 1 + 0.03 * t, 0, 0, 0, 1 - 0.08 * t};
  };
  double last = 0;
  for (const int steps : {40, 80, 160}) {
    const Numerics numerics{.scheme = GetParam()};
    const auto plain = drive(material, numerics, {}, steps, stretch),
               spun = drive(material, numerics, {}, steps,
                            [&](double t) { return multiply(turn(t * angle), stretch(t)); });
    const double error =
        largest_error(*spun, turned(turn(angle), plain->points.cauchy(0)), material.initial_yield);
    EXPECT_GT(plain->field("plastic_strain")[0], 0.05);
    EXPECT_NEAR(plain->field("plastic_strain")[0], spun->field("plastic_strain")[0], 1e-3);
    if (last > 0) {
      EXPECT_NEAR(last / error, 4, 0.2) << error;
    }
    last = error;
  }
  EXPECT_LT(last, 1e-4);
}

struct Momenta {
  Vec3 linear{}, angular{};
};
Momenta momenta(const Points& points) {
  Momenta sum;
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 x = points.position[i], v = points.velocity[i];
    for (int c = 0; c < 3; ++c) {
      sum.linear[c] += points.mass[i] * v[c];
      sum.angular[c] += points.mass[i] * (x[(c + 1) % 3] * v[(c + 2) % 3] - x[(c + 2) % 3] * v[(c + 1) % 3]);
    }
  }
  return sum;
}

TEST(FreeBody, KeepsMomentumAndAngularMomentumWhileItSpinsAndVibrates) {
  const J2 material = elastic();
  for (const Scheme scheme :
       {Scheme::dni, Scheme::snni, Scheme::nsni, Scheme::m_snni, Scheme::scni, Scheme::subpoint}) {
    Points points = cylinder(material);
    // The spin gives 100 m/s at the rim; a vibration of 50 m/s is added.
    set_velocity(points, [](const Vec3& x) {
      return Vec3{-2.5e4 * x[1] + 50 * std::sin(400 * x[2]), 2.5e4 * x[0], 30 * std::sin(300 * x[0] + 1)};
    });
    Simulation run = free_flight(material, points, {.scheme = scheme}, cylinder_outline(4e-3, 0, 10e-3));
    const Momenta before = momenta(run.bodies.solids[0]->points);
    const double spin = std::abs(before.angular[2]), speed = spin / 4e-3;
    for (int n = 0; n < 300; ++n) run.advance();
    const Momenta after = momenta(run.bodies.solids[0]->points);
    double change = 0;
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(after.linear[c], before.linear[c], 1e-12 * speed);
      change = std::max(change, std::abs(after.angular[c] - before.angular[c]) / spin);
    }
    std::printf("%s: angular momentum changes by %.1e, energy by %.1e\n", name_of(scheme), change,
                run.energies.error());
    // Forces of a gradient operator that is exact for linear fields have no moment; those of its derivatives
    // have a moment of second order in the curvature of the motion.
    EXPECT_LT(change, layout_of({.scheme = scheme}).width > 1 ? 1e-4 : 1e-12);
    EXPECT_LT(std::abs(run.energies.error()), 1e-3);
  }
}

} // namespace
} // namespace spall::test
