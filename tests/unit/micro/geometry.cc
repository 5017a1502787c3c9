#include "micro/cell/geometry.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace spall;

TEST(GridLines, FillTheCellAndHitTipsAndCrackLine) {
  for (const double ratio : {0.0, 0.1, 0.25, 0.9})
    for (const double grading : {1.0, 2.0, 3.0}) {
      const GridLines lines = grid_lines({.crack_ratio = ratio}, {.elements = 6, .grading = grading});
      for (const auto& values : {lines.x, lines.y}) {
        EXPECT_EQ(values.front(), 0);
        EXPECT_EQ(values.back(), 1);
        EXPECT_TRUE(std::is_sorted(values.begin(), values.end()));
        EXPECT_EQ(std::adjacent_find(values.begin(), values.end()), values.end());
        for (std::size_t i = 0; i < values.size(); ++i)
          EXPECT_NEAR(values[i] + values[values.size() - 1 - i], 1, 1e-15) << "not symmetric";
      }
      EXPECT_EQ(std::count(lines.y.begin(), lines.y.end(), 0.5), 1);
      for (const double tip : {0.5 - 0.5 * ratio, 0.5 + 0.5 * ratio})
        EXPECT_EQ(std::count(lines.x.begin(), lines.x.end(), tip), 1);
    }
}

TEST(GridLines, ElementsAtTheTipHaveOneSize) {
  const GridLines lines = grid_lines({.crack_ratio = 0.25}, {.elements = 16, .grading = 2});
  const auto tip = std::find(lines.x.begin(), lines.x.end(), 0.375);
  const auto middle = std::find(lines.y.begin(), lines.y.end(), 0.5);
  const double ahead = *tip - *(tip - 1), behind = *(tip + 1) - *tip, above = *(middle + 1) - *middle;
  EXPECT_NEAR(ahead / above, 1, 0.1);
  EXPECT_NEAR(behind / above, 1, 0.1);
}

TEST(CellGrid, CoarsestLigamentElementIgnoresTheCrack) {
  const CellGrid grid{.x = {0, 0.2, 0.25, 0.75, 0.85, 1},
                      .rows = {{.y = {0, 0, 0, 0, 0, 0}}, {.y = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5}, .line = 0}},
                      .open = {{false, false, true, false, false}}};
  EXPECT_DOUBLE_EQ(coarsest_ligament_element(grid), 0.2);
}

} // namespace
