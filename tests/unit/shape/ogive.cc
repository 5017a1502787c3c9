#include "macro/shape/projectile.h"

#include "tests/unit/points/clouds.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace spall::test {
namespace {

/// The projectile of the slab, with a calibre radius head of 3.
const TangentOgive ogive{.radius = 0.0254, .length = 0.3556, .arc_radius = 6 * 0.0254};
const Contour body = ogive.contour();

/// Returns the radius of the nose at depth z <= 0 below the tip: an arc through tip and shoulder, tangent to
/// the shaft.
double profile(const TangentOgive& o, double z) {
  const double above = z + o.nose_length();
  return above <= 0 ? o.radius
                    : std::sqrt(o.arc_radius * o.arc_radius - above * above) + o.radius - o.arc_radius;
}

/// Returns the distance to the surface from dense samples of the generating curve (nose, side, tail disc).
double sampled_distance(const TangentOgive& o, double r, double z) {
  double nearest = std::numeric_limits<double>::max();
  const int n = 20000;
  for (int i = 0; i <= n; ++i) {
    const double s = -o.length * i / n, q = o.radius * i / n;
    nearest = std::min({nearest, std::hypot(r - profile(o, s), z - s), std::hypot(r - q, z + o.length)});
  }
  const bool inside = z < 0 && z > -o.length && r < profile(o, z);
  return inside ? -nearest : nearest;
}

TEST(Ogive, HasTheKnownNoseLengthTipAndShoulder) {
  EXPECT_NEAR(ogive.nose_length(), 84.2e-3, 0.1e-3);
  // A calibre radius head of 0.5 is a hemisphere.
  EXPECT_DOUBLE_EQ((TangentOgive{.radius = 1, .length = 5, .arc_radius = 1}.nose_length()), 1);
  EXPECT_NEAR(body.surface({0, 0, 0}).distance, 0, 1e-15);
  EXPECT_NEAR(body.surface({ogive.radius, 0, -ogive.nose_length()}).distance, 0, 1e-15);
  const double z = -0.3 * ogive.nose_length();
  EXPECT_NEAR(body.surface({0, profile(ogive, z), z}).distance, 0, 1e-15);
}

TEST(Ogive, DistancesAtPointsOfKnownAnswer) {
  const auto d = [](double r, double z) { return body.surface({0.6 * r, 0.8 * r, z}).distance; };
  EXPECT_NEAR(d(0, 0.05), 0.05, 1e-15);                                   // ahead of the tip
  EXPECT_NEAR(d(ogive.radius + 0.01, -0.2), 0.01, 1e-15);                 // beside the body
  EXPECT_NEAR(d(ogive.radius - 0.002, -0.2), -0.002, 1e-15);              // inside, near the side
  EXPECT_NEAR(d(0.01, -ogive.length - 0.03), 0.03, 1e-15);                // behind the tail
  EXPECT_NEAR(d(ogive.radius + 0.03, -ogive.length - 0.04), 0.05, 1e-15); // off the tail's edge
  EXPECT_NEAR(d(0, -ogive.length + 0.001), -0.001, 1e-15);                // inside, near the tail
  EXPECT_NEAR(d(ogive.radius + 0.01, -ogive.nose_length()), 0.01, 1e-15); // at the shoulder
}

TEST(Ogive, DistanceIsThatToTheNearestPointOfTheSurface) {
  for (const Vec3& x : random_cloud(60, {-0.06, -0.06, -0.42}, {0.06, 0.06, 0.08})) {
    const double r = std::hypot(x[0], x[1]), expected = sampled_distance(ogive, r, x[2]);
    // Deep inside the nearest surface may lie on the other side of the shoulder or at the tail. Only the
    // region that contact can reach, a shell of a third of the radius, has to be exact.
    if (expected < -ogive.radius / 3) continue;
    EXPECT_NEAR(body.surface(x).distance, expected, 2e-5) << r << " " << x[2];
  }
}

TEST(Ogive, TheNormalIsTheGradientOfTheDistanceAndOfUnitLength) {
  const double h = 1e-7;
  int compared = 0;
  for (const Vec3& x : random_cloud(400, {-0.06, -0.06, -0.42}, {0.06, 0.06, 0.08})) {
    const SurfacePoint at = body.surface(x);
    EXPECT_NEAR(dot(at.normal, at.normal), 1, 1e-12);
    if (at.distance < -ogive.radius / 3) continue; // beyond the ridge of the distance inside
    ++compared;
    for (int c = 0; c < 3; ++c) {
      Vec3 ahead = x, behind = x;
      ahead[c] += h, behind[c] -= h;
      EXPECT_NEAR(at.normal[c], (body.surface(ahead).distance - body.surface(behind).distance) / (2 * h),
                  1e-5);
    }
  }
  EXPECT_GT(compared, 300);
}

TEST(Ogive, IsContinuousAcrossTheShoulderAndTheNormalConeOfTheTip) {
  const double e = 1e-9, n = ogive.nose_length();
  for (const double r : {0.02, 0.0254, 0.03}) {
    const SurfacePoint a = body.surface({r, 0, -n + e}), b = body.surface({r, 0, -n - e});
    EXPECT_NEAR(a.distance, b.distance, 1e-8);
    EXPECT_NEAR(a.normal[0], b.normal[0], 1e-6);
  }
  const double slope = (ogive.arc_radius - ogive.radius) / n; // slope dz / dr of the cone's generator
  for (const double r : {0.001, 0.01, 0.05}) {
    const SurfacePoint a = body.surface({r, 0, slope * r + e}), b = body.surface({r, 0, slope * r - e});
    EXPECT_NEAR(a.distance, b.distance, 1e-8);
    EXPECT_NEAR(a.normal[2], b.normal[2], 1e-5);
  }
}

TEST(Ogive, OnTheAxisTheNormalIsStillAUnitVector) {
  for (const double z : {0.1, 0.0, -0.01, -0.08, -0.2, -0.3556, -0.4}) {
    const SurfacePoint at = body.surface({0, 0, z});
    EXPECT_TRUE(std::isfinite(at.distance));
    EXPECT_NEAR(dot(at.normal, at.normal), 1, 1e-12) << z;
  }
}

TEST(Ogive, ItsExtentIsThatOfItsSurface) {
  for (double angle = 0.05; angle < 3.1; angle += 0.1) {
    const Vec3 direction = {std::sin(angle), 0, std::cos(angle)};
    double largest = -1;
    for (double z = -ogive.length; z <= 0; z += 1e-5)
      largest = std::max(largest, body.section_radius(z) * direction[0] + z * direction[2]);
    EXPECT_NEAR(body.extent(direction), largest, 1e-5) << angle;
  }
}

TEST(Ogive, HoldsItsCasingAndItsFiller) {
  // The density in the paper and the mass give 208 cm3 of steel and a cavity of 435 cm3.
  EXPECT_NEAR(body.mass_properties().volume, 643e-6, 1e-6);
}

} // namespace
} // namespace spall::test
