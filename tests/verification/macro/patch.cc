// Patch tests: a constant stress exerts no force on interior points.

#include "tests/verification/macro/bodies.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

constexpr double spacing = 1e-3;
constexpr int n = 9;

constexpr Sym3 stress = {3e8, -1e8, 2e8, 5e7, -1e8, 4e7};

/// Returns the largest internal force on the points that are `inside`, for a constant stress in a body at
/// rest, in units of stress times spacing^2, the force on one face of a cell.
double patch_error(const J2& material, Points points, Scheme scheme, bool precise,
                   const std::vector<bool>& inside, Correction correction = Correction::none) {
  points.stress.assign(points.owned, stress);
  auto solid =
      make_solid(material, points, SymmetryPlanes{},
                 Numerics{.scheme = scheme, .double_precision = precise, .correction = correction}.solid());
  solid->refresh();
  solid->update(1e-9, 0);
  double most = 0;
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 f = solid->points.force[i];
    if (inside[i]) most = std::max(most, std::sqrt(dot(f, f)) / (stress[0] * spacing * spacing));
  }
  return most;
}

/// Patch error of a jittered block under a homogeneous deformation, at points two supports away from the
/// surface.
double block_error(Scheme scheme, double jitter, const Mat3& map = identity3, bool precise = true,
                   Correction correction = Correction::none) {
  const J2 material = elastic();
  Points points = block(material, n, spacing, jitter);
  std::vector<bool> inside(points.owned, true);
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 x = points.position[i];
    points.position.set(i, {map[0] * x[0] + map[1] * x[1], map[3] * x[0] + map[4] * x[1], map[8] * x[2]});
    points.reference[i] = map;
    for (const std::size_t a : {i % n, i / n % n, i / n / n}) inside[i] = inside[i] && a >= 4 && a < n - 4;
  }
  return patch_error(material, points, scheme, precise, inside, correction);
}

/// Patch error of rings and layers, the layout of most scenes.
double cylinder_error(Scheme scheme, Correction correction = Correction::none) {
  const J2 material = elastic();
  const Points points = fill_cylinder({.radius = 9 * spacing, .height = 12 * spacing},
                                      {9, 12, Boundary::centred}, SymmetryPlanes{}, material.density);
  std::vector<bool> inside(points.owned);
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 x = points.position[i];
    inside[i] = std::hypot(x[0], x[1]) < 5 * spacing && std::abs(x[2] - 6 * spacing) < 2 * spacing;
  }
  return patch_error(material, points, scheme, true, inside, correction);
}

class Patch : public ::testing::TestWithParam<Scheme> {};
INSTANTIATE_TEST_SUITE_P(Schemes, Patch,
                         ::testing::Values(Scheme::nsni, Scheme::snni, Scheme::dni, Scheme::m_snni,
                                           Scheme::subpoint),
                         scheme_label);

TEST_P(Patch, PassesToRoundOffOnALatticeUnderAnyHomogeneousDeformation) {
  const Mat3 sheared = {1.4, 0.3, 0, -0.1, 0.8, 0, 0, 0, 0.9};
  for (const Mat3& map : {identity3, sheared}) {
    EXPECT_LT(block_error(GetParam(), 0, map), 1e-13);
    EXPECT_LT(block_error(GetParam(), 0, map, false), 1e-6);
  }
}

TEST_P(Patch, FailsOnIrregularPointsInProportionToTheirIrregularity) {
  const double small = block_error(GetParam(), 0.05), large = block_error(GetParam(), 0.1),
               rings = cylinder_error(GetParam());
  std::printf(
      "%s: patch error %.3f of a cell's face force with 5 %% jitter, %.3f with 10 %%, %.3f on rings\n",
      name_of(GetParam()), small, large, rings);
  EXPECT_NEAR(large / small, 2, 0.15);
  // Nodal integration without correction does not satisfy the patch test. Smoothing over cells halves the
  // error.
  EXPECT_LT(large, GetParam() == Scheme::snni || GetParam() == Scheme::m_snni ? 0.09 : 0.2);
  EXPECT_GT(large, 0.03);
  EXPECT_LT(rings, 0.5);
}

TEST_P(Patch, PassesOnIrregularPointsWithTheLinearCorrection) {
  const double jittered = block_error(GetParam(), 0.15, identity3, true, Correction::linear),
               rings = cylinder_error(GetParam(), Correction::linear);
  std::printf("%s corrected: %.1e with 15 %% jitter, %.1e on rings\n", name_of(GetParam()), jittered, rings);
  EXPECT_LT(jittered, 1e-7);
  EXPECT_LT(rings, 1e-7);
}

/// Patch error of conforming cells in a body that has been stretched and sheared since its shape functions
/// were made.
double conforming_error(Scheme scheme, Points points, const std::vector<HalfSpace>& outline, bool precise,
                        const std::vector<bool>& inside) {
  const SolidInputs inputs = Numerics{.scheme = scheme, .double_precision = precise}.solid(points, outline);
  auto solid = make_solid(elastic(), points, SymmetryPlanes{}, inputs);
  double most = 0;
  for (int step = 0; step < 3; ++step) {
    solid->refresh();
    const double dt = 1e-6;
    for (std::size_t i = 0; i < points.owned; ++i) {
      const Vec3 x = solid->points.position[i], v = {2e5 * x[0] + 1e5 * x[1], -1e5 * x[1], 5e4 * x[0]};
      solid->points.velocity.set(i, v);
      solid->points.position.set(i, {x[0] + dt * v[0], x[1] + dt * v[1], x[2] + dt * v[2]});
    }
    solid->update(dt, 0); // makes a homogeneous stress
    for (std::size_t i = 0; i < points.owned; ++i) {
      const Vec3 f = solid->points.force[i];
      const double scale = std::abs(solid->points.cauchy(0)[0]) * spacing * spacing;
      if (inside[i]) most = std::max(most, std::sqrt(dot(f, f)) / scale);
    }
  }
  return most;
}

TEST(ConformingPatch, PassesToRoundOffOnIrregularPoints) {
  for (const Scheme scheme : {Scheme::scni, Scheme::m_scni})
    for (const bool precise : {true, false}) {
      const Points points = block(elastic(), n, spacing, 0.2);
      std::vector<bool> inside(points.owned, true);
      for (std::size_t i = 0; i < points.owned; ++i)
        for (const std::size_t a : {i % n, i / n % n, i / n / n})
          inside[i] = inside[i] && a >= 4 && a < n - 4;
      const double jittered = conforming_error(scheme, points, block_outline(n, spacing), precise, inside);

      const Points bar = fill_cylinder({.radius = 9 * spacing, .height = 12 * spacing},
                                       {9, 12, Boundary::centred}, SymmetryPlanes{}, 2700);
      inside.assign(bar.owned, false);
      for (std::size_t i = 0; i < bar.owned; ++i) {
        const Vec3 x = bar.position[i];
        inside[i] = std::hypot(x[0], x[1]) < 5 * spacing && std::abs(x[2] - 6 * spacing) < 2 * spacing;
      }
      const double rings =
          conforming_error(scheme, bar, cylinder_outline(9 * spacing, 0, 12 * spacing), precise, inside);
      std::printf("%s: patch error %.1e with 20 %% jitter, %.1e on rings\n", name_of(scheme), jittered,
                  rings);
      EXPECT_LT(jittered, precise ? 1e-12 : 1e-5);
      EXPECT_LT(rings, precise ? 1e-12 : 1e-5);
    }
}

class Virial : public ::testing::TestWithParam<Scheme> {};
INSTANTIATE_TEST_SUITE_P(Schemes, Virial,
                         ::testing::Values(Scheme::nsni, Scheme::dni, Scheme::snni, Scheme::m_snni,
                                           Scheme::subpoint),
                         scheme_label);

TEST_P(Virial, OfTheForcesIsTheStressTimesThePresentVolume) {
  // sum x f^T = -sum J V sigma holds for any positions, because linear fields are reproduced; here the volume
  // decreases by a third between two refreshes.
  const J2 material = elastic();
  Points points = block(material, 5, spacing, 0.15);
  auto solid = make_solid(material, points, SymmetryPlanes{}, Numerics{.scheme = GetParam()}.solid());
  solid->refresh();
  const double dt = 1e-6;
  for (int step = 0; step < 10; ++step) {
    for (std::size_t i = 0; i < points.owned; ++i) {
      const Vec3 x = solid->points.position[i], v = {-4e4 * x[0] + 1e4 * x[1], 1e4 * x[2], -2e4 * x[2]};
      solid->points.velocity.set(i, v);
      solid->points.position.set(i, {x[0] + dt * v[0], x[1] + dt * v[1], x[2] + dt * v[2]});
    }
    solid->update(dt, step * dt);
  }
  double volume = 0, scale = 0;
  Mat3 virial{}, expected{};
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 x = solid->points.position[i], f = solid->points.force[i];
    const Sym3 s = solid->points.cauchy(i);
    const Mat3 full = {s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]};
    const double now = solid->points.volume[i] * determinant(solid->points.deformation(i));
    volume += now / solid->points.volume[i] / static_cast<double>(points.owned);
    for (int k = 0; k < 9; ++k) {
      virial[k] += x[k / 3] * f[k % 3];
      expected[k] -= now * full[k];
      scale = std::max(scale, std::abs(expected[k]));
    }
  }
  EXPECT_LT(volume, 0.7);
  for (int k = 0; k < 9; ++k) EXPECT_NEAR(virial[k], expected[k], 1e-9 * scale);
}

} // namespace
} // namespace spall::test
