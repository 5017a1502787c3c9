#include "macro/contact/surface_contact.h"

#include "tests/unit/points/clouds.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <numbers>

namespace spall::test {
namespace {

constexpr double dt = 1e-7;

/// The points of a body, without an approximation, as contact needs them.
struct Body {
  Points points;
  Ghosts ghosts;
  ContactBody view() { return {&points, &ghosts, 1e11, 5e10}; }
};

/// Makes a block of nx x ny x nz whole cells of edge h with the lowest corner at `corner` and 1 g per cubic
/// millimetre.
Body block(Vec3 corner, std::array<int, 3> n, double h) {
  std::vector<Vec3> positions;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        positions.push_back(
            {corner[0] + (i + 0.5) * h, corner[1] + (j + 0.5) * h, corner[2] + (k + 0.5) * h});
  Body body{points_at(positions, h), Ghosts{}};
  for (double& m : body.points.mass) m = 1e6 * h * h * h;
  return body;
}
void move(Body& body, Vec3 velocity) {
  for (std::size_t i = 0; i < body.points.owned; ++i) body.points.velocity.set(i, velocity);
}
void stir(Body& body, double speed, unsigned seed) {
  const auto random = random_cloud(body.points.owned, {-speed, -speed, -speed}, {speed, speed, speed}, seed);
  for (std::size_t i = 0; i < body.points.owned; ++i) {
    Vec3 v = body.points.velocity[i];
    for (int c = 0; c < 3; ++c) v[c] += random[i][c];
    body.points.velocity.set(i, v);
  }
}
void turn(Body& body, const Mat3& q) {
  const auto times = [&q](const Vec3& a) {
    return Vec3{q[0] * a[0] + q[1] * a[1] + q[2] * a[2], q[3] * a[0] + q[4] * a[1] + q[5] * a[2],
                q[6] * a[0] + q[7] * a[1] + q[8] * a[2]};
  };
  for (std::size_t i = 0; i < body.points.owned; ++i) {
    body.points.position.set(i, times(body.points.position[i]));
    body.points.velocity.set(i, times(body.points.velocity[i]));
    body.points.reference[i] = q;
  }
}
/// Returns a rotation about a skew axis (Rodrigues' formula).
Mat3 rotation(double angle) {
  const double x = 0.48, y = 0.6, z = 0.64, s = std::sin(angle), c = std::cos(angle);
  return {c + x * x * (1 - c),     x * y * (1 - c) - z * s, x * z * (1 - c) + y * s,
          y * x * (1 - c) + z * s, c + y * y * (1 - c),     y * z * (1 - c) - x * s,
          z * x * (1 - c) - y * s, z * y * (1 - c) + x * s, c + z * z * (1 - c)};
}

struct Momentum {
  Vec3 linear{}, angular{};
  double linear_size = 0, kinetic = 0;
};
Momentum momentum(const std::vector<Body*>& bodies) {
  Momentum sum;
  for (const Body* body : bodies)
    for (std::size_t i = 0; i < body->points.owned; ++i) {
      const Vec3 x = body->points.position[i], v = body->points.velocity[i];
      const double m = body->points.mass[i];
      for (int c = 0; c < 3; ++c) {
        sum.linear[c] += m * v[c];
        sum.angular[c] += m * (x[(c + 1) % 3] * v[(c + 2) % 3] - x[(c + 2) % 3] * v[(c + 1) % 3]);
      }
      sum.kinetic += 0.5 * m * dot(v, v);
      sum.linear_size += m * std::sqrt(dot(v, v));
    }
  return sum;
}
double size(const Vec3& a) { return std::sqrt(dot(a, a)); }

/// A fine block on a wide coarse one, faces in contact at z = 0, pressed together at 10 m/s.
struct Pair {
  Body upper = block({-3e-3, -3e-3, 0}, {6, 6, 4}, 1e-3),
       lower = block({-6e-3, -6e-3, -6e-3}, {8, 8, 4}, 1.5e-3);
  explicit Pair(Vec3 velocity = {0, 0, -10}) { move(upper, velocity); }
  SolidContactReport touch(const ContactInputs& inputs = {}) {
    return SurfaceContact(inputs, all_pairs(2, "surface")).touch({upper.view(), lower.view()}, dt, 0);
  }
};

TEST(SurfaceContact, KeepsLinearAndAngularMomentum) {
  for (const double friction : {0.0, 0.4}) {
    Pair pair({3, -2, -10});
    stir(pair.upper, 4, 1), stir(pair.lower, 4, 2);
    const Momentum before = momentum({&pair.upper, &pair.lower});
    const SolidContactReport report = pair.touch({.friction = friction});
    const Momentum after = momentum({&pair.upper, &pair.lower});
    EXPECT_GT(report.touching, 20u);
    EXPECT_GT(size(report.exchange.received(0)), 0.01 * size(before.linear));
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(after.linear[c], before.linear[c], 1e-14 * size(before.linear));
      EXPECT_NEAR(report.exchange.received(0)[c], -report.exchange.received(1)[c],
                  1e-15 * size(before.linear));
    }
    // Normal forces conserve the moment; friction acts half a cell away from the points that carry it.
    if (friction == 0) {
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(after.angular[c], before.angular[c], 1e-12 * 6e-3 * size(before.linear));
    }
  }
}

TEST(SurfaceContact, ThreeBodiesKeepTheirMomenta) {
  Pair pair({3, -2, -10});
  // A wider third body below moves up. No body overhangs an edge, where moments would not be conserved.
  Body third = block({-9e-3, -9e-3, -9e-3}, {18, 18, 3}, 1e-3);
  move(third, {-1, 2, 12});
  stir(third, 4, 3);
  const std::vector<Body*> all = {&pair.upper, &pair.lower, &third};
  const Momentum before = momentum(all);
  const SolidContactReport report = SurfaceContact({}, all_pairs(3, "surface"))
                                        .touch({pair.upper.view(), pair.lower.view(), third.view()}, dt, 0);
  const Momentum after = momentum(all);
  for (std::size_t b = 0; b < 3; ++b)
    EXPECT_GT(size(report.exchange.received(b)), 0.01 * size(before.linear));
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(after.linear[c], before.linear[c], 1e-14 * before.linear_size);
    EXPECT_NEAR(after.angular[c], before.angular[c], 1e-12 * 6e-3 * before.linear_size);
    EXPECT_NEAR(report.exchange.received(0)[c] + report.exchange.received(1)[c] +
                    report.exchange.received(2)[c],
                0, 1e-14 * before.linear_size);
  }
}

TEST(SurfaceContact, TheFirstBodyTouchesTheSurfaceOfTheSecondWhicheverIsFiner) {
  // The touching points belong to the first body: 6 x 6 of the fine one, or those of the coarse one below it.
  for (const bool fine_first : {true, false}) {
    Pair pair;
    const auto upper = pair.upper.view(), lower = pair.lower.view();
    const SolidContactReport report =
        fine_first ? SurfaceContact({}, all_pairs(2, "surface")).touch({upper, lower}, dt, 0)
                   : SurfaceContact({}, all_pairs(2, "surface")).touch({lower, upper}, dt, 0);
    if (fine_first)
      EXPECT_EQ(report.touching, 36u);
    else
      EXPECT_EQ(report.touching, 16u);
    EXPECT_NEAR(std::abs(report.exchange.received(0)[2]), std::abs(report.exchange.received(1)[2]), 1e-15);
  }
}

TEST(SurfaceContact, NoPointOfTheFacesApproachesTheOtherAfterwards) {
  Pair pair;
  stir(pair.upper, 3, 1), stir(pair.lower, 3, 2);
  pair.touch();
  // A second application finds no approaching point.
  const SolidContactReport again = pair.touch();
  EXPECT_LT(size(again.exchange.received(0)), 1e-3 * 10 * 36e-3);
}

TEST(SurfaceContact, BodiesThatSeparateOrPassAtADistanceAreLeftAlone) {
  for (const auto& [velocity, shift] :
       {std::pair(Vec3{5, 0, 3}, 0.0), {Vec3{0, 0, -10}, 2e-6}, {Vec3{0, 0, -10}, 1.0}}) {
    Pair pair(velocity);
    for (double& z : pair.upper.points.position.component[2]) z += shift;
    const SolidContactReport report = pair.touch({.friction = 0.5});
    EXPECT_EQ(report.touching, 0u);
    EXPECT_EQ(report.exchange.received(0), Vec3{});
    for (std::size_t i = 0; i < pair.upper.points.owned; ++i)
      EXPECT_EQ(pair.upper.points.velocity[i], velocity);
  }
}

TEST(SurfaceContact, AGapIsClosedByTheEndOfTheStepAndNotBefore) {
  Pair pair;
  const double gap = 0.4 * 10 * dt;
  for (double& z : pair.upper.points.position.component[2]) z += gap;
  const SolidContactReport report = pair.touch();
  EXPECT_EQ(report.touching, 36u); // the face of 6 x 6
  EXPECT_NEAR(report.gap_sum, 36 * gap, 1e-6 * gap);
  for (Body* body : {&pair.upper, &pair.lower})
    for (std::size_t i = 0; i < body->points.owned; ++i)
      for (int c = 0; c < 3; ++c)
        body->points.position.component[c][i] += dt * body->points.velocity.component[c][i];
  const ContactReport after =
      SurfaceContact({}, all_pairs(2, "surface")).measure({pair.upper.view(), pair.lower.view()});
  EXPECT_EQ(after.touching, 36u);
  EXPECT_LT(after.gap_max, 1e-2 * gap);
}

TEST(SurfaceContact, FrictionIsOppositeToTheSlipAndLimitedByTheCone) {
  const double mu = 0.2;
  Pair pair({300, 400, -10});
  const SolidContactReport report = pair.touch({.friction = mu});
  const Vec3& p = report.exchange.received(0);
  EXPECT_GT(p[2], 0);
  EXPECT_NEAR(p[0], -0.6 * mu * p[2], 1e-9 * p[2]);
  EXPECT_NEAR(p[1], -0.8 * mu * p[2], 1e-9 * p[2]);
}

TEST(SurfaceContact, FrictionFollowsItsLawOfVelocityAndStress) {
  Friction friction(0.3);
  friction.sliding = 0.05, friction.decay_velocity = 400;
  const auto ratio = [&] {
    Pair pair({300, 400, -10});
    const Vec3 p = pair.touch({.friction = friction}).exchange.received(0);
    return std::hypot(p[0], p[1]) / p[2];
  };
  EXPECT_NEAR(ratio(), 0.05 + 0.25 * std::exp(-500.0 / 400), 1e-9);
  // A stress too small to be reached before the cone, on 36 faces of 1 mm^2.
  friction.largest_stress = 10;
  Pair pair({300, 400, -10});
  const Vec3 p = pair.touch({.friction = friction}).exchange.received(0);
  EXPECT_NEAR(std::hypot(p[0], p[1]), 10 * 36e-6 * dt, 1e-6 * 10 * 36e-6 * dt); // a small part of the momenta
}

TEST(SurfaceContact, SticksBelowTheCone) {
  Pair pair({0.3, -0.4, -10});
  pair.touch({.friction = 0.5});
  const SolidContactReport again = pair.touch({.friction = 0.5});
  EXPECT_LT(size(again.exchange.received(0)), 1e-3 * 10 * 36e-3); // there is no sliding left
  Pair slippery({0.3, -0.4, -10});
  const SolidContactReport report = slippery.touch();
  EXPECT_NEAR(report.exchange.received(0)[0], 0, 1e-12 * report.exchange.received(0)[2]);
}

TEST(SurfaceContact, TurnsWithTheBodies) {
  const Mat3 q = rotation(0.7);
  Pair pair({3, -2, -10}), turned({3, -2, -10});
  stir(pair.upper, 1, 1), stir(turned.upper, 1, 1);
  turn(turned.upper, q), turn(turned.lower, q);
  const SolidContactReport a = pair.touch({.friction = 0.3}), b = turned.touch({.friction = 0.3});
  EXPECT_EQ(a.touching, b.touching);
  const Vec3& p = a.exchange.received(0);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(b.exchange.received(0)[c], q[3 * c] * p[0] + q[3 * c + 1] * p[1] + q[3 * c + 2] * p[2],
                1e-3 * size(p));
}

TEST(SurfaceContact, ADeepOverlapIsTakenBackSlowly) {
  const double depth = 0.6e-3, speed = 5;
  Pair pair(Vec3{});
  for (double& z : pair.upper.points.position.component[2]) z -= depth;
  const SolidContactReport report = pair.touch({.release_speed = speed});
  EXPECT_NEAR(report.deepest, depth, 1e-9);
  double fastest = 0;
  for (Body* body : {&pair.upper, &pair.lower})
    for (std::size_t i = 0; i < body->points.owned; ++i)
      fastest = std::max(fastest, size(body->points.velocity[i]));
  EXPECT_GT(fastest, 0.2 * speed);
  EXPECT_LT(fastest, 2 * speed);
  // A shallow overlap is reduced by a fraction of it per step.
  Pair shallow(Vec3{});
  for (double& z : shallow.upper.points.position.component[2]) z -= 1e-6;
  shallow.touch({.overlap_release = 0.1, .release_speed = speed});
  EXPECT_NEAR(shallow.upper.points.velocity[14][2] - shallow.lower.points.velocity[220][2], 0.1 * 1e-6 / dt,
              0.05);
}

TEST(SurfaceContact, LossesAreTheKineticEnergyThatIsGoneWhenNoForceActs) {
  for (const double friction : {0.0, 0.3}) {
    Pair pair({30, 0, -10});
    stir(pair.upper, 3, 1);
    const double before = momentum({&pair.upper, &pair.lower}).kinetic;
    const SolidContactReport report = pair.touch({.friction = friction});
    const double after = momentum({&pair.upper, &pair.lower}).kinetic;
    EXPECT_NEAR(report.normal_loss + report.friction_loss, before - after, 1e-12 * before);
    EXPECT_GT(report.normal_loss, 0);
    if (friction == 0)
      EXPECT_NEAR(report.friction_loss, 0, 1e-15 * before);
    else
      EXPECT_GT(report.friction_loss, 0);
  }
}

TEST(SurfaceContact, AQuarterWithImagesIsTheWhole) {
  Pair whole({2, 2, -10}); // outwards on the positive side, mirrored below
  for (std::size_t i = 0; i < whole.upper.points.owned; ++i) {
    const Vec3 x = whole.upper.points.position[i];
    whole.upper.points.velocity.set(i, {std::copysign(2, x[0]), std::copysign(2, x[1]), -10});
  }
  const SolidContactReport all = whole.touch({.friction = 0.2});
  const auto quarter = [](const Body& body) {
    Body q{Points{}, Ghosts(SymmetryPlanes{{true, true, false}})};
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < body.points.owned; ++i)
      if (body.points.position[i][0] > 0 && body.points.position[i][1] > 0) kept.push_back(i);
    q.points.resize(kept.size());
    for (std::size_t k = 0; k < kept.size(); ++k) {
      q.points.position.set(k, body.points.position[kept[k]]);
      q.points.velocity.set(k, body.points.velocity[kept[k]]);
      q.points.mass[k] = body.points.mass[kept[k]];
      q.points.spacing[k] = body.points.spacing[kept[k]];
    }
    q.ghosts.rebuild(q.points, {4e-3, 4e-3, 0});
    return q;
  };
  Pair fresh({2, 2, -10});
  Body upper = quarter(fresh.upper), lower = quarter(fresh.lower);
  SurfaceContact contact({.friction = 0.2}, all_pairs(2, "surface"));
  const SolidContactReport part = contact.touch({upper.view(), lower.view()}, dt, 0);
  EXPECT_EQ(4 * part.touching, all.touching);
  EXPECT_NEAR(4 * part.exchange.received(0)[2], all.exchange.received(0)[2],
              1e-3 * all.exchange.received(0)[2]);
  EXPECT_NEAR(4 * (part.normal_loss + part.friction_loss), all.normal_loss + all.friction_loss,
              1e-2 * all.normal_loss);
}

TEST(SurfaceContact, ThreadsDoNotChangeABit) {
  const auto run = [](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Pair pair({3, -2, -10});
    stir(pair.upper, 4, 1), stir(pair.lower, 4, 2);
    pair.touch({.friction = 0.3});
    return pair;
  };
  const Pair one = run(1), two = run(2);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(one.upper.points.velocity.component[c], two.upper.points.velocity.component[c]);
    EXPECT_EQ(one.lower.points.velocity.component[c], two.lower.points.velocity.component[c]);
  }
}

TEST(ContactNormal, OfAFlatFaceIsThatOfTheFaceUpToTheRimOfTheBodyAboveIt) {
  Pair pair;
  NearPoints near;
  const Bounds all{{-1, -1, -1}, {1, 1, 1}};
  near.rebuild(pair.lower.view(), all);
  SurfacePatch patch;
  for (std::size_t i = 0; i < pair.upper.points.owned; ++i) {
    const Vec3 x = pair.upper.points.position[i];
    if (x[2] > 1e-3) continue;
    // The search starts from directions up to 30 degrees off, as at the rim of a body.
    for (const double tilt : {0.0, 0.3, 0.5}) {
      ASSERT_TRUE(find_patch(patch, x, near, 0.5, {std::sin(tilt), 0, std::cos(tilt)}));
      EXPECT_NEAR(patch.normal[2], 1, 1e-12);
      EXPECT_NEAR(patch.gap, 0.5e-3, 1e-12);
      double sum = 0;
      Vec3 moment{};
      for (const PatchPoint& p : patch.points) {
        sum += p.weight;
        for (int c = 0; c < 3; ++c) moment[c] += p.weight * pair.lower.points.position[p.index][c];
      }
      EXPECT_NEAR(sum, 1, 1e-13);
      EXPECT_NEAR(moment[0], x[0], 1e-12);
      EXPECT_NEAR(moment[1], x[1], 1e-12);
    }
  }
}

TEST(SurfaceContact, GapsAreMeasuredByTheSpacingInFront) {
  // Cells of 1 mm beside cells of 3 mm, faces at z = 0; a point 2 mm above the face touches neither, but is
  // less than a spacing from the coarse cells.
  Body graded = block({0, 0, -3e-3}, {8, 9, 3}, 1e-3);
  Body coarse = block({8e-3, 0, -9e-3}, {3, 3, 3}, 3e-3);
  std::vector<Vec3> positions;
  for (Body* part : {&graded, &coarse})
    for (std::size_t i = 0; i < part->points.owned; ++i) positions.push_back(part->points.position[i]);
  const std::size_t fine = graded.points.owned;
  graded.points = points_at(positions, 1e-3);
  for (std::size_t i = fine; i < positions.size(); ++i) graded.points.spacing[i] = 3e-3;
  for (const double x : {4.5e-3, 12.5e-3}) {
    Body lone{points_at({{x, 4.5e-3, 2.5e-3}}, 1e-3), Ghosts{}};
    SurfaceContact contact({}, all_pairs(2, "surface"));
    const ContactReport report = contact.measure({lone.view(), graded.view()});
    EXPECT_EQ(report.touching, x > 8e-3 ? 1u : 0u);
    EXPECT_NEAR(report.gap_max, x > 8e-3 ? 2e-3 : 0, 1e-9);
  }
}

} // namespace
} // namespace spall::test
