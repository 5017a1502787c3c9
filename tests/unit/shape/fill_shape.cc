#include "macro/shape/expected_points.h"
#include "macro/shape/fill.h"

#include "tests/unit/shape/samples.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace spall::test {
namespace {

std::vector<NamedShape> with_casings() {
  std::vector<NamedShape> all = every_shape();
  all.back().shape = ClosedSurface(triangles_of(Block{.width = 0.05, .depth = 0.08, .height = 0.06}));
  for (const Nose& nose : {Nose{.kind = NoseKind::ogive, .caliber_radius_head = 3},
                           {.kind = NoseKind::cone, .length = 0.06},
                           {.kind = NoseKind::blunt, .edge_radius = 0.01}})
    all.push_back({"casing" + std::to_string(all.size()),
                   casing(with(nose), {.nose = 0.02, .base = 0.01, .side = 0.004})});
  return all;
}

/// Every body, filled with points of about 4 mm.
class EveryBody : public ::testing::TestWithParam<NamedShape> {
protected:
  const Shape& shape = GetParam().shape;
  Filling filling(Boundary boundary = Boundary::centred) const {
    const double length = extent(shape, {0, 0, 1}) + extent(shape, {0, 0, -1});
    return {.rings = std::holds_alternative<Cylinder>(shape) ? 12 : 2,
            .layers = static_cast<int>(length / 4e-3),
            .boundary = boundary,
            .spacing = 4e-3};
  }
  Points points(const SymmetryPlanes& planes = {}, Boundary boundary = Boundary::centred) const {
    return fill(shape, filling(boundary), planes, 7);
  }
};
INSTANTIATE_TEST_SUITE_P(Shapes, EveryBody, ::testing::ValuesIn(with_casings()),
                         [](const auto& instance) { return instance.param.name; });

TEST_P(EveryBody, VolumeMassAndCentreOfMassAreExact) {
  const MassProperties whole = mass_properties(shape);
  for (const SymmetryPlanes planes : {SymmetryPlanes{}, {{false, true, false}}, {{true, true, false}}}) {
    const Points p = points(planes);
    double volume = 0, mass = 0;
    Vec3 first{};
    for (std::size_t i = 0; i < p.owned; ++i) {
      volume += p.volume[i], mass += p.mass[i];
      first += p.volume[i] * p.position[i];
    }
    const double part = whole.volume / planes.multiplicity();
    EXPECT_NEAR(volume, part, 1e-8 * part);
    EXPECT_NEAR(mass, 7 * part, 7e-8 * part);
    EXPECT_NEAR(first[2] / volume, whole.centre[2], 1e-9);
    for (int c = 0; c < 2; ++c)
      if (!planes.normal[c]) {
        EXPECT_NEAR(first[c] / volume, 0, 1e-14);
      }
  }
}

TEST_P(EveryBody, ItsPointsAreForeseenWithinAFactor) {
  for (const SymmetryPlanes planes : {SymmetryPlanes{}, {{true, true, false}}}) {
    const double expected = expected_points(shape, filling(), planes),
                 found = static_cast<double>(points(planes).owned);
    EXPECT_GE(expected, 0.5 * found);
    EXPECT_LE(expected, 4 * found); // hollow bodies are taken for solid ones
  }
}

TEST_P(EveryBody, MomentsOfInertiaAreThoseOfItsCellsToASpacing) {
  const MassProperties whole = mass_properties(shape);
  const Points p = points();
  for (int c = 0; c < 3; ++c) {
    double sum = 0;
    for (std::size_t i = 0; i < p.owned; ++i) {
      const Vec3 x = p.position[i] - whole.centre;
      sum += p.volume[i] * (dot(x, x) - x[c] * x[c]);
    }
    EXPECT_NEAR(sum / whole.volume / whole.moments[c], 1, 0.05) << c;
  }
}

TEST_P(EveryBody, PointsLieInsideAndSymmetricallyOffThePlanes) {
  const Points p = points();
  const auto key = [](const Vec3& x) {
    return std::array{std::llround(x[0] * 1e9), std::llround(x[1] * 1e9), std::llround(x[2] * 1e9)};
  };
  std::set<std::array<long long, 3>> places;
  for (std::size_t i = 0; i < p.owned; ++i) places.insert(key(p.position[i]));
  EXPECT_EQ(places.size(), p.owned);
  for (std::size_t i = 0; i < p.owned; ++i) {
    const Vec3 x = p.position[i];
    EXPECT_LT(surface(shape, x).distance, 0);
    if (const Revolution* body = std::get_if<Revolution>(&shape)) {
      EXPECT_GT(std::hypot(x[0], x[1]), body->inner_radius(x[2]));
    }
    EXPECT_GT(std::min(std::abs(x[0]), std::abs(x[1])), 1e-5);
    EXPECT_EQ(places.count(key({-x[0], x[1], x[2]})), 1U);
    EXPECT_EQ(places.count(key({x[0], -x[1], x[2]})), 1U);
  }
}

TEST_P(EveryBody, AQuarterIsAQuarterOfTheWhole) {
  const Points quarter = points({{true, true, false}});
  EXPECT_EQ(4 * quarter.owned, points().owned);
  for (std::size_t i = 0; i < quarter.owned; ++i)
    EXPECT_GT(std::min(quarter.position[i][0], quarter.position[i][1]), 0);
}

TEST_P(EveryBody, FacesAreTheEndsAndTheSide) {
  const Points p = points();
  const double top = extent(shape, {0, 0, 1}), bottom = -extent(shape, {0, 0, -1});
  std::set<int> seen;
  for (std::size_t i = 0; i < p.owned; ++i) {
    const double z = p.position[i][2];
    for (const int face : {low_face, high_face, rim_face})
      if (p.faces[i] & face) seen.insert(face);
    EXPECT_EQ((p.faces[i] & high_face) != 0, z > top - 4e-3) << z;
    EXPECT_EQ((p.faces[i] & low_face) != 0, z < bottom + 4e-3) << z;
  }
  EXPECT_EQ(seen.size(), 3U);
}

const Block block{.width = 0.05, .depth = 0.08, .height = 0.06};

TEST(FillBlock, CellsAreBricksOfAboutTheSpacing) {
  const Points p = fill_block(block, {.spacing = 4e-3}, {}, 1);
  EXPECT_EQ(p.owned, 12U * 20 * 15);
  for (std::size_t i = 0; i < p.owned; ++i) {
    EXPECT_NEAR(p.volume[i], block.width * block.depth * block.height / (12 * 20 * 15), 1e-18);
    EXPECT_NEAR(p.spacing[i], std::cbrt(p.volume[i]), 1e-12);
  }
}

TEST(FillBlock, PointsOnTheSurfaceLieThereAndStandForPartsOfCells) {
  const Points p = fill_block(block, {.boundary = Boundary::on_surface, .spacing = 4e-3}, {}, 2);
  Vec3 largest{};
  double mass = 0;
  for (std::size_t i = 0; i < p.owned; ++i) {
    mass += p.mass[i];
    for (int c = 0; c < 3; ++c) largest[c] = std::max(largest[c], p.position[i][c]);
    EXPECT_EQ((p.faces[i] & rim_face) != 0, std::abs(std::abs(p.position[i][0]) - 0.025) < 1e-12 ||
                                                std::abs(std::abs(p.position[i][1]) - 0.04) < 1e-12);
  }
  EXPECT_NEAR(mass, 2 * block.width * block.depth * block.height, 1e-15);
  EXPECT_NEAR(largest[0], 0.025, 1e-15);
  EXPECT_NEAR(largest[1], 0.04, 1e-15);
  EXPECT_NEAR(largest[2], 0.06, 1e-15);
  EXPECT_EQ(p.surface_offset, 0);
}

TEST(FillBlock, JitterKeepsPointsInTheirCellsAndTheVolume) {
  const Points p = fill_block(block, {.jitter = {.amount = 0.9}, .spacing = 4e-3}, {{true, true, false}}, 1);
  double volume = 0;
  for (std::size_t i = 0; i < p.owned; ++i) {
    volume += p.volume[i];
    EXPECT_LT(block.surface(p.position[i]).distance, 0);
    EXPECT_GT(std::min(p.position[i][0], p.position[i][1]), 0);
  }
  EXPECT_NEAR(volume, block.width * block.depth * block.height / 4, 1e-16);
}

TEST(Fill, InfiniteAndUnsymmetricShapesAreRefused) {
  EXPECT_THROW(fill(PlaneWall{}, {}, {}, 1), std::invalid_argument);
  EXPECT_THROW(fill(block, {.spacing = 4e-3}, {.axis = true}, 1), std::invalid_argument);
}

} // namespace
} // namespace spall::test
