#include "macro/integration/conforming_cells.h"

#include "macro/shape/fill.h"
#include "shared/error.h"
#include "tests/unit/points/clouds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace spall::test {
namespace {

std::vector<HalfSpace> cube(double edge) {
  return {{{1, 0, 0}, edge}, {{0, 1, 0}, edge}, {{0, 0, 1}, edge},
          {{-1, 0, 0}, 0.},  {{0, -1, 0}, 0.},  {{0, 0, -1}, 0.}};
}

/// Checks that all cells are closed, relative to `size` (the edge of the body): for each cell the sum of the
/// area vectors is zero, and sum(area (x) centre) is the volume.
void expect_closed(const Points& points, const ConformingCells& cells, double size) {
  for (std::size_t i = 0; i < points.owned; ++i) {
    Vec3 area{};
    Mat3 moment{};
    for (std::uint32_t f = cells.start[i]; f < cells.start[i + 1]; ++f)
      for (int a = 0; a < 3; ++a) {
        area[a] += cells.face[f].area[a];
        for (int b = 0; b < 3; ++b) moment[3 * a + b] += cells.face[f].area[a] * cells.face[f].centre[b];
      }
    EXPECT_LT(std::sqrt(dot(area, area)), 1e-12 * size * size);
    for (int k = 0; k < 9; ++k)
      EXPECT_NEAR(moment[k], k % 4 == 0 ? cells.volume[i] : 0, 1e-12 * size * size * size);
  }
}

TEST(VoronoiCells, OfALatticeAreItsCubes) {
  const int n = 4;
  const Points points = points_at(jittered_lattice(n, 0.5, 0), 0.5);
  const ConformingCells cells = voronoi_cells(points, SymmetryPlanes{}, cube(n * 0.5));
  for (std::size_t i = 0; i < points.owned; ++i) {
    EXPECT_NEAR(cells.volume[i], 0.125, 1e-14);
    ASSERT_EQ(cells.start[i + 1] - cells.start[i], 6u);
    for (std::uint32_t f = cells.start[i]; f < cells.start[i + 1]; ++f) {
      EXPECT_NEAR(dot(cells.face[f].area, cells.face[f].area), 0.0625, 1e-14);
      EXPECT_NEAR(dot(cells.face[f].area, cells.face[f].centre), 0.25 * 0.25, 1e-14);
    }
  }
}

TEST(VoronoiCells, AreClosedAndFillABlockOfJitteredPoints) {
  const int n = 5;
  const Points points = points_at(jittered_lattice(n, 1, 0.2), 1);
  const ConformingCells cells = voronoi_cells(points, SymmetryPlanes{}, cube(n));
  expect_closed(points, cells, n);
  double volume = 0;
  for (const double v : cells.volume) volume += v;
  EXPECT_NEAR(volume, n * n * n, 1e-10);
}

TEST(VoronoiCells, ShareTheirFaces) {
  const int n = 5;
  const Points points = points_at(jittered_lattice(n, 1, 0.2), 1);
  const ConformingCells cells = voronoi_cells(points, SymmetryPlanes{}, cube(n));
  // Every face is at the surface or coincides with a face of opposite area.
  std::size_t shared = 0, outer = 0;
  for (std::size_t i = 0; i < points.owned; ++i)
    for (std::uint32_t f = cells.start[i]; f < cells.start[i + 1]; ++f) {
      const ConformingCells::Face& face = cells.face[f];
      Vec3 place;
      bool surface = false;
      for (int c = 0; c < 3; ++c) {
        place[c] = points.position[i][c] + face.centre[c];
        surface |= place[c] < 1e-9 || place[c] > n - 1e-9;
      }
      if (surface) {
        ++outer;
        continue;
      }
      int twins = 0;
      for (std::size_t j = 0; j < points.owned; ++j)
        for (std::uint32_t g = cells.start[j]; j != i && g < cells.start[j + 1]; ++g) {
          double away = 0;
          for (int c = 0; c < 3; ++c)
            away = std::max({away, std::abs(points.position[j][c] + cells.face[g].centre[c] - place[c]),
                             std::abs(cells.face[g].area[c] + face.area[c])});
          twins += away < 1e-9;
        }
      EXPECT_EQ(twins, 1);
      ++shared;
    }
  EXPECT_GE(outer, 6u * n * n);
  EXPECT_GT(shared, 6u * n * n * (n - 1));
}

TEST(VoronoiCells, OfAFilledCylinderHaveItsVolumeAndAQuarterIsAQuarter) {
  const Cylinder cylinder{.radius = 5, .height = 6, .bottom = 1};
  const auto outline = cylinder_outline(cylinder.radius, cylinder.bottom, cylinder.height);
  const double exact = std::numbers::pi * 25 * 6;
  for (const Boundary boundary : {Boundary::centred, Boundary::on_surface})
    for (const bool quarter : {false, true}) {
      const SymmetryPlanes planes{{quarter, quarter, false}};
      Points points = fill_cylinder(cylinder, {5, 6, boundary}, planes, 2);
      const ConformingCells cells = voronoi_cells(points, planes, outline);
      expect_closed(points, cells, 5);
      adopt_volumes(points, cells);
      double volume = 0, mass = 0;
      for (std::size_t i = 0; i < points.owned; ++i) volume += points.volume[i], mass += points.mass[i];
      EXPECT_NEAR(volume * planes.multiplicity(), exact, 1e-9 * exact);
      EXPECT_NEAR(mass, 2 * volume, 1e-9 * mass);
    }
}

TEST(VoronoiCells, OfPointsFarApartAreRefused) {
  const Points points = points_at(jittered_lattice(3, 2.5, 0), 1);
  EXPECT_THROW(voronoi_cells(points, SymmetryPlanes{}, cube(7.5)), ComputationError);
}

} // namespace
} // namespace spall::test
