#include "macro/contact/elastic_ring.h"

#include "macro/shape/fill.h"

#include <gtest/gtest.h>

#include <numbers>

namespace spall::test {
namespace {

using std::numbers::pi;

constexpr double radius = 0.5, height = 0.1, density = 2000, area = 2 * pi * radius * height;
const RingInputs steel{
    .present = true, .thickness = 5e-3, .youngs_modulus = 200e9, .yield_stress = 1e12, .density = 8000};
const double middle = radius + 0.5 * steel.thickness, ring_mass = steel.density * steel.thickness * area;

/// The outermost ring of points of a disc without strength, which moves outwards at `speed`.
struct Disc {
  Points points;
  ElasticRing ring;
  double mass = 0, loss = 0;

  explicit Disc(double speed, const RingInputs& inputs = steel)
      : points(fill_cylinder({.radius = radius, .height = height}, {10, 2}, {}, density)),
        ring(inputs, points, radius, area) {
    for (std::size_t i = 0; i < points.owned; ++i) {
      if (!(points.faces[i] & rim_face)) continue;
      const Vec3 x = points.position[i];
      const double r = std::hypot(x[0], x[1]);
      points.velocity.set(i,
                          {speed * x[0] / r, speed * x[1] / r,
                           3}); // the axial velocity is sliding, which the frictionless ring does not affect
      mass += points.mass[i];
    }
  }
  void step(double dt) {
    loss += ring.apply(points, dt, dt);
    for (std::size_t i = 0; i < points.owned; ++i)
      for (int c = 0; c < 3; ++c) points.position.component[c][i] += dt * points.velocity[i][c];
    ring.move(dt);
  }
  /// Mean radial velocity of the rim's points.
  double speed() const {
    double momentum = 0;
    for (std::size_t i = 0; i < points.owned; ++i) {
      const Vec3 x = points.position[i], v = points.velocity[i];
      momentum += points.mass[i] * (x[0] * v[0] + x[1] * v[1]) / std::hypot(x[0], x[1]);
    }
    return momentum / mass;
  }
  double radial_energy() const {
    double energy = 0;
    for (std::size_t i = 0; i < points.owned; ++i) {
      const Vec3 v = points.velocity[i];
      energy += 0.5 * points.mass[i] * (v[0] * v[0] + v[1] * v[1]);
    }
    return energy + ring.kinetic_energy();
  }
};

// For a thin ring sigma = E w / R and the pressure is sigma t / R, so that ring and disc vibrate according to
// (m + M) w'' = -E t A / R^2 w.
TEST(ElasticRing, StopsAndReturnsTheRimLikeASpringWithTheMassOfBoth) {
  const double speed = 10, dt = 1e-7;
  Disc disc(speed);
  const double stiffness = steel.youngs_modulus * steel.thickness * area / (middle * middle);
  const double together =
                   speed * disc.mass / (disc.mass + ring_mass), // after the first touch, which is inelastic
      omega = std::sqrt(stiffness / (disc.mass + ring_mass));
  double largest = 0;
  const double before = disc.radial_energy();
  for (double t = 0; t < 0.98 * pi / omega; t += dt) {
    disc.step(dt);
    largest = std::max(largest, disc.ring.displacement()[0]);
  }
  EXPECT_NEAR(largest, together / omega, 1e-3 * largest);
  EXPECT_NEAR(disc.loss, 0.5 * disc.mass * speed * (speed - together), 1e-3 * disc.loss);
  EXPECT_NEAR(disc.radial_energy() + disc.ring.work() + disc.loss, before, 1e-3 * before);
  // Then the disc leaves the ring, which continues to vibrate alone.
  for (double t = 0; t < 0.3 * pi / omega; t += dt) disc.step(dt);
  EXPECT_NEAR(disc.speed(), -together, 2e-3 * together);
}

TEST(ElasticRing, YieldsAtItsHoopStressAndStaysWidened) {
  RingInputs soft = steel;
  soft.yield_stress = 20e6;
  const double speed = 10, dt = 1e-6;
  Disc disc(speed, soft);
  const double energy =
      0.5 * (disc.mass + ring_mass) * std::pow(speed * disc.mass / (disc.mass + ring_mass), 2);
  const double force = soft.yield_stress * soft.thickness / middle * area,
               at_yield = soft.yield_stress / soft.youngs_modulus * middle;
  double largest = 0;
  while (disc.speed() > 0) {
    disc.step(dt);
    largest = std::max(largest, disc.ring.displacement()[0]);
  }
  EXPECT_NEAR(force * (largest - 0.5 * at_yield), energy, 2e-3 * energy);
  EXPECT_NEAR(disc.ring.hoop_stress()[0], soft.yield_stress, 1e-4 * soft.yield_stress);
  EXPECT_GT(largest, 10 * at_yield);
}

TEST(ElasticRing, DoesNotPull) {
  Disc disc(-10);
  for (int n = 0; n < 1000; ++n) disc.step(1e-7);
  EXPECT_NEAR(disc.speed(), -10, 1e-12);
  EXPECT_EQ(disc.ring.kinetic_energy(), 0);
  EXPECT_EQ(disc.loss, 0);
}

} // namespace
} // namespace spall::test
