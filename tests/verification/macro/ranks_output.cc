// Tests that the files and answers of several processes of mpirun are those of one process.

#include "macro/output/answers.h"
#include "macro/output/frames.h"
#include "macro/restart/checkpoint.h"
#include "shared/error.h"
#include "shared/hdf5_file.h"
#include "shared/output_directory.h"
#include "tests/support/fields.h"
#include "tests/unit/shared/small_disk.h"
#include "tests/verification/macro/over_ranks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>

namespace spall::test {
namespace {

TEST(SpreadBody, AFullDiskLosesNoCheckpointThatIsThere_slab) {
  const SharedFolder folder;
  Simulation run = spread_slab();
  const auto state = [&](Archive& archive) { run.transfer(archive); };
  run.advance();
  Checkpoints checkpoints(folder.path, {}, {}, ranks);
  checkpoints.write(state);
  const std::string before = read_text(folder.path / "checkpoint.h5");
  run.advance();
  {
    const SmallDisk full(before.size() / 2);
    const std::string message = message_of<ComputationError>([&] { checkpoints.write(state); });
    EXPECT_NE(message.find("checkpoint.h5"), std::string::npos) << message;
  }
  EXPECT_EQ(read_text(folder.path / "checkpoint.h5"), before);
  if (ranks.first()) {
    for (const auto& entry : std::filesystem::directory_iterator(folder.path))
      EXPECT_FALSE(Temporary::is_one(entry.path())) << entry.path();
  }
  checkpoints.write(state);
  Simulation resumed = spread_slab();
  ASSERT_TRUE(checkpoints.find());
  checkpoints.load([&](Archive& archive) { resumed.transfer(archive); });
  EXPECT_EQ(resumed.steps, 2u);
}

/// Compares the arrays of a body in a frame, up to round-off.
void expect_same_frame(const Fields& a, const Fields& b, const std::string& group) {
  ASSERT_EQ(a.list(group), b.list(group));
  for (const std::string& array : a.list(group)) {
    const std::string path = group + "/" + array;
    const std::size_t columns = array == "position" || array == "velocity" || array == "displacement" ? 3 : 1;
    const auto x = a.read<float>(path, columns), y = b.read<float>(path, columns);
    ASSERT_EQ(x.size(), y.size());
    EXPECT_EQ(a.text_attribute(path, "unit"), b.text_attribute(path, "unit"));
    float largest = 0;
    for (const float value : x) largest = std::max(largest, std::abs(value));
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], y[i], 1e-5f * largest) << path;
  }
}

/// Compares all arrays of two files of fields, up to round-off.
void expect_same_fields(const std::filesystem::path& one, const std::filesystem::path& other) {
  const Fields a(one), b(other);
  ASSERT_EQ(a.list("/"), b.list("/"));
  EXPECT_EQ(a.read<float>("/slab/initial_position", 3), b.read<float>("/slab/initial_position", 3));
  for (const char* constant : {"/slab/volume", "/slab/spacing"})
    EXPECT_EQ(a.read<float>(constant), b.read<float>(constant));
  EXPECT_EQ(a.read<float>("/projectile/outline", 2), b.read<float>("/projectile/outline", 2));
  EXPECT_EQ(a.read<std::int64_t>("/projectile/triangles", 3),
            b.read<std::int64_t>("/projectile/triangles", 3));
  const Hdf5File first(one / "fields/initial.h5", Hdf5File::Mode::read),
      second(other / "fields/initial.h5", Hdf5File::Mode::read);
  EXPECT_EQ(first.read<std::int64_t>("/slab/vertices"), second.read<std::int64_t>("/slab/vertices"));
  ASSERT_EQ(a.list("/frames"), b.list("/frames"));
  for (const std::string& frame : a.list("/frames"))
    for (const char* body : {"/slab", "/projectile"}) expect_same_frame(a, b, "/frames/" + frame + body);
  const auto text = [](const std::filesystem::path& folder) { return read_text(folder / "fields.xdmf"); };
  const auto without_times = [](std::string all) {
    return std::regex_replace(all, std::regex("Time Value=\"[^\"]*\""), "");
  };
  EXPECT_EQ(without_times(text(one)), without_times(text(other)));
}

TEST(SpreadBody, WritesTheFilesOfOneProcess_slab) {
  const SharedFolder folder;
  const Case c = slab("slab", true, 0);
  Simulation whole = start(c), spread = start(c, ranks);
  Frames together(folder.path / "spread", spread, {}, {"slab"}, {});
  std::optional<Frames> alone;
  if (ranks.first())
    alone.emplace(folder.path / "whole", whole, FrameDescription{}, std::vector<std::string>{"slab"},
                  FragmentInputs{});
  for (int frame = 0; frame < 3; ++frame) {
    together.write(spread);
    if (alone) alone->write(whole);
    for (int step = 0; step < 40; ++step) spread.advance(), whole.advance();
  }
  if (ranks.first()) expect_same_fields(folder.path / "whole", folder.path / "spread");
}

/// Breaks a slab into bricks of 30 mm, some of which stay connected over their edges.
void break_up(Solid& solid) {
  Points& points = solid.points;
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 x = points.initial_position[i];
    const auto brick = [&](int c) { return static_cast<int>(std::abs(x[c]) / 30e-3); };
    const int kind = (brick(0) + 3 * brick(1) + brick(2)) % 5;
    points.position.set(i, add(points.position[i], kind * points.spacing[i], {0.1, 0.1, 0.4}));
    points.velocity.set(i, {0, 0, 10.0 * (kind - 1)});
  }
  solid.ghosts.refresh(points);
}

TEST(SpreadBody, HasTheAnswersOfOneProcess_slab) {
  const Case c = slab("slab", true, 0);
  Simulation whole = start(c), spread = start(c, ranks);
  for (int step = 0; step < 2; ++step) spread.advance(), whole.advance();
  break_up(*whole.bodies.solids[0]), break_up(*spread.bodies.solids[0]);
  const auto shot = [&](const Simulation& run) {
    Shot made("Exit", {"projectile", "slab"}, c.file()->scene, {}, "scene");
    Warnings warnings;
    made.measure(run, warnings, true);
    EXPECT_EQ(warnings, Warnings{});
    return made;
  };
  const Shot a = shot(whole), b = shot(spread);
  ASSERT_GT(a.fragments->list.size(), 5u);
  ASSERT_EQ(b.fragments->list.size(), a.fragments->list.size());
  for (std::size_t f = 0; f < a.fragments->list.size(); ++f) {
    const Fragment &x = a.fragments->list[f], &y = b.fragments->list[f];
    EXPECT_EQ(y.place, x.place);
    EXPECT_EQ(y.copies, x.copies);
    EXPECT_EQ(y.points, x.points);
    EXPECT_NEAR(y.mass, x.mass, 1e-12 * x.mass);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(y.centre[axis], x.centre[axis], 1e-9);
    EXPECT_NEAR(y.velocity[2], x.velocity[2], 1e-9);
  }
  EXPECT_EQ(b.fragments->modelled_points, a.fragments->modelled_points);
  const std::size_t first = spread.bodies.solids[0]->ghosts.remote_points().first();
  for (std::size_t i = 0; i < b.fragments->of_point.size(); ++i)
    EXPECT_EQ(b.fragments->of_point[i], a.fragments->of_point[first + i]);
  ASSERT_GT(a.craters->back.mean_diameter, 0);
  EXPECT_EQ(b.craters->radius, a.craters->radius);
  EXPECT_EQ(b.craters->back.outline, a.craters->back.outline);
  EXPECT_EQ(b.craters->front.depth, a.craters->front.depth);
}

TEST(SpreadBody, HasTheShapeOfOneProcess) {
  const Case c = bar("bar");
  Simulation whole = start(c), spread = start(c, ranks);
  for (int step = 0; step < 100; ++step) spread.advance(), whole.advance();
  const BarShape a = measure_bar(*whole.bodies.solids[0], Boundary::centred),
                 b = measure_bar(*spread.bodies.solids[0], Boundary::centred);
  EXPECT_NEAR(b.length, a.length, 1e-9 * a.length);
  EXPECT_NEAR(b.foot_diameter, a.foot_diameter, 1e-9 * a.foot_diameter);
  EXPECT_GT(a.plastic_strain_95, a.mean_plastic_strain);
  EXPECT_NEAR(b.plastic_strain_95, a.plastic_strain_95, 1e-7);
  EXPECT_NEAR(b.mean_plastic_strain, a.mean_plastic_strain, 1e-7);
  EXPECT_NEAR(b.max_plastic_strain, a.max_plastic_strain, 1e-7);
}

} // namespace
} // namespace spall::test
