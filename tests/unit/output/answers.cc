// Tests of the answers of a run about its bodies.

#include "macro/output/answers.h"

#include "tests/support/scenes.h"
#include "tests/support/small_bar.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace spall::test {
namespace {

TEST(MeasureBar, AnUndeformedBarHasItsOwnLengthAndDiameter) {
  for (const Boundary boundary : {Boundary::centred, Boundary::on_surface}) {
    const Bar bar = small_bar({}, boundary);
    const BarShape shape = measure_bar(*bar.solid(), boundary);
    EXPECT_NEAR(shape.length, bar.height, 1e-12);
    EXPECT_NEAR(shape.foot_diameter, bar.diameter, 1e-12);
    EXPECT_EQ(shape.max_plastic_strain, 0);
    EXPECT_EQ(shape.plastic_strain_95, 0);
    EXPECT_EQ(shape.mean_plastic_strain, 0);
  }
}

TEST(MeasureBar, FollowsAHomogeneousDeformation) {
  const Bar bar = small_bar();
  const auto solid = bar.solid();
  Points& points = solid->points;
  // The map scales the radius by 1.2 and the height by 0.7, and rotates about the axis.
  const double a = 0.5, c = 1.2 * std::cos(a), d = 1.2 * std::sin(a);
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 x = points.position[i];
    points.position.set(i, {c * x[0] - d * x[1], d * x[0] + c * x[1], 0.7 * x[2]});
    points.reference[i] = {c, -d, 0, d, c, 0, 0, 0, 0.7};
  }
  const BarShape shape = measure_bar(*solid, Boundary::centred);
  EXPECT_NEAR(shape.length, 0.7 * bar.height, 1e-12);
  EXPECT_NEAR(shape.foot_diameter, 1.2 * bar.diameter, 1e-12);
}

TEST(MeasureBar, TheQuantileIsBetweenMeanAndMaximumAfterAnImpact) {
  Simulation run = small_bar().shoot();
  for (int i = 0; i < 150; ++i) run.advance();
  const Solid& solid = *run.bodies.solids[0];
  const BarShape shape = measure_bar(solid, Boundary::centred);
  EXPECT_GT(shape.mean_plastic_strain, 0.01);
  EXPECT_GT(shape.plastic_strain_95, shape.mean_plastic_strain);
  EXPECT_GE(shape.max_plastic_strain, shape.plastic_strain_95);
  const auto strain = solid.field("plastic_strain");
  double above = 0, volume = 0;
  for (std::size_t i = 0; i < strain.size(); ++i) {
    volume += solid.points.volume[i];
    if (strain[i] > shape.plastic_strain_95) above += solid.points.volume[i];
  }
  EXPECT_LE(above, 0.05 * volume);
  EXPECT_GT(above, 0.03 * volume);
}

/// Makes a cheap scene of two thin slabs, the second 20 mm behind the first, and a ball.
std::shared_ptr<SceneFile> two_slabs(const std::string& answers,
                                     const std::vector<std::string>& overrides = {}) {
  const auto plate = [](const std::string& name, const std::string& place) {
    return "subsection " + name + "\n  include data/materials/wes5000_u.prm\n  set Shape = cylinder\n" +
           place + "  set Diameter = 60 mm\n  set Height = 10 mm\n  set Rings = 6\n  set Layers = 2\nend\n";
  };
  return written(
      plate("first", "") + plate("second", "  set Behind = first\n  set Gap = 20 mm\n") +
          "subsection ball\n  set Model = rigid\n  set Shape = sphere\n  set Diameter = 20 mm\n  set "
          "Mass = 1 kg\n"
          "  set Before = first\n  set Velocity = 300 m/s\nend\nsubsection Answers\n" +
          answers +
          "end\nsubsection Scene\n  set Symmetry planes = axis\nend\n"
          "subsection Time\n  set End time = 1 ms\n  set Step factor = 0.3\nend\n"
          "subsection Integration\n  set Refresh interval = 5\nend\n",
      overrides);
}

TEST(Answers, EveryBodyThatIsAskedForHasItsOwn) {
  const auto file =
      two_slabs("  set Exit = ball through first, ball through second\n  set Momentum = second\n");
  Simulation run = start(*file);
  Answers answers(file->run.answers, file->scene, file->run.fragments, "scene");
  EXPECT_EQ(answers.moving_body(), "ball");
  EXPECT_EQ(answers.main_body(), "first");
  EXPECT_EQ(answers.fragmented(), (std::vector<std::string>{"first", "second"}));
  double passed_first = 0;
  while (!answers.reached(run) && run.time < 1e-3) {
    run.advance();
    answers.follow(run);
    if (passed_first == 0 && motion_of(run.bodies, "ball").rear > 10e-3) passed_first = run.time;
  }
  Warnings warnings;
  answers.measure(run, warnings);
  EXPECT_EQ(warnings, Warnings{});
  Summary summary;
  answers.add_to(summary, run);
  const std::string json = summary.json();
  for (const char* key : {"\"exit_velocity\"", "\"ball_second_exit_velocity\"", "\"second_momentum\"",
                          "\"second_momentum_from_ball\"", "\"outcome\": \"perforated\"",
                          "\"ball_second_outcome\": \"perforated\""})
    EXPECT_NE(json.find(key), std::string::npos) << key << " in " << json;
  const auto value = [&](const std::string& key) {
    return std::stod(json.substr(json.find("\"" + key + "\": ") + key.size() + 4));
  };
  EXPECT_EQ(value("time_of_exit"), passed_first);
  EXPECT_LT(value("exit_velocity"), 300);
  EXPECT_LT(value("ball_second_exit_velocity"), value("exit_velocity"));
  EXPECT_NEAR(value("ball_second_exit_velocity"), run.bodies.rigid("ball")->velocity[2], 1e-9);
  // Who perforated whom, and when: the tip breaks through before the tail leaves, one slab after the other.
  for (const char* target : {"first", "second"}) {
    EXPECT_NE(json.find("\"" + std::string(target) + "_perforated\": true"), std::string::npos);
    EXPECT_NE(json.find("\"" + std::string(target) + "_perforated_by\": \"ball\""), std::string::npos);
  }
  EXPECT_GT(value("first_perforated_at"), 10e-3 / 300);
  EXPECT_LT(value("first_perforated_at"), value("time_of_exit"));
  EXPECT_LT(value("time_of_exit"), value("second_perforated_at"));
}

TEST(Answers, ADepthIsTheLargestOneOfTheForemostPoint) {
  const auto file = two_slabs("  set Penetration = ball into first\n");
  Simulation run = start(*file);
  Answers answers(file->run.answers, file->scene, file->run.fragments, "scene");
  for (int step = 0; step < 20; ++step) run.advance(), answers.follow(run);
  Warnings warnings;
  answers.measure(run, warnings);
  EXPECT_EQ(warnings, Warnings{});
  Summary summary;
  answers.add_to(summary, run);
  const std::string json = summary.json(), key = "\"penetration_depth\": ";
  EXPECT_NEAR(std::stod(json.substr(json.find(key) + key.size())), run.bodies.rigid("ball")->front(), 1e-12);
  EXPECT_NE(json.find("\"outcome\": \"moving\""), std::string::npos);
}

/// A run of a scene until its key Run/Until is met.
struct Course {
  explicit Course(std::shared_ptr<SceneFile> file_)
      : file(std::move(file_)), run(start(*file)),
        answers(file->run.answers, file->scene, file->run.fragments, "scene") {
    while (!answers.reached(run) && run.time < file->run.time.end_time) {
      run.advance();
      answers.follow(run);
      part = answers.part_done(run);
    }
    Warnings warnings;
    answers.measure(run, warnings);
    Summary summary;
    answers.add_to(summary, run);
    json = summary.json();
  }
  /// The text of a value of the summary.
  std::string value(const std::string& key) const {
    const std::size_t at = json.find("\"" + key + "\": ");
    EXPECT_NE(at, std::string::npos) << key << " in " << json;
    const std::size_t begin = at + key.size() + 4;
    return json.substr(begin, json.find_first_of(",\n", begin) - begin);
  }
  double number(const std::string& key) const { return std::stod(value(key)); }

  std::shared_ptr<SceneFile> file;
  Simulation run;
  Answers answers;
  double part = 0; ///< part done, after the last step
  std::string json;
};

/// A rigid ball of 20 mm and 0.03 kg, shot at a block of a metal around the axis until its answer is settled.
struct BallShot : Course {
  BallShot(const std::string& velocity, const std::string& yield_stress, const std::string& end_time = "1 ms")
      : Course(written("subsection block\n  include data/materials/aluminium_6061_t6.prm\n  subsection J2\n"
                       "    set Yield stress = " +
                       yield_stress +
                       "\n  end\n  set Shape = cylinder\n  set Diameter = 80 mm\n  set Height = 50 mm\n"
                       "  set Rings = 16\n  set Layers = 20\nend\n"
                       "subsection ball\n  set Model = rigid\n  set Shape = sphere\n  set Diameter = 20 mm\n"
                       "  set Mass = 0.03 kg\n  set Before = block\n  set Velocity = " +
                       velocity +
                       "\nend\nsubsection Answers\n  set Exit = ball through block\nend\n"
                       "subsection Scene\n  set Symmetry planes = axis\nend\n"
                       "subsection Time\n  set End time = " +
                       end_time + "\n  set Step factor = 0.3\nend\n")) {}
};

TEST(Answers, ABallThatBouncesOffHasAReboundVelocity) {
  const BallShot shot("20 m/s", "1e6 MPa"); // elastic
  EXPECT_EQ(shot.value("outcome"), "\"rebounded\"");
  EXPECT_EQ(shot.number("exit_velocity"), 0);
  EXPECT_GT(shot.number("rebound_velocity"), 5);
  EXPECT_LT(shot.number("rebound_velocity"), 20);
  EXPECT_EQ(shot.number("rebound_velocity"), -shot.number("final_velocity"));
  EXPECT_GT(shot.number("delta_ke_percent"), 0);
  EXPECT_LT(shot.number("delta_ke_percent"), 100);
  EXPECT_LT(shot.run.time, 0.9e-3); // it does not wait for the end time
  EXPECT_NE(shot.answers.in_words().find("has rebounded from the block: velocity -"), std::string::npos);
  // The velocity that is told is the one it keeps: contact is over.
  EXPECT_EQ(shot.run.impulse_given_by("ball")[2], 0);
}

TEST(Answers, ABallThatSticksIsAtRestWithADepth) {
  const BallShot shot("150 m/s", "100 MPa");
  EXPECT_EQ(shot.value("outcome"), "\"stopped\"");
  EXPECT_EQ(shot.number("exit_velocity"), 0);
  EXPECT_EQ(shot.value("rebound_velocity"), "null");
  EXPECT_EQ(shot.value("block_perforated"), "false");
  EXPECT_EQ(shot.value("block_perforated_by"), "\"\"");
  EXPECT_EQ(shot.value("block_perforated_at"), "null");
  EXPECT_EQ(shot.number("delta_v_percent"), 100);
  EXPECT_EQ(shot.number("delta_ke_percent"), 100);
  EXPECT_GT(shot.number("penetration_depth"), 2e-3);
  EXPECT_NE(shot.answers.in_words().find("is at rest in the block: velocity 0.0 m/s"), std::string::npos)
      << shot.answers.in_words();
}

TEST(Answers, ABallThatStillMovesAtTheEndTimeHasNoExitVelocity) {
  const BallShot shot("150 m/s", "100 MPa", "5 us");
  EXPECT_EQ(shot.value("outcome"), "\"moving\"");
  EXPECT_EQ(shot.value("exit_velocity"), "null");
  EXPECT_NE(shot.answers.in_words().find("is still moving in or before the block"), std::string::npos);
}

TEST(Answers, OfConcreteHaveABandAndThoseOfAMetalSayThatNoneIsMeasured) {
  const auto value = [](const std::string& json, const std::string& key) {
    const std::size_t at = json.find("\"" + key + "\": ");
    EXPECT_NE(at, std::string::npos) << key << " in " << json;
    return json.substr(at + key.size() + 4, json.find_first_of(",\n", at) - at - key.size() - 4);
  };
  const auto file =
      two_slabs("  set Exit = ball through first\nend\nsubsection Integration\n  set Scheme = SUBPOINT\n");
  Simulation run = start(*file);
  Answers answers(file->run.answers, file->scene, file->run.fragments, "scene");
  EXPECT_EQ(answers.numerical_errors(run).find("numerical error: "), 0u);
  while (!answers.reached(run) && run.time < 1e-3) run.advance(), answers.follow(run);
  Warnings warnings;
  answers.measure(run, warnings);
  Summary summary;
  answers.add_to(summary, run);
  const std::string json = summary.json();
  EXPECT_LT(std::stod(value(json, "exit_velocity_low")), std::stod(value(json, "exit_velocity")));
  EXPECT_GT(std::stod(value(json, "exit_velocity_high")), std::stod(value(json, "exit_velocity")));
  EXPECT_GT(std::stod(value(json, "numerical_error_percent")), 0);
  EXPECT_EQ(value(json, "penetration_depth_low"), "null");
  EXPECT_NE(answers.in_words().find(" m/s (numerically "), std::string::npos) << answers.in_words();
  EXPECT_NE(answers.in_words().find("% of the resistance"), std::string::npos) << answers.in_words();
  const BallShot metal("150 m/s", "100 MPa");
  for (const char* key : {"numerical_error_percent", "exit_velocity_low", "penetration_depth_high"})
    EXPECT_EQ(metal.value(key), "null");
  EXPECT_NE(metal.answers.in_words().find("numerical error: not measured for a target that does not soften"),
            std::string::npos);
}

// The errors were measured with AFC and J2.
TEST(Answers, OtherLawsHaveNoMeasuredError) {
  const auto file = shipped("slab_127_axis.prm", {"slab/AFC/Damage table="});
  BodyInputs& slab = *std::find_if(file->scene.bodies.begin(), file->scene.bodies.end(),
                                   [](const BodyInputs& body) { return body.name == "slab"; });
  for (const char* name : {"HJC", "AFC"}) {
    std::size_t place = 0;
    while (slab.material.chosen = place, slab.material.law() != name) ++place;
    const Shot shot("Exit", {"projectile", "slab"}, file->scene, {}, "file");
    EXPECT_EQ(shot.unmeasured, std::string(name) == "AFC" ? "" : "a target of the law HJC");
  }
}

TEST(Answers, ABarHasABandOfItsLength) {
  const auto file = shipped("taylor_aluminium.prm", {"bar/Rings=4", "bar/Layers=25", "Time/End time=2 us"});
  Simulation run = start(*file);
  Answers answers(file->run.answers, file->scene, file->run.fragments, "scene");
  for (int i = 0; i < 3; ++i) run.advance(), answers.follow(run);
  Warnings warnings;
  answers.measure(run, warnings);
  EXPECT_NE(answers.in_words().find("(numerically 0."), std::string::npos) << answers.in_words();
  EXPECT_NE(answers.numerical_errors(run).find("% of the shortening"), std::string::npos);
}

std::shared_ptr<SceneFile> coarse_slab(const std::string& until) {
  return shipped("slab_127_u.prm",
                 {"slab/Diameter=0.5 m", "slab/Rings=10", "slab/Layers=5", "Run/Until=" + until});
}

TEST(Settled, TheVelocityIsThatOfTheTailToATenthOfAPercentAndTheRunIsShorter) {
  const Course early(coarse_slab("settled")), late(coarse_slab("answered"));
  EXPECT_LT(early.run.time, 0.75 * late.run.time);
  EXPECT_NEAR(std::stod(early.value("exit_velocity")) / std::stod(late.value("exit_velocity")), 1, 1e-3);
  EXPECT_EQ(early.value("outcome"), "\"perforated\"");
  EXPECT_EQ(early.value("time_of_exit"), "null");
  EXPECT_EQ(std::stod(late.value("time_of_exit")), late.run.time);
  for (const Course* course : {&early, &late}) {
    EXPECT_EQ(course->value("settled"), "\"exit velocity\"");
    EXPECT_EQ(course->value("not_settled"), "\"craters"); // and fragments, behind a comma
    EXPECT_GT(course->part, 0.95);
  }
  EXPECT_LT(early.answers.shortest_time(early.run), 1e-3 * early.run.time);
}

TEST(Settled, CratersAndFragmentsAreNotReportedBeforeTheTailHasLeft) {
  const Course early(coarse_slab("settled")), late(coarse_slab("answered"));
  for (const char* key : {"back_crater_diameter", "front_crater_depth", "fragments", "debris_mass"}) {
    EXPECT_EQ(early.value(key), "null") << key;
    EXPECT_NE(late.value(key), "null") << key;
  }
  EXPECT_EQ(early.value("back_crater_diameter_low"), "null");
  for (const auto& [face, scatter] : {std::pair("front", front_scatter), {"back", back_scatter}}) {
    const std::string key = std::string(face) + "_crater_diameter";
    const double diameter = std::stod(late.value(key));
    EXPECT_NEAR(std::stod(late.value(key + "_low")), (1 - 2 * scatter) * diameter, 1e-5 * diameter);
    EXPECT_NEAR(std::stod(late.value(key + "_high")), (1 + 2 * scatter) * diameter, 1e-5 * diameter);
  }
  EXPECT_NE(early.value("not_settled_remark").find("Run/Until = answered"), std::string::npos);
  EXPECT_NE(
      early.answers.in_words().find("settled: exit velocity; not settled: craters, fragments (not reported"),
      std::string::npos)
      << early.answers.in_words();
  EXPECT_NE(late.value("not_settled_remark").find("are those at"), std::string::npos);
  // A stated end time is a request for the state then.
  auto file = coarse_slab("end time");
  file->run.time.end_time = early.run.time;
  EXPECT_NE(Course(file).value("back_crater_diameter"), "null");
}

/// Two plates, the second at a distance behind the first, and a rod of 100 mm instead of the ball.
std::shared_ptr<SceneFile> plates_and_rod(const std::string& question, const std::string& gap) {
  return two_slabs(question, {"second/Gap=" + gap, "ball/Shape=cylinder", "ball/Height=100 mm"});
}

TEST(Settled, ABodyThatMayMeetTheNextOneFirstIsFollowedUntilItsTailHasLeft) {
  const std::string question = "  set Exit = ball through first\n";
  const Course near(plates_and_rod(question, "80 mm")), far(plates_and_rod(question, "120 mm"));
  EXPECT_NE(near.value("time_of_exit"), "null");
  EXPECT_GT(near.run.bodies.rigid("ball")->rear(), 10e-3);
  EXPECT_EQ(far.value("outcome"), "\"perforated\"");
  EXPECT_EQ(far.value("time_of_exit"), "null");
  EXPECT_LT(far.run.bodies.rigid("ball")->front(), 130e-3); // before the second plate
}

TEST(Settled, BetweenTwoPlatesARunThatIsAskedForBothGoesOn) {
  const Course course(plates_and_rod("  set Exit = ball through first, ball through second\n", "120 mm"));
  EXPECT_GT(course.run.bodies.rigid("ball")->front(), 140e-3); // behind both
  EXPECT_LT(std::stod(course.value("ball_second_exit_velocity")), std::stod(course.value("exit_velocity")));
  EXPECT_NE(course.value("fragments"), "null"); // the tail has left the first, not the second
  EXPECT_EQ(course.value("ball_second_fragments"), "null");
}

TEST(Settled, WhatOtherBodiesStillGiveIsNotSettled) {
  const Course course(two_slabs("  set Exit = ball through first\n  set Momentum = first\n"));
  EXPECT_EQ(course.value("first_settled"), "\"\"");
  EXPECT_EQ(course.value("first_not_settled"), "\"momentum");
}

TEST(Settled, ABodyThatHasTurnedIsFollowedThroughItsRecoil) {
  // The law of an elastic impact: the velocity that is told is that of the free flight, within a thousandth.
  const BallShot shot("20 m/s", "1e6 MPa");
  Simulation run = start(*shot.file);
  while (run.time < 2 * shot.run.time) run.advance();
  EXPECT_NEAR(run.bodies.rigid("ball")->velocity[2], -shot.number("rebound_velocity"), 0.02);
}

TEST(Answers, ARunWithoutQuestionsGoesOnToItsEndTime) {
  const auto file = two_slabs("");
  const Simulation run = start(*file);
  const Answers answers(file->run.answers, file->scene, file->run.fragments, "scene");
  EXPECT_TRUE(answers.empty());
  EXPECT_FALSE(answers.reached(run));
  EXPECT_EQ(answers.main_body(), "first");
}

} // namespace
} // namespace spall::test
