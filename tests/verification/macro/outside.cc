// Bodies that come from outside as triangles, and shots that follow each other, through the program.

#include "tests/verification/macro/program.h"

#include "tests/unit/shape/stl.h"

namespace spall::test::of_outside {
namespace {

/// The shipped projectile, of facets of 1 / 48 of a turn: ogive of caliber radius head 3, 50.8 mm, 355.6 mm.
Triangles projectile() {
  const double r = 25.4e-3, arc = 6 * r, nose = std::sqrt(arc * arc - (arc - r) * (arc - r)), length = 0.3556;
  constexpr int rings = 26;
  std::vector<ContourPoint> outline;
  for (int i = 0; i <= rings; ++i) {
    const double from_shaft = nose * (1 - 1.0 * i / rings);
    outline.push_back(
        {-nose * i / rings, i == 0 ? 0 : std::sqrt(arc * arc - from_shaft * from_shaft) - arc + r});
  }
  outline.push_back({-length, r});
  outline.push_back({-length, 0});
  return turned_surface(outline, 48);
}
/// The 127 mm slab on few points, with other keys before these.
std::vector<std::string> coarse(const std::string& scene, const std::vector<std::string>& more) {
  return with({scene, "slab/Diameter=1 m", "slab/Rings=20", "slab/Layers=6", "slab/AFC/Crack model=isotropic",
               "Run/Until=settled"},
              more);
}
const std::string slab = SPALL_DATA "/scenes/slab_127.prm";
std::vector<std::string> from(const std::filesystem::path& file, const std::vector<std::string>& more) {
  return coarse(slab, with({"projectile/Shape=surface", "projectile/File=" + file.string()}, more));
}

// The slab is struck by facets that stay within 0.2 % of the radius of the round projectile. Its cracks have
// no directions, since those magnify what a first contact that differs by a facet begins.
TEST(FromOutside, AProjectileOfTrianglesLeavesTheSlabAsTheRoundOneThatItFollows) {
  Program round, facetted;
  write_stl(facetted.folder / "shot.stl", projectile(), 1e-3, true);
  ASSERT_EQ(round.run(coarse(slab, {})), 0) << round.text("stderr");
  ASSERT_EQ(facetted.run(from(facetted.folder / "shot.stl", {"projectile/Unit=mm"})), 0)
      << facetted.text("stderr");
  const auto velocity = [](const Program& program) {
    return std::stod(program.summary().at("exit_velocity"));
  };
  EXPECT_NEAR(velocity(facetted), velocity(round), 1);
  EXPECT_NE(facetted.text("out/resolved.prm").find("shot.stl"), std::string::npos);
}

TEST(FromOutside, BadSurfacesAreRefusedBeforeAnythingIsWritten) {
  Program program;
  const auto file = program.folder / "shot.stl";
  Triangles open = projectile();
  open.corners.pop_back();
  write_stl(file, open, 1e-3);
  program.expect_refused(from(file, {}), {"projectile/Unit", "none", "mm"});
  program.expect_refused(from(file, {"projectile/Unit=mm"}), {"shot.stl", "not closed"});
  Triangles beside = projectile();
  for (Vec3& x : beside.points) x[1] += 5e-3;
  write_stl(file, beside, 1e-3, true);
  program.expect_refused(from(file, {"projectile/Unit=mm"}), {"projectile/File", "plane y = 0"});
}

// The second shot into the same hole catches up with the first, and rigid bodies do not touch each other.
TEST(FromOutside, RigidShotsThatMeetStopTheRun) {
  Program program;
  std::filesystem::create_directory_symlink(SPALL_DATA, program.folder / "data");
  const auto scene = program.folder.write(
      "two.prm",
      "include data/scenes/slab_127.prm\nsubsection second\n  include data/projectiles/sap.prm\n"
      "  set Model = rigid\n  set Before = projectile\n  set Gap = 10 mm\n  set Velocity = 400 m/s\n"
      "end\n");
  EXPECT_EQ(program.run(coarse(scene.string(), {})), 3);
  EXPECT_NE(program.text("stdout").find("'second' cross"), std::string::npos);
  EXPECT_NE(program.text("stderr").find("'second' meet"), std::string::npos) << program.text("stderr");
}

} // namespace
} // namespace spall::test::of_outside
