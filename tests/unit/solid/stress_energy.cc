// Tests of the work of the stresses by parts, and of the stored part of it.

#include "macro/material/j2.h"
#include "macro/shape/fill.h"
#include "macro/solid/solid.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

struct Energies {
  StressEnergy work, elastic;
};

/// Deforms a block of elastic, perfectly plastic metal by x = (1 + t L) X, with t from 0 to 1.
Energies deform(const Mat3& gradient, Scheme scheme, double yield = 1e12, int steps = 50) {
  const J2 metal{.youngs_modulus = 80e9,
                 .poisson_ratio = 0.3,
                 .initial_yield = yield,
                 .hardening_modulus = 0,
                 .density = 2700};
  SolidInputs numerics;
  numerics.integration.scheme = scheme;
  const auto solid = make_solid(
      metal, fill_cylinder({.radius = 4e-3, .height = 8e-3}, {4, 8, Boundary::centred}, {}, metal.density),
      {}, numerics);
  Points& points = solid->points;
  solid->refresh();
  Energies sum;
  const double dt = 1.0 / steps;
  for (int step = 1; step <= steps; ++step) {
    for (std::size_t i = 0; i < points.owned; ++i) {
      const Vec3 x = points.initial_position[i];
      Vec3 v;
      for (int c = 0; c < 3; ++c)
        v[c] = gradient[3 * c] * x[0] + gradient[3 * c + 1] * x[1] + gradient[3 * c + 2] * x[2];
      points.velocity.set(i, v);
      for (int c = 0; c < 3; ++c) points.position.component[c][i] = x[c] + step * dt * v[c];
    }
    sum.work += solid->update(dt, step * dt).work;
  }
  sum.elastic = solid->elastic_energy();
  return sum;
}

constexpr double e = 1e-3;
constexpr Mat3 squeeze = {-e, 0, 0, 0, -e, 0, 0, 0, -e}, swell = {e, 0, 0, 0, e, 0, 0, 0, e},
               shear = {0, e, 0, 0, 0, 0, 0, 0, 0}, crush = {e, 0, 0, 0, 0, 0, 0, 0, -3 * e};

TEST(StressEnergy, AnElasticBodyStoresAllWorkOfEveryPart) {
  for (const Scheme scheme : {Scheme::nsni, Scheme::dni, Scheme::subpoint})
    for (const Mat3& gradient : {squeeze, swell, shear, crush}) {
      const auto [work, elastic] = deform(gradient, scheme);
      const double tolerance = 5 * e * work.total; // the relative changes of volume are of the order of e
      EXPECT_NEAR(elastic.total, work.total, tolerance);
      EXPECT_NEAR(elastic.compression, work.compression, tolerance);
      EXPECT_NEAR(elastic.tension, work.tension, tolerance);
    }
}

TEST(StressEnergy, PartsAreThoseOfTheDeformation) {
  const double tolerance = 1e-5;
  for (const Scheme scheme : {Scheme::nsni, Scheme::subpoint}) {
    const StressEnergy pressed = deform(squeeze, scheme).work, pulled = deform(swell, scheme).work,
                       sheared = deform(shear, scheme).work;
    EXPECT_NEAR(pressed.compression / pressed.total, 1, tolerance);
    EXPECT_EQ(pressed.tension, 0);
    EXPECT_NEAR(pulled.tension / pulled.total, 1, tolerance);
    EXPECT_EQ(pulled.compression, 0);
    EXPECT_NEAR(sheared.shear() / sheared.total, 1, tolerance);
    // Closed forms: K (3 e)^2 / 2 and G e^2 / 2 per volume.
    const double volume = 3.14159265358979 * 16e-6 * 8e-3, bulk = 80e9 / 1.2, modulus = 80e9 / 2.6;
    EXPECT_NEAR(pressed.total / (volume * 4.5 * bulk * e * e), 1, 5 * e);
    EXPECT_NEAR(sheared.total / (volume * 0.5 * modulus * e * e), 1, 5 * e);
  }
}

TEST(StressEnergy, OfPlasticFlowOnlyTheElasticPartIsStored) {
  const double yield = 20e6, modulus = 80e9 / 2.6;
  const auto [work, elastic] = deform(shear, Scheme::nsni, yield);
  const double volume = 3.14159265358979 * 16e-6 * 8e-3, limit = yield / std::sqrt(3.0);
  EXPECT_NEAR(elastic.total / (volume * limit * limit / (2 * modulus)), 1, 0.01);
  // the work is tau e less the triangle before yielding
  EXPECT_NEAR(work.shear() / (volume * limit * (e - 0.5 * limit / modulus)), 1, 0.01);
}

} // namespace
} // namespace spall::test
