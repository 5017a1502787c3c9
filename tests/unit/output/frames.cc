#include "macro/output/frames.h"

#include "shared/hdf5_file.h"
#include "tests/support/fields.h"
#include "tests/support/small_bar.h"
#include "tests/unit/shared/scratch_folder.h"

#include <cmath>
#include <cstdlib>
#include <regex>

namespace spall::test {
namespace {

TEST(Frames, HoldThePointsOfEveryFrameAndCanBeReadAfterEachOfThem) {
  const ScratchFolder folder;
  Simulation run = small_bar().shoot();
  const std::size_t n = run.bodies.solids[0]->points.owned;
  const Provenance provenance{"penetrate test", "bar.prm", "now", "set A = 1"};
  Frames frames(folder.path, run, describe_frames(run, "bar", provenance), {}, {});
  for (int frame = 0; frame < 3; ++frame) {
    frames.write(run);
    const Fields file(folder.path);
    const std::string group = "/frames/00" + std::to_string(frame);
    EXPECT_EQ(file.list("/frames").size(), static_cast<std::size_t>(frame) + 1);
    EXPECT_EQ(file.real_attribute(group, "time"), run.time);
    const auto x = file.read<float>(group + "/bar/position", 3),
               v = file.read<float>(group + "/bar/velocity", 3),
               p = file.read<float>(group + "/bar/pressure"),
               strain = file.read<float>(group + "/bar/plastic_strain"),
               shift = file.read<float>(group + "/bar/displacement", 3),
               stress = file.read<float>(group + "/bar/equivalent_stress"),
               ratio = file.read<float>(group + "/bar/volume_ratio");
    ASSERT_EQ(x.size(), 3 * n);
    ASSERT_EQ(p.size(), n);
    const Points& points = run.bodies.solids[0]->points;
    const auto expected = run.bodies.solids[0]->field("plastic_strain");
    for (std::size_t i = 0; i < n; ++i) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_FLOAT_EQ(x[3 * i + c], static_cast<float>(points.position[i][c]));
        EXPECT_FLOAT_EQ(v[3 * i + c], static_cast<float>(points.velocity[i][c]));
        EXPECT_FLOAT_EQ(shift[3 * i + c],
                        static_cast<float>(points.position[i][c] - points.initial_position[i][c]));
      }
      EXPECT_FLOAT_EQ(
          p[i], static_cast<float>(-trace(points.cauchy(i)) / 3)); // pressure is positive in compression
      EXPECT_FLOAT_EQ(ratio[i], static_cast<float>(determinant(points.deformation(i))));
      EXPECT_FLOAT_EQ(strain[i], static_cast<float>(expected[i]));
      const Sym3 s = points.cauchy(i); // xx, yy, zz, then the shear stresses
      const double mises =
          std::sqrt(0.5 * (std::pow(s[0] - s[1], 2) + std::pow(s[1] - s[2], 2) + std::pow(s[2] - s[0], 2)) +
                    3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
      EXPECT_NEAR(stress[i], mises, 1e-6 * mises);
    }
    for (int step = 0; step < 20; ++step) run.advance();
  }
  const Fields file(folder.path);
  EXPECT_EQ(file.read<float>("/bar/initial_position", 3).size(), 3 * n);
  EXPECT_EQ(file.read<float>("/bar/volume").size(), n);
  for (const float spacing : file.read<float>("/bar/spacing")) EXPECT_NEAR(spacing, 1e-3, 1e-4);
  EXPECT_EQ(file.text_attribute("/", "units"), "SI");
  EXPECT_EQ(file.text_attribute("/", "program"), "penetrate test");
  EXPECT_EQ(file.text_attribute("/", "input"), "set A = 1");
}

TEST(Frames, ATimeStandsThereOnce) {
  const ScratchFolder folder;
  Simulation run = small_bar().shoot();
  Frames frames(folder.path, run, describe_frames(run, "bar", {}), {}, {});
  frames.write(run);
  frames.write(run);
  EXPECT_EQ(Fields(folder.path).list("/frames").size(), 1u);
  run.advance();
  frames.write(run);
  frames.write(run);
  EXPECT_EQ(Fields(folder.path).list("/frames").size(), 2u);
}

/// A bar, and a cone that flies past it while it turns.
Simulation bar_and_cone() {
  Bodies bodies;
  bodies.solids.push_back(small_bar().solid());
  bodies.rigids.push_back(wall_at_zero());
  RigidBody cone{
      .shape =
          Revolution{.outer = ContourBuilder({0, 0}).line_to({-4e-3, 2e-3}).line_to({-4e-3, 0}).contour()},
      .mass = 0.01,
      .position = {0.1, 0, 0.1},
      .velocity = {20, 0, -100},
      .free = {true, true, true},
      .turns = {true, true, true},
      .centre = {0, 0, -3e-3},
      .moments = {1e-8, 1e-8, 2e-8},
      .orientation = about_axis(1, 0.4),
      .angular_momentum = {0, 3e-5, 0}};
  cone.name = "steel cone";
  bodies.rigids.push_back(cone);
  return {std::move(bodies), {}, {.end_time = 1}, {}};
}

TEST(Frames, ShowTheSurfaceOfARigidBodyAtItsPlaceAndAngle) {
  const ScratchFolder folder;
  Simulation run = bar_and_cone();
  Frames frames(folder.path, run, describe_frames(run, "bar", {}), {}, {});
  const RigidBody& cone = run.bodies.rigids[1];
  const std::vector<Vec3> points = triangles_of(cone.shape).points;
  std::vector<float> first;
  for (int frame = 0; frame < 3; ++frame) {
    frames.write(run);
    const Fields file(folder.path);
    const std::string group = "/frames/00" + std::to_string(frame) + "/steel cone/";
    const auto x = file.read<float>(group + "position", 3), v = file.read<float>(group + "velocity", 3),
               shift = file.read<float>(group + "displacement", 3);
    if (frame == 0) first = x;
    ASSERT_EQ(x.size(), 3 * points.size());
    RigidBody later = cone;
    later.move(1e-9);
    for (std::size_t i = 0; i < points.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(x[3 * i + c], cone.in_space(points[i])[c], 1e-8);
        EXPECT_NEAR(shift[3 * i + c], x[3 * i + c] - first[3 * i + c], 2e-8);
        EXPECT_NEAR(v[3 * i + c], (later.in_space(points[i])[c] - cone.in_space(points[i])[c]) / 1e-9, 1e-3);
      }
    EXPECT_FALSE(file.exists("/frames/000/wall")); // it has no end
    for (int step = 0; step < 20; ++step) run.advance();
  }
  const Fields file(folder.path);
  EXPECT_EQ(file.read<float>("/steel cone/outline", 2), (std::vector<float>{0, 0, -4e-3f, 2e-3f, -4e-3f, 0}));
  for (const std::int64_t corner : file.read<std::int64_t>("/steel cone/triangles", 3))
    EXPECT_LT(corner, static_cast<std::int64_t>(points.size()));
}

/// Returns the text between two marks, and removes it with everything before it.
std::string cut(std::string& text, const std::string& from, const std::string& to) {
  const std::size_t begin = text.find(from) + from.size(), end = text.find(to, begin);
  const std::string between = text.substr(begin, end - begin);
  text.erase(0, end);
  return between;
}

/// Expects that an array of the .xdmf file is there, with its size. @return the file and path of the array
std::pair<std::filesystem::path, std::string> expect_array(const std::string& item,
                                                           const std::filesystem::path& folder) {
  const std::regex form("Dimensions=\"(\\d+)( 3)?\" NumberType=\"(Int|Float)\"[^>]*>([^:]+):([^<]+)<");
  std::smatch m;
  EXPECT_TRUE(std::regex_search(item, m, form)) << item;
  const Hdf5File file(folder / m[4].str(), Hdf5File::Mode::read);
  const std::size_t columns = m[2].matched ? 3 : 1, size = columns * std::stoul(m[1]);
  if (m[3] == "Int")
    EXPECT_EQ(file.read<std::int64_t>(m[5], columns).size(), size) << item;
  else
    EXPECT_EQ(file.read<float>(m[5], columns).size(), size) << item;
  return {folder / m[4].str(), m[5]};
}

TEST(Frames, TheXdmfListsTheCellsAndTheFieldsOfEveryBodyWithTheirUnits) {
  const ScratchFolder folder;
  Simulation run = bar_and_cone();
  Frames frames(folder.path, run, describe_frames(run, "bar", {}), {"bar"}, {});
  frames.write(run);
  run.advance();
  frames.write(run);
  std::string text = read_text(folder / "fields.xdmf");
  int grids = 0, fields = 0;
  while (text.find("<Topology") != std::string::npos) {
    const std::string cells = cut(text, "<Topology", "</Topology>");
    const std::regex form(
        "NumberOfElements=\"(\\d+)\" NodesPerElement=\"(\\d)\"><DataItem Dimensions=\"(\\d+)( 3)?");
    std::smatch m;
    ASSERT_TRUE(std::regex_search(cells, m, form)) << cells;
    EXPECT_EQ(m[1], m[3]);
    EXPECT_EQ(m[2], m[4].matched ? "3" : "1");
    expect_array(cells, folder.path);
    expect_array(cut(text, "<Geometry", "</Geometry>"), folder.path);
    std::string grid = cut(text, "</Geometry>", "</Grid>");
    while (grid.find("<Attribute") != std::string::npos) {
      std::string field = cut(grid, "<Attribute", "</Attribute>");
      const auto [file, array] = expect_array(field, folder.path);
      EXPECT_EQ(cut(field, "Name=\"unit\" Value=\"", "\""),
                Hdf5File(file, Hdf5File::Mode::read).text_attribute(array, "unit"));
      ++fields;
    }
    ++grids;
  }
  EXPECT_EQ(grids, 2 * 2);
  EXPECT_GE(fields, 2 * (9 + 2));
}

TEST(Frames, TheXdmfIsXmlWhateverTheBodiesAreCalled) {
  const ScratchFolder folder;
  Simulation run = small_bar({"x", "y"}).shoot();
  run.bodies.solids[0]->label = "1 < \"bar\" & wall";
  Frames frames(folder.path, run, describe_frames(run, "1 < \"bar\" & wall", {}), {}, {});
  frames.write(run);
  run.advance();
  frames.write(run);
  const std::string parse = "/usr/bin/python3 -c \"import sys, xml.etree.ElementTree as e; "
                            "t = e.parse(sys.argv[1]).getroot(); assert len(t.findall('.//Time')) == 2; "
                            "assert len([g for g in t.iter('Grid') if ' & wall' in g.get('Name')]) == 2\" '" +
                            (folder / "fields.xdmf").string() + "'";
  EXPECT_EQ(std::system(parse.c_str()), 0);
  EXPECT_EQ(Fields(folder.path).text_attribute("/", "symmetry_planes"), "x y");
}

TEST(Frames, EveryArrayHasAUnit) {
  const ScratchFolder folder;
  Simulation run = bar_and_cone();
  Frames(folder.path, run, describe_frames(run, "bar", {}), {"bar"}, {}).write(run);
  const Fields file(folder.path);
  const auto expect_units = [&](const std::string& group, std::size_t least) {
    const std::vector<std::string> arrays = file.list(group);
    EXPECT_GE(arrays.size(), least) << group;
    for (const std::string& array : arrays)
      EXPECT_NE(file.text_attribute(group + "/" + array, "unit"), "") << group << "/" << array;
  };
  expect_units("/bar", 3);
  expect_units("/steel cone", 2);
  expect_units("/frames/000/bar", 8);
  expect_units("/frames/000/steel cone", 3);
}

} // namespace
} // namespace spall::test
