#include "macro/shape/fill.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <ostream>
#include <set>

namespace spall {

/// Prints a filling in the messages of failed tests.
inline void PrintTo(const Filling& f, std::ostream* out) {
  *out << f.rings << " rings, " << f.layers << " layers, "
       << (f.layout == Layout::polar ? "polar" : "lattice") << (f.grading.used() ? ", graded" : "")
       << (f.boundary == Boundary::centred ? ", centred" : ", on surface");
}

} // namespace spall

namespace spall::test {
namespace {

constexpr Cylinder cylinder{.radius = 0.05, .height = 0.08, .bottom = 0.01};
constexpr double density = 2700;
constexpr Boundary boundaries[] = {Boundary::centred, Boundary::on_surface};
constexpr Grading grading{.fine_spacing = 3e-3, .fine_radius = 12e-3, .coarse_spacing = 8e-3, .growth = 1.2};

Points fill(int rings, int layers, Boundary boundary, const SymmetryPlanes& planes = {}) {
  return fill_cylinder(cylinder, {rings, layers, boundary}, planes, density);
}

/// All kinds of filling, coarse and fine.
class EveryFilling : public ::testing::TestWithParam<Filling> {
protected:
  Points points(const SymmetryPlanes& planes = {}) const {
    return fill_cylinder(cylinder, GetParam(), planes, density);
  }
};
std::vector<Filling> fillings() {
  std::vector<Filling> all;
  for (const Boundary boundary : boundaries) {
    for (const auto& [rings, layers] : {std::pair(1, 2), {2, 3}, {6, 5}, {11, 4}})
      for (const Layout layout : {Layout::polar, Layout::lattice})
        all.push_back({rings, layers, boundary, layout});
    all.push_back({.boundary = boundary, .grading = grading});
    all.push_back(
        {.boundary = boundary,
         .grading = {.fine_spacing = 5e-3, .fine_radius = 0, .coarse_spacing = 30e-3, .growth = 1.7}});
  }
  return all;
}
INSTANTIATE_TEST_SUITE_P(Fillings, EveryFilling, ::testing::ValuesIn(fillings()),
                         [](const auto& instance) { return std::to_string(instance.index); });

/// Position to a nanometre and volume to a part in 10^9, by which sets of points are compared.
using Key = std::array<long long, 4>;
Key key(const Vec3& x, double volume) {
  const double cell = std::numbers::pi * cylinder.radius * cylinder.radius * cylinder.height;
  return {std::llround(x[0] * 1e9), std::llround(x[1] * 1e9), std::llround(x[2] * 1e9),
          std::llround(volume / cell * 1e9)};
}
std::multiset<Key> keys(const Points& points) {
  std::multiset<Key> all;
  for (std::size_t i = 0; i < points.owned; ++i) all.insert(key(points.position[i], points.volume[i]));
  return all;
}

TEST_P(EveryFilling, VolumesAndMassesAddUpExactly) {
  const double whole = std::numbers::pi * cylinder.radius * cylinder.radius * cylinder.height;
  for (const SymmetryPlanes planes : {SymmetryPlanes{}, {{true, false, false}}, {{true, true, false}}}) {
    const Points p = points(planes);
    double volume = 0, mass = 0;
    for (std::size_t i = 0; i < p.owned; ++i) volume += p.volume[i], mass += p.mass[i];
    const double part = whole / planes.multiplicity();
    EXPECT_NEAR(volume, part, 1e-12 * part);
    EXPECT_NEAR(mass, density * part, 1e-12 * density * part);
  }
}

TEST_P(EveryFilling, IsSymmetricAboutBothPlanesWithNoPointOnThem) {
  const Points p = points();
  const auto all = keys(p);
  for (std::size_t i = 0; i < p.owned; ++i) {
    const Vec3 x = p.position[i];
    EXPECT_EQ(all.count(key({-x[0], x[1], x[2]}, p.volume[i])), 1u);
    EXPECT_EQ(all.count(key({x[0], -x[1], x[2]}, p.volume[i])), 1u);
    EXPECT_GT(std::min(std::abs(x[0]), std::abs(x[1])), 0.1 * p.spacing[i]);
  }
}

TEST_P(EveryFilling, AQuarterIsThatPartOfTheWhole) {
  const Points full = points(), quarter = points({{true, true, false}});
  ASSERT_EQ(4 * quarter.owned, full.owned);
  const auto all = keys(full);
  for (const Key& k : keys(quarter)) {
    EXPECT_EQ(all.count(k), 1u);
    EXPECT_GT(k[0], 0);
    EXPECT_GT(k[1], 0);
  }
}

TEST_P(EveryFilling, CentreOfMassIsOnTheAxisAtHalfHeight) {
  const Points p = points();
  Vec3 moment{};
  double mass = 0;
  for (std::size_t i = 0; i < p.owned; ++i) {
    mass += p.mass[i];
    for (int c = 0; c < 3; ++c) moment[c] += p.mass[i] * p.position[i][c];
  }
  EXPECT_NEAR(moment[0] / mass, 0, 1e-14);
  EXPECT_NEAR(moment[1] / mass, 0, 1e-14);
  EXPECT_NEAR(moment[2] / mass, cylinder.bottom + 0.5 * cylinder.height, 1e-14);
}

TEST_P(EveryFilling, PointsKnowTheFacesTheyLieOn) {
  const Points p = points();
  const double disc = std::numbers::pi * cylinder.radius * cylinder.radius;
  for (const auto& [face, end] : {std::pair(low_face, 0.0), {high_face, cylinder.height}}) {
    double area = 0;
    for (std::size_t i = 0; i < p.owned; ++i)
      if (p.faces[i] & face) {
        const double depth = std::abs(p.position[i][2] - cylinder.bottom - end);
        if (GetParam().boundary == Boundary::on_surface) {
          EXPECT_NEAR(depth, 0, 1e-15);
        } else {
          area += p.volume[i] / (2 * depth); // the cell extends as far below the point as above it
        }
      }
    if (GetParam().boundary == Boundary::centred) {
      EXPECT_NEAR(area, disc, 1e-12 * disc);
    }
  }
  // Outside of the points at the rim there is no space for another cell.
  for (std::size_t i = 0; i < p.owned; ++i)
    if (p.faces[i] & rim_face) {
      EXPECT_GT(std::hypot(p.position[i][0], p.position[i][1]) + 1.01 * p.spacing[i], cylinder.radius);
    }
}

TEST_P(EveryFilling, JitteredPointsStayInTheirCells) {
  const SymmetryPlanes quarter{{true, true, false}};
  const Points regular = points(quarter);
  Filling filling = GetParam();
  filling.jitter.amount = 0.9;
  const Points jittered = fill_cylinder(cylinder, filling, quarter, density);
  ASSERT_EQ(jittered.owned, regular.owned);
  double mass = 0, moved = 0, low = 1, radius = 0;
  for (std::size_t i = 0; i < jittered.owned; ++i) {
    const Vec3 x = jittered.position[i];
    EXPECT_GT(std::min(x[0], x[1]), 0); // the points stay on their side of the planes
    mass += jittered.mass[i];
    low = std::min(low, x[2]);
    radius = std::max(radius, std::hypot(x[0], x[1]));
    // The Hilbert order differs, so each jittered point is compared with the nearest regular one, at most
    // half a cell away.
    double nearest = 1, cell = 0;
    for (std::size_t j = 0; j < regular.owned; ++j) {
      const Vec3 y = regular.position[j];
      const double distance = std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
      if (distance < nearest) nearest = distance, cell = regular.spacing[j];
    }
    EXPECT_LT(nearest, 0.5 * std::sqrt(3.0) * 2 * cell); // flat cells are up to twice as long as the cube
    moved = std::max(moved, nearest / cell);
  }
  EXPECT_NEAR(mass, density * std::numbers::pi * 0.05 * 0.05 * 0.08 / 4, 1e-12);
  EXPECT_GT(moved, 0.25);
  if (filling.boundary == Boundary::on_surface) {
    EXPECT_DOUBLE_EQ(low, cylinder.bottom);
    if (filling.layout == Layout::polar) {
      EXPECT_NEAR(radius, cylinder.radius, 1e-15);
    }
  }
}

TEST(FillCylinder, TheSeedDeterminesTheJitter) {
  const auto x = [](int seed) {
    return fill_cylinder(cylinder, {.rings = 3, .layers = 3, .jitter = {.amount = 0.5, .seed = seed}}, {},
                         density)
        .position;
  };
  EXPECT_EQ(x(7).component, x(7).component);
  EXPECT_NE(x(7).component, x(8).component);
}

TEST(FillCylinder, PointsLieOnTheSurfaceOrHalfACellInside) {
  const auto extent = [](const Points& points) {
    double radius = 0, low = 1e9, high = 0;
    for (std::size_t i = 0; i < points.owned; ++i) {
      const Vec3 x = points.position[i];
      radius = std::max(radius, std::hypot(x[0], x[1])), low = std::min(low, x[2]),
      high = std::max(high, x[2]);
    }
    return Vec3{radius, low, high};
  };
  const double bottom = cylinder.bottom, top = bottom + cylinder.height;
  const Vec3 on = extent(fill(5, 9, Boundary::on_surface)), in = extent(fill(5, 8, Boundary::centred));
  EXPECT_NEAR(on[0], cylinder.radius, 1e-15);
  EXPECT_NEAR(on[1], bottom, 1e-15);
  EXPECT_NEAR(on[2], top, 1e-15);
  EXPECT_NEAR(in[0], 0.9 * cylinder.radius, 1e-15);
  EXPECT_NEAR(in[1], bottom + cylinder.height / 16, 1e-15);
  EXPECT_NEAR(in[2], top - cylinder.height / 16, 1e-15);
}

TEST(FillCylinder, CellsAreNearlyCubesOfTheSpacing) {
  const Points points = fill(10, 16, Boundary::centred); // height / layers = radius / rings = 5 mm
  EXPECT_NEAR(points.spacing[0], 5e-3, 1e-15);
  for (std::size_t i = 0; i < points.owned; ++i) {
    EXPECT_EQ(points.spacing[i], points.spacing[0]);
    EXPECT_NEAR(points.volume[i] / std::pow(5e-3, 3), 1, 0.25);
  }
}

/// Returns the spacing of the points of a graded body by radius, m.
std::map<long long, double> spacing_by_radius(const Points& points) {
  std::map<long long, double> spacings;
  for (std::size_t i = 0; i < points.owned; ++i)
    spacings[std::llround(std::hypot(points.position[i][0], points.position[i][1]) * 1e9)] =
        points.spacing[i];
  return spacings;
}

TEST(GradedCylinder, SpacingIsFineAroundTheAxisAndGrowsSmoothlyToTheRim) {
  for (const Boundary boundary : boundaries) {
    const Cylinder slab{.radius = 0.76, .height = 0.127};
    const Grading g{.fine_spacing = 6e-3, .fine_radius = 50e-3, .coarse_spacing = 17.7e-3, .growth = 1.2};
    const auto rings = spacing_by_radius(fill_cylinder(slab, {.boundary = boundary, .grading = g}, {}, 1));
    double last = 0;
    for (const auto& [radius, spacing] : rings) {
      const double r = 1e-9 * static_cast<double>(radius);
      if (r < g.fine_radius || r > 150e-3) {
        EXPECT_NEAR(spacing / (r < g.fine_radius ? g.fine_spacing : g.coarse_spacing), 1, 0.05) << r;
      }
      if (last > 0) {
        EXPECT_LT(spacing / last, 1.05 * g.growth)
            << r; // only approximately, because the number of layers is an integer
        EXPECT_GT(spacing / last, 0.97) << r;
      }
      last = spacing;
    }
  }
}

TEST(GradedCylinder, CellsAreNearlyCubes) {
  const Points points = fill_cylinder(
      {.radius = 0.76, .height = 0.127},
      {.grading = {.fine_spacing = 6e-3, .fine_radius = 50e-3, .coarse_spacing = 17.7e-3, .growth = 1.2}}, {},
      1);
  for (std::size_t i = 0; i < points.owned; ++i) {
    const double h = points.spacing[i], r = std::hypot(points.position[i][0], points.position[i][1]);
    if (!(points.faces[i] & low_face)) continue;
    const double height = 2 * points.position[i][2];
    // The number of points on a quarter ring is an integer, so cells next to the axis are not square.
    EXPECT_NEAR(points.volume[i] / (height * h * h), 1, r < 3 * h ? 0.3 : 0.15);
    EXPECT_NEAR(height / h, 1, 0.08);
  }
}

TEST(GradedCylinder, WithOneSpacingIsTheUniformCylinder) {
  const Points graded = fill_cylinder(
      cylinder, {.grading = {.fine_spacing = 5e-3, .fine_radius = 0, .coarse_spacing = 5e-3}}, {}, density);
  const Points uniform = fill(10, 16, Boundary::centred);
  ASSERT_EQ(graded.owned, uniform.owned);
  for (std::size_t i = 0; i < graded.owned; ++i)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(graded.position[i][c], uniform.position[i][c], 1e-15);
}

TEST(LatticeCylinder, InnerCellsAreWholeAndThoseOfTheRimNearlySo) {
  const int rings = 20;
  const Points points = fill_cylinder({.radius = 0.02, .height = 5e-3},
                                      {.rings = rings, .layers = 5, .layout = Layout::lattice}, {}, 1);
  for (std::size_t i = 0; i < points.owned; ++i) {
    EXPECT_NEAR(points.spacing[i], 1e-3, 1e-15);
    const double r = std::hypot(points.position[i][0], points.position[i][1]) / 1e-3;
    EXPECT_NEAR(points.volume[i], 1e-9, r < rings - 0.8 ? 1e-20 : 0.5e-9);
  }
}

TEST(FillCylinder, StartsAtRestAndUndeformed) {
  const Points points = fill(3, 4, Boundary::centred);
  for (std::size_t i = 0; i < points.owned; ++i) {
    EXPECT_EQ(points.initial_position[i], points.position[i]);
    EXPECT_EQ(points.velocity[i], Vec3{});
    EXPECT_EQ(points.deformation(i), identity3);
    EXPECT_EQ(points.cauchy(i), Sym3{});
  }
}

TEST(FillCylinder, AHoleAlongTheAxisIsLeftEmpty) {
  const Cylinder holed{.radius = 0.05, .height = 0.08, .bottom = 0, .hole = 0.006};
  for (const SymmetryPlanes& planes : {SymmetryPlanes{}, SymmetryPlanes{.axis = true}})
    for (const Filling& filling : {Filling{11, 4}, Filling{.grading = grading}}) {
      const Points points = fill_cylinder(holed, filling, planes, density);
      double volume = 0;
      for (std::size_t i = 0; i < points.owned; ++i) {
        volume += points.volume[i];
        EXPECT_GT(std::hypot(points.position[i][0], points.position[i][1]), holed.hole);
      }
      const double exact = std::numbers::pi * (0.05 * 0.05 - 0.006 * 0.006) * 0.08;
      EXPECT_NEAR(volume, exact, 1e-12 * exact);
    }
}

} // namespace
} // namespace spall::test
