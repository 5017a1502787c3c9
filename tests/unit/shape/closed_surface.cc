// Surfaces of triangles from files: the body is the one that the triangles bound, and bad files are refused.

#include "macro/shape/closed_surface.h"

#include "macro/shape/fill.h"
#include "macro/shape/projectile.h"
#include "macro/shape/shape.h"
#include "tests/unit/points/clouds.h"
#include "tests/unit/shape/samples.h"
#include "tests/unit/shape/stl.h"
#include "tests/unit/shared/scratch_folder.h"

namespace spall::test::of_triangles {
namespace {

constexpr double mm = 1e-3, pi = std::numbers::pi;

/// A projectile with an ogive, as triangles about as long as a part of a turn about its shaft.
Contour ogive() { return with({.kind = NoseKind::ogive, .caliber_radius_head = 3}).contour(); }
Triangles facets(const Contour& contour, int around) {
  return turned_surface(contour.outline(2 * pi * 0.025 / around), around);
}
/// A block between two corners.
Triangles box(const Vec3& low, const Vec3& high) {
  Triangles surface = triangles_of(Block{.width = 1, .depth = 1, .height = 1});
  for (Vec3& x : surface.points)
    for (int c = 0; c < 3; ++c) x[c] = (x[c] > (c < 2 ? 0 : 0.5)) ? high[c] : low[c];
  return surface;
}
Triangles both(Triangles a, const Triangles& b) {
  const auto shift = static_cast<std::int64_t>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const auto& corners : b.corners)
    a.corners.push_back({corners[0] + shift, corners[1] + shift, corners[2] + shift});
  return a;
}
Triangles inside_out(Triangles surface) {
  for (auto& corners : surface.corners) std::swap(corners[0], corners[1]);
  return surface;
}

TEST(ClosedSurface, IsTheSameFromTextAndBinaryFilesInEveryUnit) {
  const ScratchFolder folder;
  const Triangles triangles = facets(ogive(), 24);
  const double volume = ClosedSurface(triangles).mass_properties().volume;
  for (const double unit : {1., 1e-2, mm, 25.4 * mm})
    for (const bool binary : {false, true}) {
      write_stl(folder / "a.stl", triangles, unit, binary);
      const ClosedSurface read = ClosedSurface::read(folder / "a.stl", unit);
      EXPECT_EQ(read.triangles().points.size(), triangles.points.size());
      EXPECT_EQ(read.triangles().corners.size(), triangles.corners.size());
      EXPECT_NEAR(read.mass_properties().volume, volume, (binary ? 1e-6 : 1e-12) * volume);
      EXPECT_FALSE(read.was_turned());
    }
}

/// A ball with its middle at 0, of facets of a turn / n either way.
ClosedSurface ball(double radius, int n) {
  std::vector<ContourPoint> outline;
  for (int i = 0; i <= n / 2; ++i)
    outline.push_back(
        {radius * std::cos(2 * pi * i / n), i == n / 2 ? 0 : radius * std::sin(2 * pi * i / n)});
  return ClosedSurface(turned_surface(outline, n));
}

// Facets leave differences of second order in 1 / n.
TEST(ClosedSurface, ConvergesToTheBallWithItsFacets) {
  const double r = 0.025;
  std::array<double, 2> volume, moment, distance{};
  for (const int k : {0, 1}) {
    const ClosedSurface surface = ball(r, 48 << k);
    const MassProperties& p = surface.mass_properties();
    volume[k] = 1 - p.volume / (4 * pi / 3 * r * r * r);
    moment[k] = 1 - p.moments[2] / (0.4 * r * r);
    EXPECT_LT(norm(p.centre), 1e-12);
    EXPECT_EQ(p.axes.w, 1) << "round bodies keep their axes";
    for (const Vec3& x : random_cloud(1000, {-r, -r, -r}, {r, r, r}))
      distance[k] = std::max(distance[k], std::abs(surface.surface(x).distance - (norm(x) - r)));
  }
  EXPECT_NEAR(volume[0] / volume[1], 4, 0.05);
  EXPECT_NEAR(moment[0] / moment[1], 4, 0.05);
  EXPECT_GT(distance[0], 3 * distance[1]);
  EXPECT_LT(volume[1], 4e-3);
  EXPECT_LT(distance[1], 2 * 5 / (96. * 96) * r) << "5 / n^2 either way";
}

TEST(ClosedSurface, OfAnOgiveHasItsMassPropertiesAndDistances) {
  const Contour contour = ogive();
  const Shape exact = Revolution{.outer = contour};
  const MassProperties whole = mass_properties(exact);
  const ClosedSurface surface(facets(contour, 96));
  const MassProperties& p = surface.mass_properties();
  EXPECT_NEAR(p.volume, whole.volume, 2e-3 * whole.volume);
  EXPECT_LT(norm(p.centre - whole.centre), 1e-3 * 0.025);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(p.moments[c], whole.moments[c], 3e-3 * whole.moments[c]);
  for (const Vec3& x : random_cloud(1000, {-0.04, -0.04, -0.22}, {0.04, 0.04, 0.02}))
    EXPECT_NEAR(surface.surface(x).distance, spall::surface(exact, x).distance, 2 * 5 / (96. * 96) * 0.025);
}

TEST(ClosedSurface, HasTheInertiaOfABlockThatLiesAskew) {
  const Block block{.width = 0.1, .depth = 0.03, .height = 0.05};
  const Quaternion turn = about_axis(0, 0.3) * about_axis(2, -0.5) * about_axis(1, 0.2);
  const Mat3 axes = matrix_of(turn);
  const Vec3 shift = {0.4, -0.2, 0.1};
  Triangles askew = triangles_of(block);
  for (Vec3& x : askew.points) x = shift + times(axes, x);
  const MassProperties p = ClosedSurface(askew).mass_properties(), own = block.mass_properties();
  EXPECT_NEAR(p.volume, own.volume, 1e-12 * own.volume);
  EXPECT_NEAR(norm(p.centre - (shift + times(axes, own.centre))), 0, 1e-15);
  // The tensor about the centre, from its moments and axes.
  const Mat3 principal = matrix_of(p.axes);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double found = 0, expected = 0;
      for (int k = 0; k < 3; ++k) {
        found += principal[3 * i + k] * p.moments[k] * principal[3 * j + k];
        expected += axes[3 * i + k] * own.moments[k] * axes[3 * j + k];
      }
      EXPECT_NEAR(found, expected, 1e-15) << i << j;
    }
}

TEST(ClosedSurface, TheLowerBoundIsOneAndIsNearTheDistance) {
  const ClosedSurface surface(facets(ogive(), 48));
  double slack = 0;
  for (const Vec3& x : random_cloud(5000, {-0.1, -0.1, -0.3}, {0.1, 0.1, 0.1})) {
    const double distance = surface.surface(x).distance, bound = surface.lower_bound(x);
    ASSERT_LE(bound, distance + 1e-15);
    slack = std::max(slack, distance - bound);
  }
  EXPECT_LT(slack, 0.04);
  EXPECT_TRUE(std::isinf(surface.lower_bound({std::nan(""), 0, 0})));
}

TEST(ClosedSurface, ItsOutlineIsThatOfTheRoundBody) {
  const Contour contour = ogive();
  for (const auto& [z, r] : ClosedSurface(facets(contour, 96)).outline())
    if (z > -0.199 && z < -1e-6) {
      EXPECT_NEAR(r, contour.section_radius(z), 0.02 * mm);
    }
}

TEST(ClosedSurface, ABodyWithACavityIsHollowHoweverItsPartsAreTurned) {
  const Vec3 large = {0.1, 0.1, 0.1}, small = {0.05, 0.05, 0.05};
  const Triangles outer = box(-large, large), inner = box(-small, small);
  const ScratchFolder folder;
  for (const bool turned : {true, false}) {
    write_stl(folder / "hollow.stl", both(outer, turned ? inside_out(inner) : inner), 1);
    const ClosedSurface hollow = ClosedSurface::read(folder / "hollow.stl", 1);
    EXPECT_NEAR(hollow.mass_properties().volume, 7e-3, 1e-12);
    EXPECT_NEAR(hollow.surface({0, 0, 0}).distance, 0.05, 1e-12);
    EXPECT_NEAR(hollow.surface({0.07, 0, 0}).distance, -0.02, 1e-12);
    EXPECT_EQ(hollow.was_turned(), !turned);
  }
}

TEST(ClosedSurface, OneThatIsInsideOutIsTurnedRound) {
  const ScratchFolder folder;
  write_stl(folder / "out.stl", inside_out(facets(ogive(), 24)), mm);
  const ClosedSurface read = ClosedSurface::read(folder / "out.stl", mm);
  EXPECT_TRUE(read.was_turned());
  EXPECT_GT(read.mass_properties().volume, 0);
  EXPECT_LT(read.surface({0, 0, -0.1}).distance, 0);
}

TEST(ClosedSurface, BadFilesAreRefusedInOneLine) {
  const ScratchFolder folder;
  const auto said = [&](const std::string& words) {
    const std::string message = message_of<InputError>([&] { ClosedSurface::read(folder / "bad.stl", mm); });
    expect_one_line_with(message, {"bad.stl", words});
  };
  const auto refused = [&](const Triangles& surface, const std::string& words) {
    write_stl(folder / "bad.stl", surface, mm);
    said(words);
  };
  said("cannot be opened"); // there is none
  folder.write("bad.stl", "z,r\n0,0\n-0.2,0.1\n-0.2,0\n");
  said("no triangles");
  folder.write("bad.stl", "");
  said("no triangles");
  folder.write("bad.stl", "solid nothing\nendsolid nothing\n");
  said("no triangles");
  write_stl(folder / "whole.stl", facets(ogive(), 24), mm, true);
  folder.write("bad.stl", read_text(folder / "whole.stl").substr(0, 1000));
  said("not a whole STL file");
  const Triangles block = box({0, 0, 0}, {1, 1, 1});
  Triangles open = block;
  open.corners.pop_back();
  refused(open, "not closed: 3 edges");
  refused(both(block, box({0.5, 0.5, 0.5}, {2, 2, 2})), "intersects itself");
  refused(both(block, box({1, 1, 0}, {2, 2, 1})), "more than two triangles meet at an edge");
  Triangles flat = block;
  flat.points.push_back(flat.points[flat.corners[0][0]] +
                        0.5 * (flat.points[flat.corners[0][1]] - flat.points[flat.corners[0][0]]));
  flat.corners.push_back({flat.corners[0][0], 8, flat.corners[0][1]});
  refused(flat, "1 triangles without area");
}

TEST(FillSurface, CellsThatTheSurfaceCutsMakeUpTheVolume) {
  const ClosedSurface round = ball(0.05, 96);
  for (const double spacing : {10 * mm, 5 * mm}) {
    const Points p = fill_surface(round, {.spacing = spacing}, {}, 3);
    double volume = 0;
    Vec3 first{}, second{};
    for (std::size_t i = 0; i < p.owned; ++i) {
      const Vec3 x = p.position[i] - round.mass_properties().centre;
      volume += p.volume[i], first += p.volume[i] * x;
      for (int c = 0; c < 3; ++c) second[c] += p.volume[i] * (dot(x, x) - x[c] * x[c]);
      EXPECT_LT(norm(x), 0.05);
      EXPECT_LT(p.volume[i], 1.3 * std::pow(p.spacing[i], 3));
    }
    const MassProperties& whole = round.mass_properties();
    EXPECT_NEAR(volume, whole.volume, 1e-12 * volume);
    EXPECT_LT(norm(first), 1e-6 * volume);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(second[c] / volume / whole.moments[c], 1, 0.02) << spacing;
    EXPECT_EQ(4 * fill_surface(round, {.spacing = spacing}, {{true, true, false}}, 3).owned, p.owned);
  }
}

TEST(FillSurface, ASpacingThatMissesTheBodyIsRefused) {
  // A shell of 10 mm, which falls between the points.
  const ClosedSurface shell(both(box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}),
                                 inside_out(box({-0.09, -0.09, -0.09}, {0.09, 0.09, 0.09}))));
  EXPECT_THROW(fill_surface(shell, {.spacing = 0.04}, {}, 1), std::invalid_argument);
  EXPECT_NO_THROW(fill_surface(shell, {.spacing = 0.01}, {}, 1));
  EXPECT_THROW(fill_surface(ball(0.05, 24), {.spacing = 0.02}, {.axis = true}, 1), std::invalid_argument);
}

} // namespace
} // namespace spall::test::of_triangles
