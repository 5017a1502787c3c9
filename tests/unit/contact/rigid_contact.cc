#include "macro/shape/projectile.h"
#include "tests/unit/contact/apply_contact.h"
#include "tests/unit/points/clouds.h"
#include "tests/unit/shape/stl.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

constexpr double dt = 1e-6, spacing = 1e-3;

RigidBody wall() { return {.shape = PlaneWall{}, .free = {false, false, false}}; }
RigidBody projectile() {
  RigidBody body;
  body.shape = Revolution{
      .outer = TangentOgive{.radius = 0.0254, .length = 0.3556, .arc_radius = 6 * 0.0254}.contour()};
  body.mass = 2.34;
  body.velocity = {0, 0, 313};
  return body;
}

/// Makes one point of 1 g, on the surface of its body, at a height above the wall.
Points point_above(double height, const Vec3& velocity) {
  Points points = points_at({{0, 0, height}}, spacing);
  points.mass[0] = 1e-3;
  points.velocity.set(0, velocity);
  points.surface_offset = 0;
  points.faces[0] = low_face;
  return points;
}

double momentum(const Points& points, const RigidBody& body, int c) {
  double sum = std::isinf(body.mass) ? 0 : body.mass * body.velocity[c];
  for (std::size_t i = 0; i < points.owned; ++i) sum += points.mass[i] * points.velocity[i][c];
  return sum;
}
double kinetic(const Points& points, const RigidBody& body) {
  double sum = std::isinf(body.mass) ? 0 : 0.5 * body.mass * dot(body.velocity, body.velocity);
  for (std::size_t i = 0; i < points.owned; ++i)
    sum += 0.5 * points.mass[i] * dot(points.velocity[i], points.velocity[i]);
  return sum;
}

/// Makes points with random velocities about a projectile's nose.
Points cloud_about_the_nose() {
  Points points = points_at(random_cloud(3000, {-0.03, -0.03, -0.09}, {0.03, 0.03, 0.001}), spacing);
  const auto velocities = random_cloud(points.owned, {-200, -200, -200}, {200, 200, 200}, 4);
  for (std::size_t i = 0; i < points.owned; ++i) {
    points.velocity.set(i, velocities[i]);
    points.mass[i] = 1e-3 * (1 + static_cast<double>(i % 3));
  }
  return points;
}

TEST(RigidContact, AnApproachingPointEndsTheStepOnTheSurface) {
  Points points = point_above(1e-5, {0, 0, -100});
  RigidBody body = wall();
  EXPECT_EQ(apply_contact(points, body, {}, dt, 0).touching, 1u);
  EXPECT_NEAR(points.position[0][2] + dt * points.velocity[0][2], 0, 1e-15);
}

TEST(RigidContact, ACellTouchesWithItsFaceAlsoWhenItHasDeformedAndTurned) {
  const double pressed = 0.6, stretched = 1.5, angle = 0.4, c = std::cos(angle), s = std::sin(angle);
  // Pressed along z, stretched along x, then turned about z: the face below is pressed / 2 spacings away.
  // Turned about y, the extent along z mixes both.
  const Mat3 stretch = {stretched, 0, 0, 0, 1, 0, 0, 0, pressed};
  const Mat3 about_z = {c, -s, 0, s, c, 0, 0, 0, 1}, about_y = {c, 0, s, 0, 1, 0, -s, 0, c};
  for (const auto& [turn, extent] :
       {std::pair(about_z, pressed), std::pair(about_y, std::hypot(c * pressed, s * stretched))}) {
    const double face = 0.5 * extent * spacing;
    Points points = point_above(face + 1e-5, {0, 0, -100});
    points.surface_offset = 0.5;
    points.reference[0] = multiply(turn, stretch);
    RigidBody body = wall();
    EXPECT_EQ(apply_contact(points, body, {}, dt, 0).touching, 1u);
    EXPECT_NEAR(points.position[0][2] + dt * points.velocity[0][2], face, 1e-15);
  }
}

/// A cell that has opened to twice its volume touches with half of its extent, one that is pressed with all
/// of it.
TEST(RigidContact, TheSolidPartOfACellHoldsOffTheBody) {
  for (const double J : {2.0, 0.8}) {
    for (const TouchingPart part : {TouchingPart::cell, TouchingPart::solid}) {
      const double face = 0.5 * J * spacing / (part == TouchingPart::solid ? std::max(1.0, J) : 1);
      Points points = point_above(face + 1e-5, {0, 0, -100});
      points.surface_offset = 0.5;
      points.reference[0] = {1, 0, 0, 0, 1, 0, 0, 0, J};
      RigidBody body = wall();
      EXPECT_EQ(apply_contact(points, body, {.touching = part}, dt, 0).touching, 1u);
      EXPECT_NEAR(points.position[0][2] + dt * points.velocity[0][2], face, 1e-15);
    }
  }
}

// Of a body whose outermost points lie on its surface: these touch with their centres, all others with their
// cells.
TEST(RigidContact, APointOnTheSurfaceHasNoCellBeyondIt) {
  Points points = points_at({{0.1, 0, 0}}, spacing);
  points.surface_offset = 0;
  for (const Vec3& normal : {Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{0.6, 0, -0.8}}) {
    points.faces[0] = 0;
    EXPECT_NEAR(points.distance_to_face(0, normal), 0.5 * spacing, 1e-12);
    for (const Face face : {low_face, high_face, rim_face}) {
      points.faces[0] = face;
      EXPECT_EQ(points.distance_to_face(0, normal), 0);
    }
  }
  points.surface_offset = 0.5;
  EXPECT_NEAR(points.distance_to_face(0, {1, 0, 0}), 0.5 * spacing, 1e-12);
}

TEST(RigidContact, PointsThatStayOutsideOrLeaveAreLeftAlone) {
  for (const auto& [height, speed] : {std::pair(1e-3, -100.0), {1e-5, 50.0}, {1e-4 + 1e-12, -100.0}}) {
    Points points = point_above(height, {3, 4, speed});
    RigidBody body = wall();
    const RigidContactReport report = apply_contact(points, body, {.friction = 0.5}, dt, 0);
    EXPECT_EQ(report.touching, 0u);
    EXPECT_EQ(points.velocity[0], (Vec3{3, 4, speed}));
    EXPECT_EQ(report.impulse, Vec3{});
  }
}

TEST(RigidContact, MomentumOfPointsAndBodyIsKept) {
  Points points = cloud_about_the_nose();
  RigidBody body = projectile();
  body.free = {true, true, true};
  const Vec3 before = {momentum(points, body, 0), momentum(points, body, 1), momentum(points, body, 2)};
  const RigidContactReport report = apply_contact(points, body, {.friction = 0.3}, dt, 0);
  EXPECT_GT(report.touching, 100u);
  EXPECT_GT(std::abs(report.impulse[2]), 0.01);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(momentum(points, body, c), before[c], 1e-12 * std::abs(before[2]));
}

// The facets of 1 / 96 of a turn stay within 0.02 mm of the ogive, a tenth of what points approach in a step.
TEST(RigidContact, ABodyOfTrianglesPushesAsTheRoundOneThatTheyFollow) {
  RigidBody round = projectile(), facetted = projectile();
  const Contour& contour = std::get<Revolution>(round.shape).outer;
  facetted.shape = ClosedSurface(turned_surface(contour.outline(1.6e-3), 96));
  for (const bool turns : {false, true}) {
    round.turns = facetted.turns = {turns, turns, turns};
    round.moments = facetted.moments = {0.02, 0.02, 0.001};
    Points one = cloud_about_the_nose(), other = one;
    const RigidContactReport a = push_points(one, round, {}, dt, 0),
                             b = push_points(other, facetted, {}, dt, 0);
    ASSERT_GT(a.touching, 100U);
    EXPECT_NEAR(static_cast<double>(b.touching), static_cast<double>(a.touching), 0.02 * a.touching);
    EXPECT_LT(norm(b.impulse - a.impulse), 0.02 * norm(a.impulse));
    EXPECT_NEAR(b.normal_loss, a.normal_loss, 0.02 * a.normal_loss);
  }
}

TEST(RigidContact, AHeldDirectionTakesImpulseButNoVelocity) {
  Points points = cloud_about_the_nose();
  RigidBody body = projectile();
  const double before = momentum(points, body, 2);
  const RigidContactReport report = apply_contact(points, body, {.friction = 0.3}, dt, 0);
  EXPECT_NE(report.impulse[0], 0);
  EXPECT_EQ(body.velocity[0], 0);
  EXPECT_EQ(body.velocity[1], 0);
  EXPECT_NEAR(momentum(points, body, 2), before, 1e-12 * before);
}

/// Friction that falls with the velocity and is limited by a stress, in closed form.
TEST(RigidContact, FrictionFollowsItsLawOfVelocityAndStress) {
  for (const double speed : {5.0, 100.0, 500.0}) {
    Friction friction(0.3);
    friction.sliding = 0.05, friction.decay_velocity = 80;
    const double expected = 0.05 + 0.25 * std::exp(-speed / 80), normal = 1e-3 * 100;
    const auto tangential = [&] {
      Points points = point_above(0, {0.6 * speed, 0.8 * speed, -100});
      RigidBody body = wall();
      const RigidContactReport report = apply_contact(points, body, {.friction = friction}, dt, 0);
      return std::hypot(report.impulse[0], report.impulse[1]);
    };
    // A slow point sticks: it has less momentum along the wall than friction could take.
    EXPECT_NEAR(tangential(), std::min(expected * normal, 1e-3 * speed), 1e-12);
    // Half a cell of the volume spacing^3 has twice the face: its point lies on the surface.
    friction.largest_stress = 0.5e3;
    EXPECT_NEAR(tangential(), std::min({expected * normal, 1e-3 * speed, 0.5e3 * 2 * spacing * spacing * dt}),
                1e-12);
  }
}

TEST(RigidContact, SlipIsOppositeToTheMotionAndLimitedByTheFrictionCone) {
  const double mu = 0.2;
  Points points = point_above(0, {300, 400, -100});
  RigidBody body = wall();
  const RigidContactReport report = apply_contact(points, body, {.friction = mu}, dt, 0);
  const double normal = -report.impulse[2];
  EXPECT_NEAR(normal, 1e-3 * 100, 1e-12);
  EXPECT_NEAR(std::hypot(report.impulse[0], report.impulse[1]), mu * normal, 1e-12);
  // Friction takes 20 m/s of the 500 m/s in the direction of the slip.
  EXPECT_NEAR(points.velocity[0][0], 300 - 0.6 * 20, 1e-9);
  EXPECT_NEAR(points.velocity[0][1], 400 - 0.8 * 20, 1e-9);
}

TEST(RigidContact, SticksWhenTheConeHoldsMoreThanTheMotionNeeds) {
  Points points = point_above(0, {3, -4, -100});
  RigidBody body = wall();
  apply_contact(points, body, {.friction = 0.2}, dt, 0);
  EXPECT_NEAR(points.velocity[0][0], 0, 1e-12);
  EXPECT_NEAR(points.velocity[0][1], 0, 1e-12);
}

TEST(RigidContact, WithoutFrictionTangentialVelocityIsUntouched) {
  Points points = point_above(0, {3, -4, -100});
  RigidBody body = wall();
  const RigidContactReport report = apply_contact(points, body, {}, dt, 0);
  EXPECT_EQ(points.velocity[0][0], 3);
  EXPECT_EQ(points.velocity[0][1], -4);
  EXPECT_EQ(report.friction_loss, 0);
}

TEST(RigidContact, APointPressedOntoTheSurfaceAtRestLosesNothing) {
  // The point was at rest before the internal force gave it a velocity towards the wall.
  const double force = -2000, kick = dt;
  Points points = point_above(0, {0, 0, kick * force / 1e-3});
  points.force.set(0, {0, 0, force});
  RigidBody body = wall();
  const RigidContactReport report = apply_contact(points, body, {.friction = 0.5}, dt, kick);
  EXPECT_NEAR(-report.impulse[2], -force * kick, 1e-15);
  EXPECT_NEAR(points.velocity[0][2], 0, 1e-12);
  EXPECT_NEAR(report.normal_loss, 0, 1e-15);
  EXPECT_NEAR(report.friction_loss, 0, 1e-15);
}

TEST(RigidContact, AnOldOverlapIsReleasedSlowlyAndNeverThrowsThePoint) {
  const double release = 0.1;
  Points points = point_above(-1e-4, {0, 0, 0});
  RigidBody body = wall();
  const RigidContactReport report =
      apply_contact(points, body, {.overlap_release = release, .release_speed = 20}, dt, 0);
  EXPECT_NEAR(report.deepest, 1e-4, 1e-15);
  EXPECT_NEAR(points.velocity[0][2] * dt, release * 1e-4, 1e-15);
  // A deep overlap is released no faster than allowed.
  Points deep = point_above(-0.5 * spacing, {0, 0, -30});
  RigidBody third = wall();
  apply_contact(deep, third, {.overlap_release = release, .release_speed = 20}, dt, 0);
  EXPECT_NEAR(deep.velocity[0][2], 20, 1e-12);
  // A point that leaves fast enough already is not changed.
  Points leaving = point_above(-1e-4, {0, 0, 60});
  RigidBody same = wall();
  apply_contact(leaving, same, {.overlap_release = release, .release_speed = 20}, dt, 0);
  EXPECT_EQ(leaving.velocity[0][2], 60);
}

TEST(RigidContact, LossesAreTheKineticEnergyThatIsGoneWhenNoForceActs) {
  for (const double friction : {0.0, 0.3}) {
    Points points = cloud_about_the_nose();
    RigidBody body = projectile();
    body.free = {true, true, true};
    const double before = kinetic(points, body);
    const RigidContactReport report = apply_contact(points, body, {.friction = friction}, dt, 0);
    EXPECT_NEAR(report.normal_loss + report.friction_loss, before - kinetic(points, body), 1e-10 * before);
    if (friction == 0)
      EXPECT_EQ(report.friction_loss, 0);
    else
      EXPECT_GT(report.friction_loss, 0);
  }
}

TEST(RigidContact, ImpulsesAreGalileanInvariant) {
  // Galilean invariance: only velocities relative to the body matter for the impulses.
  Points points = cloud_about_the_nose(), boosted = points;
  RigidBody body = projectile(), moving = body;
  body.free = moving.free = {true, true, true};
  const Vec3 frame = {10, -20, 300};
  for (std::size_t i = 0; i < points.owned; ++i) {
    Vec3 v = points.velocity[i];
    for (int c = 0; c < 3; ++c) v[c] += frame[c];
    boosted.velocity.set(i, v);
  }
  for (int c = 0; c < 3; ++c) moving.velocity[c] += frame[c];
  const RigidContactReport a = apply_contact(points, body, {.friction = 0.3}, dt, 0),
                           b = apply_contact(boosted, moving, {.friction = 0.3}, dt, 0);
  EXPECT_EQ(a.touching, b.touching);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(a.impulse[c], b.impulse[c], 1e-8 * std::abs(a.impulse[2]));
    EXPECT_NEAR(body.velocity[c] + frame[c], moving.velocity[c], 1e-8);
  }
}

TEST(RigidContact, ALightBodyIsStoppedByAHeavyPointAsInAPlasticCollision) {
  Points points = point_above(0, {0, 0, -10});
  RigidBody body = wall();
  body.mass = 0.5e-3;
  body.free = {false, false, true};
  // The point is stopped at the surface of a free body: afterwards both move with the velocity of their
  // common centre of mass.
  apply_contact(points, body, {}, dt, 0);
  EXPECT_NEAR(points.velocity[0][2], -10 * 1e-3 / 1.5e-3, 1e-9);
  EXPECT_NEAR(body.velocity[2], points.velocity[0][2], 1e-9);
}

} // namespace
} // namespace spall::test
