#include "macro/output/frames.h"

#include "shared/hdf5_file.h"
#include "tests/support/small_bar.h"
#include "tests/unit/shared/scratch_folder.h"

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
    const Hdf5File file(folder / "fields.h5", Hdf5File::Mode::read);
    const std::string group = "/frames/00" + std::to_string(frame);
    EXPECT_EQ(file.list("/frames").size(), static_cast<std::size_t>(frame) + 1);
    EXPECT_EQ(file.real_attribute(group, "time"), run.time);
    const auto x = file.read<float>(group + "/bar/position", 3),
               v = file.read<float>(group + "/bar/velocity", 3),
               p = file.read<float>(group + "/bar/pressure"),
               strain = file.read<float>(group + "/bar/plastic_strain"),
               ratio = file.read<float>(group + "/bar/volume_ratio");
    ASSERT_EQ(x.size(), 3 * n);
    ASSERT_EQ(p.size(), n);
    const Points& points = run.bodies.solids[0]->points;
    const auto expected = run.bodies.solids[0]->field("plastic_strain");
    for (std::size_t i = 0; i < n; ++i) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_FLOAT_EQ(x[3 * i + c], static_cast<float>(points.position[i][c]));
        EXPECT_FLOAT_EQ(v[3 * i + c], static_cast<float>(points.velocity[i][c]));
      }
      EXPECT_FLOAT_EQ(
          p[i], static_cast<float>(-trace(points.cauchy(i)) / 3)); // pressure is positive in compression
      EXPECT_FLOAT_EQ(ratio[i], static_cast<float>(determinant(points.deformation(i))));
      EXPECT_FLOAT_EQ(strain[i], static_cast<float>(expected[i]));
    }
    for (int step = 0; step < 20; ++step) run.advance();
  }
  const Hdf5File file(folder / "fields.h5", Hdf5File::Mode::read);
  EXPECT_EQ(file.read<float>("/bar/initial_position", 3).size(), 3 * n);
  EXPECT_EQ(file.read<float>("/bar/volume").size(), n);
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
  EXPECT_EQ(Hdf5File(folder / "fields.h5", Hdf5File::Mode::read).list("/frames").size(), 1u);
  run.advance();
  frames.write(run);
  frames.write(run);
  EXPECT_EQ(Hdf5File(folder / "fields.h5", Hdf5File::Mode::read).list("/frames").size(), 2u);
}

TEST(Frames, TheXdmfIsXmlAndNamesArraysThatExistWithTheirSizes) {
  const ScratchFolder folder;
  Simulation run = small_bar({"x", "y"}).shoot();
  Frames frames(folder.path, run, describe_frames(run, "bar", {}), {}, {});
  frames.write(run);
  run.advance();
  frames.write(run);
  const std::string parse = "/usr/bin/python3 -c \"import sys, xml.etree.ElementTree as e; "
                            "t = e.parse(sys.argv[1]).getroot(); assert len(t.findall('.//Time')) == 2\" '" +
                            (folder / "fields.xdmf").string() + "'";
  EXPECT_EQ(std::system(parse.c_str()), 0);
  const std::string text = read_text(folder / "fields.xdmf");
  const Hdf5File file(folder / "fields.h5", Hdf5File::Mode::read);
  const std::regex item("Dimensions=\"(\\d+)( 3)?\"[^>]*>(fields/\\d+.h5):([^<]+)<");
  int count = 0;
  for (std::sregex_iterator m(text.begin(), text.end(), item), end; m != end; ++m, ++count) {
    const std::size_t columns = (*m)[2].matched ? 3 : 1;
    const Hdf5File frame(folder / (*m)[3], Hdf5File::Mode::read);
    ASSERT_TRUE(frame.exists((*m)[4])) << (*m)[4];
    EXPECT_EQ(frame.read<float>((*m)[4], columns).size(), columns * std::stoul((*m)[1]));
  }
  EXPECT_GE(count, 2 * 5);
  EXPECT_EQ(file.text_attribute("/", "symmetry_planes"), "x y");
}

} // namespace
} // namespace spall::test
