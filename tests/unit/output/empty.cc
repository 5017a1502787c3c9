// Evaluations of what is not there, and of what cannot be evaluated: nothing is lost by either.

#include "macro/output/answers.h"
#include "macro/output/craters.h"
#include "macro/output/evaluation.h"
#include "macro/output/quantile.h"
#include "macro/points/neighbor_search.h"
#include "shared/error.h"
#include "tests/support/scenes.h"
#include "tests/support/small_bar.h"

#include <gtest/gtest.h>

#include <cmath>

namespace spall::test {
namespace {

TEST(Empty, ASearchAmongNoPointsFindsNone) {
  NeighborSearch search;
  int found = 0;
  const auto look = [&] {
    search.for_each_in_box({0.1, 0, 0}, {1, 1, 1}, [&](std::uint32_t, double, double, double) { ++found; });
  };
  look(); // before the first rebuild
  search.rebuild(small_bar().points(), 1e-3);
  look();
  EXPECT_GT(found, 0);
  found = 0;
  search.rebuild(Points{}, 1e-3);
  look();
  EXPECT_EQ(found, 0);
}

TEST(Empty, AQuantileOfNothingIsNoNumber) {
  const std::vector<double> none;
  for (const double reach : {-1.0, 0.0, 1.0})
    EXPECT_TRUE(std::isnan(weighted_quantile(none, none, reach, {}))) << reach;
  EXPECT_TRUE(std::isnan(weighted_quantile({1, 2}, {1, 1}, 3, {})));
  EXPECT_EQ(weighted_quantile({1, 2}, {1, 1}, 2, {}), 2);
}

TEST(Empty, ABodyWithoutPointsHasNeitherFragmentsNorCratersNorAShape) {
  for (const std::vector<std::string>& symmetry : {std::vector<std::string>{}, {"x", "y"}, {"axis"}}) {
    const auto solid = make_solid(aluminium(), Points{}, planes_of(symmetry), {});
    const Fragments fragments = find_fragments(*solid, {}, 0, 1);
    EXPECT_TRUE(fragments.list.empty());
    EXPECT_EQ(sum_of(fragments, FragmentPlace::remainder).mass, 0);
    const Craters craters = measure_craters(*solid, fragments, 0, 1, 1, 1e-3);
    EXPECT_EQ(craters.back.mean_diameter, 0);
    EXPECT_EQ(craters.front.deepest, 0);
    EXPECT_TRUE(std::isnan(measure_bar(*solid, Boundary::centred).length));
  }
}

TEST(Empty, ABodyWithAHoleThatNothingHasLeftHasNoCraters) {
  Bar bar = small_bar({"axis"});
  Points all = bar.points(), points;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < all.owned; ++i)
    if (all.position.component[0][i] > 2.5e-3) kept.push_back(i);
  points.resize(kept.size());
  for (std::size_t k = 0; k < kept.size(); ++k) {
    points.position.set(k, all.position[kept[k]]), points.initial_position.set(k, all.position[kept[k]]);
    points.spacing[k] = all.spacing[kept[k]], points.volume[k] = all.volume[kept[k]],
    points.mass[k] = all.mass[kept[k]];
  }
  const auto solid = make_solid(aluminium(), points, bar.planes, {});
  Fragments whole;
  whole.of_point.assign(kept.size(), 0);
  const Craters craters = measure_craters(*solid, whole, 0, bar.height, 0.5 * bar.diameter, 1e-3);
  EXPECT_EQ(craters.front.mean_diameter, 0);
  EXPECT_TRUE(craters.radius.empty());
}

TEST(Evaluations, WhatTheyThrowBecomesAWarning) {
  Warnings warnings;
  EXPECT_TRUE(evaluate("one", [] {}, warnings, {}));
  EXPECT_FALSE(evaluate("two", [] { throw std::out_of_range("no such place"); }, warnings, {}));
  EXPECT_FALSE(evaluate("three", [] { throw InputError("bad"); }, warnings, {}));
  EXPECT_FALSE(evaluate("four", [] { throw ComputationError("lost"); }, warnings, {}));
  EXPECT_EQ(warnings, (Warnings{"two: no such place", "three: bad", "four: lost"}));
}

/// A scene of one or two bars that fly apart.
std::shared_ptr<SceneFile> bars(bool two) {
  const auto bar = [](const std::string& name, const std::string& more) {
    return "subsection " + name +
           "\n  include data/materials/steel_4340.prm\n  set Shape = cylinder\n  set Diameter = 8 mm\n"
           "  set Height = 8 mm\n  set Rings = 2\n  set Layers = 4\n" +
           more + "end\n";
  };
  return written(bar("first", "  set Velocity = -10 m/s\n") +
                 (two ? bar("second", "  set Behind = first\n") : "") + "subsection Answers\n" +
                 (two ? "  set Momentum = second, first\n" : "") +
                 "end\nsubsection Scene\n  set Symmetry planes = axis\nend\nsubsection Time\n  set End time "
                 "= 1 us\nend\n");
}

TEST(Evaluations, AnAnswerThatCannotBeMeasuredIsNullWithAWarningAndTheOthersAreThere) {
  const auto asked = bars(true), computed = bars(false);
  const Simulation run = start(*computed); // which has no body of the name
  Answers answers(asked->run.answers, asked->scene, asked->run.fragments, "scene");
  Warnings warnings;
  answers.measure(run, warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].find("Answers/Momentum of the second: "), 0u) << warnings[0];
  Summary summary;
  answers.add_to(summary, run);
  const std::string json = summary.json();
  EXPECT_NE(json.find("\"second_momentum\": null"), std::string::npos) << json;
  EXPECT_NE(json.find("\"first_momentum\": -"), std::string::npos) << json;
  EXPECT_EQ(answers.in_words().find("second"), std::string::npos);
}

} // namespace
} // namespace spall::test
