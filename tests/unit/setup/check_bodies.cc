// Tests that accepted bodies reproduce linear fields and are one piece, and that others are refused.

#include "macro/setup/check_bodies.h"

#include "shared/error.h"
#include "tests/support/small_bar.h"
#include "tests/unit/shared/scratch_folder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace spall::test {
namespace {

/// Makes a bar of 10 rings with cells that are `ratio` times as high as wide.
Bar bar_of_cells(double ratio, int layers, const std::vector<std::string>& symmetry) {
  const double width = 0.5e-3;
  return {.diameter = 20 * width,
          .height = layers * ratio * width,
          .filling = {10, layers, Boundary::centred},
          .planes = planes_of(symmetry),
          .velocity = 0};
}

/// Returns the largest error of the computed velocity gradient in a linear field, relative to the gradient.
double error_of_linear_field(Simulation& run) {
  Solid& solid = *run.bodies.solids[0];
  const bool axis = solid.ghosts.symmetry().axis;
  const double rate = 1e3, dt = 1e-9; // 1/s, s
  for (std::size_t i = 0; i < solid.points.owned; ++i) {
    const Vec3 x = solid.points.position[i];
    solid.points.velocity.set(i, {-rate * x[0], axis ? 0 : -rate * x[1], 2 * rate * x[2]});
  }
  solid.refresh();
  solid.update(dt, dt);
  double error = 0;
  for (std::size_t i = 0; i < solid.points.owned; ++i) {
    const Mat3& f = solid.points.relative[i];
    for (int c = 0; c < 3; ++c) {
      const double expected = c == 2 ? 2 : -1;
      error = std::max(error, std::abs((f(c, c) - 1) / (rate * dt) - expected));
    }
  }
  return error;
}

TEST(CheckBodies, WhatIsAcceptedReproducesLinearFieldsWhateverItsCells) {
  int accepted = 0, refused = 0;
  for (const std::vector<std::string>& planes :
       {std::vector<std::string>{}, {"x", "y"}, std::vector<std::string>{"axis"}})
    for (const double ratio : {0.08, 0.2, 0.37, 0.5, 0.7, 1.0, 1.4, 1.8, 2.0, 2.5, 3.3, 6.0})
      for (const int layers : {1, 2, 5}) {
        SolidInputs inputs;
        inputs.double_precision = true;
        Simulation run = bar_of_cells(ratio, layers, planes).shoot(inputs);
        try {
          check_bodies(run, inputs, "scene.prm");
        } catch (const InputError&) {
          ++refused;
          continue;
        }
        ++accepted;
        EXPECT_LT(error_of_linear_field(run), 1e-6) << ratio << " " << layers << " layers";
      }
  EXPECT_GT(accepted, 20);
  EXPECT_GT(refused, 20);
}

TEST(CheckBodies, ABodyOfCubesIsAcceptedAndOneOfTallCellsOrASingleLayerIsRefusedByName) {
  const SolidInputs inputs;
  Simulation cubes = bar_of_cells(1, 5, {}).shoot(inputs);
  EXPECT_NO_THROW(check_bodies(cubes, inputs, "scene.prm"));
  for (const auto& [ratio, layers] : {std::pair(4.0, 5), std::pair(1.0, 1)}) {
    Simulation run = bar_of_cells(ratio, layers, {}).shoot(inputs);
    const std::string message = message_of<InputError>([&] { check_bodies(run, inputs, "scene.prm"); });
    for (const char* part : {"scene.prm: ", "'bar'", "Layers", "2.0 times as high as wide"})
      EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

TEST(CheckBodies, ABodyInTwoPiecesIsRefused) {
  Points points = bar_of_cells(1, 10, {}).points();
  for (std::size_t i = 0; i < points.owned; ++i)
    if (points.position.component[2][i] > 2.5e-3) points.position.component[2][i] += 5e-3;
  points.initial_position = points.position;
  const SolidInputs inputs;
  Bodies bodies;
  bodies.solids.push_back(make_solid(aluminium(), points, SymmetryPlanes{}, inputs));
  Simulation run(std::move(bodies), ContactInputs{}, TimeInputs{.end_time = 1}, inputs.integration);
  const std::string message = message_of<InputError>([&] { check_bodies(run, inputs, "scene.prm"); });
  EXPECT_NE(message.find("2 pieces"), std::string::npos) << message;
}

TEST(CheckBodies, TheCheckLeavesTheRunAsItWas) {
  const SolidInputs inputs;
  Simulation checked = small_bar().shoot(inputs), plain = small_bar().shoot(inputs);
  check_bodies(checked, inputs, "scene.prm");
  for (int n = 0; n < 20; ++n) checked.advance(), plain.advance();
  const Points &a = checked.bodies.solids[0]->points, &b = plain.bodies.solids[0]->points;
  for (int c = 0; c < 3; ++c) EXPECT_EQ(a.velocity.component[c], b.velocity.component[c]);
}

} // namespace
} // namespace spall::test
