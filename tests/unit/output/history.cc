#include "macro/output/history.h"

#include "tests/support/small_bar.h"
#include "tests/unit/shared/scratch_folder.h"

#include <map>
#include <numbers>
#include <sstream>

namespace spall::test {
namespace {

/// Reads history.csv as columns by name.
std::map<std::string, std::vector<double>> columns(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line, cell;
  std::getline(stream, line);
  std::vector<std::string> names;
  for (std::stringstream cells(line); std::getline(cells, cell, ',');) names.push_back(cell);
  std::map<std::string, std::vector<double>> table;
  while (std::getline(stream, line)) {
    std::stringstream cells(line);
    for (const std::string& name : names) {
      EXPECT_TRUE(std::getline(cells, cell, ',')) << name;
      table[name].push_back(std::stod(cell));
    }
    EXPECT_FALSE(std::getline(cells, cell, ',')) << "more cells than names";
  }
  return table;
}

std::map<std::string, std::vector<double>> history_of(Simulation run, int steps) {
  const ScratchFolder folder;
  {
    History history(folder.path, {"bar", "bar"});
    history.write(run);
    for (int i = 0; i < steps; ++i) {
      run.advance();
      history.write(run);
    }
  }
  return columns(folder / "history.csv");
}

TEST(History, BeginsWithTheStateOfTheWholeBarAtImpact) {
  const double mass = 2700 * std::numbers::pi * 16e-6 * 8e-3, v = 373;
  for (const std::vector<std::string>& symmetry : {std::vector<std::string>{}, {"x", "y"}}) {
    const auto h = history_of(small_bar(symmetry).shoot(), 0);
    EXPECT_EQ(h.at("time").at(0), 0);
    EXPECT_NEAR(h.at("projectile_position").at(0), 4e-3, 1e-12);
    EXPECT_NEAR(h.at("projectile_velocity").at(0), -v, 1e-9);
    EXPECT_NEAR(h.at("kinetic_energy").at(0), 0.5 * mass * v * v, 1e-9 * mass * v * v);
    EXPECT_NEAR(h.at("momentum").at(0), -mass * v, 1e-9 * mass * v);
    for (const char* zero : {"contact_force", "internal_energy", "stabilization_energy", "friction_work",
                             "contact_work", "projectile_kinetic_energy", "energy_error", "impulse"})
      EXPECT_EQ(h.at(zero).at(0), 0) << zero;
  }
}

TEST(History, AStepHasOneLine) {
  const ScratchFolder folder;
  Simulation run = small_bar().shoot();
  History history(folder.path, {"bar", "bar"});
  history.write(run);
  history.write(run);
  run.advance();
  history.write(run);
  history.write(run);
  EXPECT_EQ(columns(folder / "history.csv").at("time").size(), 2u);
}

TEST(History, EnergiesAddUpAndImpulseIsTheChangeOfMomentum) {
  const auto h = history_of(small_bar().shoot(), 60);
  ASSERT_EQ(h.at("time").size(), 61u);
  const double initial = h.at("total_energy").at(0);
  for (std::size_t i = 0; i < 61; ++i) {
    double sum = 0;
    for (const char* part : {"kinetic_energy", "internal_energy", "stabilization_energy", "friction_work",
                             "contact_work", "projectile_kinetic_energy"})
      sum += h.at(part)[i];
    EXPECT_NEAR(h.at("total_energy")[i], sum, 1e-9 * initial);
    EXPECT_NEAR(h.at("internal_energy")[i],
                h.at("shear_work")[i] + h.at("compression_work")[i] + h.at("tension_work")[i],
                1e-9 * initial);
    EXPECT_NEAR(h.at("energy_error")[i], sum / initial - 1, 1e-9);
    // Internal forces are summed in single precision, so their sum is not exactly zero.
    EXPECT_NEAR(h.at("momentum")[i] - h.at("momentum")[0], h.at("impulse")[i],
                1e-7 * std::abs(h.at("momentum")[0]));
    if (i > 0) {
      EXPECT_NEAR(h.at("time")[i] - h.at("time")[i - 1], h.at("time_step")[i], 1e-15);
    }
  }
  // The force is the rate of the impulse; the contact pushes the bar up and the wall down.
  EXPECT_NEAR(-h.at("contact_force")[60] * h.at("time_step")[60], h.at("impulse")[60] - h.at("impulse")[59],
              1e-9 * std::abs(h.at("impulse")[60]));
  EXPECT_GT(h.at("impulse")[60], 0);
}

TEST(History, TellsPlaceAndRotationOfEveryBodyThatCanMove) {
  Bodies bodies;
  bodies.solids.push_back(small_bar().solid());
  bodies.rigids.push_back(wall_at_zero());
  bodies.rigids.push_back({.shape = Block{.width = 1e-3, .depth = 1e-3, .height = 1e-3},
                           .mass = 0.01,
                           .position = {0.1, 0, 0.1},
                           .velocity = {20, 0, -100},
                           .free = {true, true, true},
                           .turns = {true, true, true},
                           .moments = {1e-8, 1e-8, 1e-8},
                           .orientation = about_axis(1, 0.4),
                           .angular_momentum = {0, 3e-5, 0}});
  bodies.rigids.back().name = "steel dart";
  const auto h = history_of({std::move(bodies), {}, {.end_time = 1}, {}}, 30);
  EXPECT_FALSE(h.count("wall_x"));
  for (std::size_t i = 0; i < 31; ++i) {
    const double t = h.at("time")[i];
    EXPECT_NEAR(h.at("steel_dart_x")[i], 0.1 + 20 * t, 1e-12);
    EXPECT_NEAR(h.at("steel_dart_y")[i], 0, 1e-12);
    EXPECT_NEAR(h.at("steel_dart_z")[i], 0.1 - 100 * t, 1e-12);
    EXPECT_NEAR(h.at("steel_dart_rotation_x")[i], 0, 1e-12);
    EXPECT_NEAR(h.at("steel_dart_rotation_y")[i], 0.4 + 3e3 * t, 1e-9);
    EXPECT_NEAR(h.at("steel_dart_rotation_z")[i], 0, 1e-12);
    EXPECT_NEAR(h.at("bar_z")[i], h.at("projectile_position")[i], 1e-12);
    EXPECT_NEAR(h.at("bar_x")[i], 0, 1e-9);
    EXPECT_NEAR(h.at("bar_rotation_y")[i], 0, 1e-6);
  }
  EXPECT_GT(h.at("time")[30], 0);
}

TEST(History, CentreOfMassIsTheMassWeightedMean) {
  Points points;
  points.resize(2);
  points.position.set(0, {0, 0, 1}), points.position.set(1, {0, 0, 4});
  points.mass = {2, 1};
  EXPECT_EQ(centre_of_mass(points), 2);
}

} // namespace
} // namespace spall::test
