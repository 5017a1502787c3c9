// Tests that values at places inside a body, and forces there, belong to linear fields and keep momentum.

#include "macro/reinforcement/point_interpolation.h"
#include "tests/unit/points/clouds.h"
#include "tests/unit/reinforcement/bars.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

constexpr double spacing = 10e-3, support = 1.9 * spacing;
/// Wendland's function is more peaked, so that it needs a larger support.
double support_of(Profile profile) { return (profile == Profile::cubic_spline ? 1.9 : 2.3) * spacing; }

VectorField fields_of(const std::vector<Vec3>& list) {
  VectorField field;
  field.resize(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) field.set(i, list[i]);
  return field;
}

/// Places inside a block of 8 x 8 x 8 points, its faces included.
std::vector<Vec3> places_in_block() { return random_cloud(60, {0, 0, 0}, {80e-3, 80e-3, 80e-3}, 5); }

class Interpolation : public ::testing::TestWithParam<Profile> {};
INSTANTIATE_TEST_SUITE_P(Profiles, Interpolation,
                         ::testing::Values(Profile::cubic_spline, Profile::wendland_c4));

TEST_P(Interpolation, IsExactForLinearFieldsOnIrregularPoints) {
  const Points points = points_at(jittered_lattice(8, spacing, 0.3), spacing);
  const std::vector<Vec3> at = places_in_block();
  PointInterpolation inside(std::vector<double>(at.size(), support_of(GetParam())), GetParam(), {}, {});
  inside.evaluate(fields_of(at), points);
  const auto linear = [](const Vec3& x) {
    return Vec3{1 + 2 * x[0] - x[2], 4 * x[1] + x[0], 3 - 5 * x[2] + x[1]};
  };
  std::vector<Vec3> values, nodes(points.owned);
  for (std::size_t i = 0; i < points.owned; ++i) nodes[i] = linear(points.position[i]);
  inside.interpolate(fields_of(nodes), values);
  std::size_t held = 0;
  for (std::size_t k = 0; k < at.size(); ++k) {
    if (!inside.held(k)) continue;
    ++held;
    EXPECT_LT(norm(values[k] - linear(at[k])), 1e-12);
  }
  EXPECT_GT(held, 55u); // not at corners that the jitter has laid bare
}

TEST_P(Interpolation, GivesForcesToThePointsWithTheirSumAndTheirMoment) {
  Points points = points_at(jittered_lattice(8, spacing, 0.3), spacing);
  const std::vector<Vec3> at = places_in_block(), forces = random_cloud(60, {-1, -1, -1}, {1, 1, 1}, 9);
  PointInterpolation inside(std::vector<double>(at.size(), support_of(GetParam())), GetParam(), {}, {});
  inside.evaluate(fields_of(at), points);
  inside.distribute(forces, points.force);
  MomentumSums given, got;
  got.add(points, points.force, false);
  for (std::size_t k = 0; k < at.size(); ++k)
    if (inside.held(k)) given.linear += forces[k], given.angular += cross(at[k], forces[k]);
  EXPECT_LT(norm(got.linear - given.linear), 1e-12 * got.size);
  EXPECT_LT(norm(got.angular - given.angular), 1e-12 * got.angular_size);
}

TEST(PointInterpolation, HoldsNothingWhereThereAreNoPointsOrOnlyOnOneSide) {
  const Points points = points_at(jittered_lattice(8, spacing, 0), spacing);
  const std::vector<Vec3> at = {{40e-3, 40e-3, 40e-3}, {40e-3, 40e-3, 0}, {40e-3, 40e-3, -13e-3}, {1, 1, 1}};
  PointInterpolation inside(std::vector<double>(at.size(), support), Profile::cubic_spline, {}, {});
  inside.evaluate(fields_of(at), points);
  EXPECT_TRUE(inside.held(0));
  EXPECT_TRUE(inside.held(1)); // on a face
  EXPECT_FALSE(inside.held(2));
  EXPECT_FALSE(inside.held(3));
}

TEST(PointInterpolation, APlaneOfSymmetryStandsForTheMirroredPoints) {
  const std::vector<Vec3> lattice = jittered_lattice(6, spacing, 0);
  std::vector<Vec3> both = lattice;
  for (Vec3 x : lattice) x[0] = -x[0], both.push_back(x);
  Points half = points_at(lattice, spacing), whole = points_at(both, spacing);
  const std::vector<Vec3> at = {{0, 30e-3, 30e-3}, {4e-3, 22e-3, 30e-3}},
                          and_images = {{0, 30e-3, 30e-3}, {4e-3, 22e-3, 30e-3}, {-4e-3, 22e-3, 30e-3}};
  SymmetryPlanes planes;
  planes.normal[0] = true;
  PointInterpolation in_half({support, support}, Profile::cubic_spline, planes, {}),
      in_whole({support, support, support}, Profile::cubic_spline, {}, {});
  in_half.evaluate(fields_of(at), half), in_whole.evaluate(fields_of(and_images), whole);
  // The node in the plane has half of its force in the half model.
  in_half.distribute({{0, 1, 2}, {3, 4, 5}}, half.force);
  in_whole.distribute({{0, 2, 4}, {3, 4, 5}, {-3, 4, 5}}, whole.force);
  for (std::size_t i = 0; i < half.owned; ++i) EXPECT_LT(norm(half.force[i] - whole.force[i]), 1e-12) << i;
}

TEST(PointInterpolation, DoesNotDependOnWhenTheNearPointsWereFound) {
  Points points = points_at(jittered_lattice(8, spacing, 0.3), spacing);
  const std::vector<Vec3> at = places_in_block();
  PointInterpolation old(std::vector<double>(at.size(), support), Profile::cubic_spline, {}, {}), fresh = old;
  old.evaluate(fields_of(at), points);
  for (std::size_t i = 0; i < points.owned; ++i)
    points.position.set(i,
                        points.position[i] + 2e-3 * std::sin(300 * points.position[i][1]) * Vec3{1, 1, -1});
  old.moved(2 * 2e-3 * std::sqrt(3)); // less than the margin
  old.evaluate(fields_of(at), points), fresh.evaluate(fields_of(at), points);
  std::vector<Vec3> a, b;
  old.interpolate(points.position, a), fresh.interpolate(points.position, b);
  EXPECT_EQ(a, b);
}

} // namespace
} // namespace spall::test
