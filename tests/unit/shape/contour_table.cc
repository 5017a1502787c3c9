#include "macro/shape/contour_table.h"

#include "shared/error.h"
#include "tests/unit/points/clouds.h"
#include "tests/unit/shape/samples.h"
#include "tests/unit/shared/scratch_folder.h"

#include <sstream>

namespace spall::test {
namespace {

std::string table_of(const std::vector<ContourPoint>& points, double shift) {
  std::ostringstream text;
  text.precision(17);
  text << "# a body\nz,r\n";
  for (const ContourPoint& p : points) text << p.z + shift << ", " << p.r << "\n";
  return text.str();
}

TEST(ContourTable, OfAnOgiveIsTheOgiveInEitherDirectionAndFromAnyOrigin) {
  const Contour exact = with({.kind = NoseKind::ogive, .caliber_radius_head = 3}).contour();
  std::vector<ContourPoint> points = exact.outline(1e-3);
  const ScratchFolder folder;
  for (const bool upwards : {false, true}) {
    if (upwards) std::reverse(points.begin(), points.end());
    const Contour table = read_contour(folder.write("ogive.csv", table_of(points, 0.2)));
    for (const Vec3& x : random_cloud(1000, {-0.04, -0.04, -0.22}, {0.04, 0.04, 0.03}))
      EXPECT_NEAR(table.surface(x).distance, exact.surface(x).distance, 2e-6);
    EXPECT_NEAR(table.mass_properties().volume / exact.mass_properties().volume, 1, 1e-4);
    EXPECT_EQ(table.kinks().size(), 2U); // the rows of a smooth curve are no kinks
  }
}

TEST(ContourTable, StepsAreRowsOfEqualZ) {
  const ScratchFolder folder;
  const Contour body = read_contour(folder.write("step.csv", "z,r\n0,0\n0,1\n-1,1\n-1,2\n-3,2\n-3,0\n"));
  EXPECT_EQ(body.kinks(), (std::vector{-3.0, -1.0, 0.0}));
  EXPECT_NEAR(body.mass_properties().volume, std::numbers::pi * 9, 1e-12);
  EXPECT_EQ(body.section_radius(-0.5), 1);
  EXPECT_EQ(body.section_radius(-1.5), 2);
}

TEST(ContourTable, InvalidContoursAreRefusedWithTheirLine) {
  const ScratchFolder folder;
  const auto refusal = [&](const std::string& text) {
    const auto file = folder.write("body.csv", text);
    return message_of<InputError>([&] { read_contour(file); });
  };
  expect_one_line_with(refusal("z,r\n0,0\n-1,1\n-2,1\n"), {"body.csv:4", "does not close", "r = 1", "0"});
  expect_one_line_with(refusal("z,r\n0,0.1\n-1,1\n-2,0\n"), {"body.csv:2", "does not close"});
  expect_one_line_with(refusal("z,r\n0,0\n-1,-1\n-2,0\n"), {"body.csv:3", "r = -1", "not negative"});
  expect_one_line_with(refusal("z,r\n0,0\n-1,1\n-0.5,1\n-2,0\n"), {"body.csv:4", "turns back"});
  expect_one_line_with(refusal("z,r\n0,0\n-1,1\n-1.5,0\n-2,1\n-3,0\n"), {"body.csv:4", "between the ends"});
  expect_one_line_with(refusal("z,r\n0,0\n-1,x\n-2,0\n"), {"body.csv:3", "'r'", "found 'x'"});
  expect_one_line_with(refusal("z,r\n0,0\n-1,1,3\n-2,0\n"), {"body.csv:3"});
  expect_one_line_with(refusal("z,d\n0,0\n"), {"body.csv:1", "z,r"});
  expect_one_line_with(refusal("z,r\n0,0\n-1,0\n"), {"body.csv", "3 rows"});
  expect_one_line_with(refusal("z,r\n0,0\n0,1\n0,0\n"), {"body.csv:4", "no length"});
  expect_one_line_with(message_of<InputError>([&] { read_contour(folder / "none.csv"); }), {"none.csv"});
}

} // namespace
} // namespace spall::test
