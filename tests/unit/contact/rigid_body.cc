#include "macro/contact/rigid_body.h"

#include "macro/shape/projectile.h"
#include "tests/unit/contact/apply_contact.h"
#include "tests/unit/points/clouds.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

double length(const Vec3& a) { return std::sqrt(dot(a, a)); }
double distance(const Vec3& a, const Vec3& b) { return length(add(a, -1, b)); }

RigidBody top(const Vec3& moments, const Vec3& spin) {
  RigidBody body;
  body.shape = Revolution{
      .outer = TangentOgive{.radius = 0.0254, .length = 0.3556, .arc_radius = 6 * 0.0254}.contour()};
  body.mass = 2;
  body.free = body.turns = {true, true, true};
  body.centre = {0, 0, -0.2};
  body.moments = moments;
  body.velocity = {3, -4, 300};
  body.orientation = normalized({0.9, 0.1, -0.3, 0.2});
  body.angular_momentum = spin;
  return body;
}
void fly(RigidBody& body, double time, int steps) {
  for (int n = 0; n < steps; ++n) body.move(time / steps);
}
Vec3 axis_of(const RigidBody& body) { return times(matrix_of(body.orientation), {0, 0, 1}); }

TEST(RigidBody, ASymmetricTopPrecessesAboutItsAngularMomentum) {
  const Vec3 spin = {0.3, 1.1, -0.7};
  const double across = 0.02, time = 0.05;
  const RigidBody start = top({across, across, 0.001}, spin);
  // The exact axis rotates about the angular momentum L at the rate |L| / I, with the transverse moment I.
  const double angle = length(spin) / across * time, c = std::cos(angle), s = std::sin(angle);
  const Vec3 k = add({}, 1 / length(spin), spin), a = axis_of(start), turned = cross(k, a);
  Vec3 exact;
  for (int i = 0; i < 3; ++i) exact[i] = c * a[i] + s * turned[i] + (1 - c) * dot(k, a) * k[i];
  std::array<double, 2> error{};
  for (int refinement = 0; refinement < 2; ++refinement) {
    RigidBody body = start;
    fly(body, time, refinement ? 4000 : 2000);
    error[refinement] = distance(axis_of(body), exact);
    EXPECT_EQ(body.angular_momentum, spin);
    EXPECT_NEAR(body.kinetic_energy(), start.kinetic_energy(), 1e-5 * start.kinetic_energy());
  }
  EXPECT_LT(error[0], 1e-3);
  EXPECT_NEAR(error[0] / error[1], 4, 0.2); // second order
}

// The frame of a shape is a matter of description: a body whose axes of inertia lie askew in it flies as the
// same body in the frame of its axes.
TEST(RigidBody, AxesOfInertiaMayLieAskewInTheFrame) {
  const RigidBody along = top({0.01, 0.02, 0.03}, {0.1, 20, 0.1});
  RigidBody askew = along, straight = along;
  askew.principal = normalized({0.8, -0.2, 0.4, 0.1});
  askew.orientation = along.orientation * conjugate(askew.principal);
  askew.centre = times(matrix_of(askew.principal), along.centre);
  EXPECT_NEAR(askew.kinetic_energy(), straight.kinetic_energy(), 1e-12 * straight.kinetic_energy());
  fly(askew, 0.05, 1000), fly(straight, 0.05, 1000);
  const Mat3 axes = matrix_of(askew.orientation * askew.principal),
             expected = matrix_of(straight.orientation);
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(axes[i], expected[i], 1e-9) << i;
  EXPECT_LT(distance(askew.centre_of_mass(), straight.centre_of_mass()), 1e-12);
}

TEST(RigidBody, ATumblingTopKeepsItsEnergyAndComesBackWhenTurnedBack) {
  // Rotation about the middle axis is unstable, so the body tumbles, for more than 100 turns.
  const RigidBody start = top({0.01, 0.02, 0.03}, {0.1, 20, 0.1});
  RigidBody body = start;
  double worst = 0, least = 1;
  for (int n = 0; n < 20000; ++n) {
    body.move(5e-5);
    worst = std::max(worst, std::abs(body.kinetic_energy() / start.kinetic_energy() - 1));
    least = std::min(least, dot(axis_of(body), axis_of(start)));
  }
  EXPECT_LT(worst, 1e-3);
  EXPECT_LT(least, -0.5);
  for (int c = 0; c < 3; ++c) body.velocity[c] *= -1, body.angular_momentum[c] *= -1;
  fly(body, 1, 20000);
  EXPECT_LT(distance(body.position, start.position), 1e-8);
  EXPECT_LT(distance(axis_of(body), axis_of(start)), 1e-8);
}

TEST(RigidBody, TheCentreOfMassFliesStraight) {
  RigidBody body = top({0.02, 0.02, 0.001}, {1, 2, 3});
  const Vec3 expected = add(body.centre_of_mass(), 0.01, body.velocity);
  fly(body, 0.01, 100);
  EXPECT_LT(distance(body.centre_of_mass(), expected), 1e-14);
}

TEST(RigidBody, InAHalfModelItTurnsAboutTheNormalOfThePlaneOnly) {
  RigidBody body = top({0.02, 0.02, 0.001}, {});
  body.orientation = about_axis(1, 0.4);
  body.free = {true, false, true};
  body.turns = {false, true, false};
  body.velocity = {1, 0, 2};
  body.receive({0.3, 0.2, 0.1}, {1, 2, 3});
  EXPECT_EQ(body.velocity, (Vec3{1 + 0.15, 0, 2 + 0.05}));
  EXPECT_NEAR(body.angular_velocity()[1], 2 / 0.02, 1e-9);
  EXPECT_EQ(body.angular_velocity()[0], 0);
  EXPECT_NEAR(body.kinetic_energy(), dot(body.velocity, body.velocity) + 0.5 * 4 / 0.02, 1e-9);
  fly(body, 0.01, 10);
  EXPECT_NEAR(axis_of(body)[0], std::sin(0.4 + 1), 1e-12);
  EXPECT_EQ(axis_of(body)[1], 0);
}

/// Points with random velocities about the nose of a rotated projectile, and the sums over points and body.
struct Impact {
  RigidBody body = top({0.02, 0.02, 0.001}, {0.4, -0.2, 0.1});
  Points points = points_at(random_cloud(3000, {-0.03, -0.03, -0.09}, {0.03, 0.03, 0.001}), 1e-3);
  Impact() {
    const auto velocities = random_cloud(points.owned, {-200, -200, -200}, {200, 200, 200}, 4);
    const Mat3 axes = matrix_of(body.orientation);
    body.position = {0.1, -0.2, 0.3};
    for (std::size_t i = 0; i < points.owned; ++i) {
      points.position.set(i, add(body.position, 1, times(axes, points.position[i])));
      points.velocity.set(i, velocities[i]);
      points.mass[i] = 1e-4 * (1 + static_cast<double>(i % 3));
    }
  }
  RigidContactReport touch(double friction) {
    return apply_contact(points, body, {.friction = friction}, 1e-6, 0);
  }
  Vec3 linear() const {
    Vec3 sum = add({}, body.mass, body.velocity);
    for (std::size_t i = 0; i < points.owned; ++i) sum = add(sum, points.mass[i], points.velocity[i]);
    return sum;
  }
  Vec3 angular() const {
    Vec3 sum = add(body.angular_momentum, body.mass, cross(body.centre_of_mass(), body.velocity));
    for (std::size_t i = 0; i < points.owned; ++i)
      sum = add(sum, points.mass[i], cross(points.position[i], points.velocity[i]));
    return sum;
  }
  double kinetic() const {
    double sum = body.kinetic_energy();
    for (std::size_t i = 0; i < points.owned; ++i)
      sum += 0.5 * points.mass[i] * dot(points.velocity[i], points.velocity[i]);
    return sum;
  }
};

TEST(RigidBody, ContactKeepsLinearAndAngularMomentum) {
  for (const double friction : {0.0, 0.3}) {
    Impact impact;
    const Vec3 linear = impact.linear(), angular = impact.angular();
    const RigidContactReport report = impact.touch(friction);
    EXPECT_GT(report.touching, 100u);
    EXPECT_GT(length(report.angular_impulse), 1e-3 * length(angular));
    EXPECT_LT(distance(impact.linear(), linear), 1e-12 * length(linear));
    EXPECT_LT(distance(impact.angular(), angular), 1e-12 * length(angular));
  }
}

TEST(RigidBody, LossesOfContactAreTheKineticEnergyThatIsGone) {
  for (const double friction : {0.0, 0.3}) {
    Impact impact;
    const double before = impact.kinetic();
    const RigidContactReport report = impact.touch(friction);
    EXPECT_NEAR(report.normal_loss + report.friction_loss, before - impact.kinetic(), 1e-11 * before);
  }
}

TEST(RigidBody, APointHittingTheTailTurnsTheBodyAsInAPlasticCollision) {
  // The point hits a body at rest normal to its axis, at the distance b from its centre of mass; afterwards
  // point and contact place have the same velocity.
  RigidBody body = top({0.02, 0.02, 0.001}, {});
  body.orientation = {};
  body.velocity = {};
  Points points = points_at({{0.0254, 0, -0.3}}, 1e-3);
  points.mass[0] = 0.01;
  points.velocity.set(0, {-10, 0, 0});
  points.surface_offset = 0;
  points.faces[0] = rim_face;
  apply_contact(points, body, {}, 1e-6, 0);
  const double arm = 0.1, mobility = 1 / 2.0 + arm * arm / 0.02, impulse = 10 / (1 / 0.01 + mobility);
  EXPECT_NEAR(body.velocity[0], -impulse / 2, 1e-6);
  EXPECT_NEAR(body.angular_velocity()[1], impulse * arm / 0.02, 1e-5);
  EXPECT_NEAR(points.velocity[0][0], -impulse * mobility, 1e-5);
}

} // namespace
} // namespace spall::test
