#pragma once

#include "tests/support/scenes.h"

#include <ostream>
#include <string>
#include <vector>

namespace spall::test {

/// A named scene with its numerics. The scene is read when a test needs it, because lists of cases are made
/// before any test runs.
struct Case {
  std::string name;
  std::string scene; ///< a file of the data folder, or the text of a scene
  std::vector<std::string> overrides;
  double tolerance = 1e-9; ///< tolerance for the effect of round-off after some hundred steps

  std::shared_ptr<SceneFile> file() const {
    return scene.ends_with(".prm") ? shipped(scene, overrides) : written(scene, overrides);
  }
};
inline void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }
inline Simulation start(const Case& c, const Ranks& ranks = {}) { return start(*c.file(), ranks); }

inline std::vector<std::string> joined(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// Makes a quarter of an aluminium bar on a rigid wall, with five blocks of points, so that each of four
/// ranks has at least one.
inline Case bar(const std::string& name, const std::vector<std::string>& changes = {}) {
  const char* text =
      "subsection Scene\n  set Symmetry planes = x, y\nend\n"
      "subsection bar\n  include data/materials/aluminium_6061_t6.prm\n  set Shape = cylinder\n"
      "  set Diameter = 8 mm\n  set Height = 8 mm\n  set Rings = 7\n  set Layers = 14\n"
      "  set Velocity = -373 m/s\nend\n"
      "subsection wall\n  set Model = rigid\n  set Shape = half space\n  set Before = bar\nend\n"
      "subsection Answers\n  set Length = bar\nend\n"
      "subsection Approximation\n  set Double precision = yes\nend\n"
      "subsection Integration\n  set Refresh interval = 7\nend\n"
      "subsection Contact\n  set Friction = 0.1\nend\n"
      "subsection Time\n  set End time = 1 s\n  set Verify step every = 50\nend\n";
  return {name, text, changes};
}

inline Case scheme(const std::string& name, const std::string& which,
                   const std::vector<std::string>& more = {}) {
  return bar(name, joined({"Integration/Scheme=" + which}, more));
}

/// Makes a case from a scene file with overrides.
inline Case scene(const std::string& name, const std::string& file,
                  const std::vector<std::string>& overrides) {
  return {name, file, joined(overrides, {"Time/Verify step every=50"})};
}

/// Makes the first steps of an ogive in concrete; refreshes skip regions without deformation.
inline Case slab(const std::string& name, bool double_precision, double tolerance) {
  Case c = scene(name, "slab_127.prm",
                 {"AFC/Damage table=", "AFC/T_max=1 GPa", "AFC/Crack model=isotropic", "slab/Diameter=0.3 m",
                  "slab/Rings=12", "slab/Layers=8",
                  std::string("Approximation/Double precision=") + (double_precision ? "yes" : "no")});
  c.tolerance = tolerance;
  return c;
}

/// Makes a case of several bodies that come into contact within a few steps.
inline Case bodies(const std::string& name, const std::string& file,
                   const std::vector<std::string>& overrides, const std::vector<std::string>& more = {}) {
  return scene(name + "_bodies", file,
               joined(joined(overrides, more), {"Approximation/Double precision=yes"}));
}
inline const std::vector<std::string>
    small_anvil = {"bar/Rings=5", "bar/Layers=20", "anvil/Rings=8", "anvil/Layers=6"},
    small_slab = {"AFC/Damage table=",   "AFC/T_max=1 GPa", "AFC/Crack model=isotropic",
                  "slab/Diameter=0.2 m", "slab/Rings=8",    "slab/Layers=6"},
    plate_behind = {"slab/Height=30 mm", "slab/Layers=3", "witness/Gap=0 mm", "witness/Diameter=0.2 m",
                    "witness/Rings=10"};

/// A mesh of bars in that slab, which the projectile hits and breaks.
inline const std::vector<std::string> small_mesh = {"slab/Reinforcement/Faces=both",
                                                    "slab/Reinforcement/Bar diameter=8 mm",
                                                    "slab/Reinforcement/Spacing=40 mm",
                                                    "slab/Reinforcement/Cover=15 mm",
                                                    "slab/Reinforcement/Young's modulus=200 GPa",
                                                    "slab/Reinforcement/Yield stress=500 MPa",
                                                    "slab/Reinforcement/Hardening modulus=1 GPa",
                                                    "slab/Reinforcement/Rupture strain=0.01",
                                                    "slab/Reinforcement/Density=7850 kg/m3",
                                                    "slab/Reinforcement/Concrete strength=48 MPa",
                                                    "slab/Reinforcement/Rib spacing=5 mm"};

/// A case in which the contact of two deformable bodies magnifies round-off: by 20 in the first 200 steps.
inline Case magnified(Case c) {
  c.tolerance = 1e-7;
  return c;
}

/// Cases for all variants of a step: schemes, precision, configurations, symmetries, and kinds of contact.
inline std::vector<Case> scheme_cases() {
  const std::vector<std::string> lagrangian = {"Approximation/Configuration=Lagrangian"};
  return {
      bar("NSNI"),
      bar("NSNI_regions_left_out", {"Integration/Least deformation=0.001"}),
      scheme("SNNI", "SNNI"),
      scheme("M_SNNI", "M-SNNI"),
      scheme("sub_points", "SUBPOINT"),
      bar("Lagrangian", lagrangian),
      bar("corrected", {"Integration/Variational correction=linear"}),
      bar("damped", {"Time/Newmark gamma=0.6"}),
      bodies("anvil", "taylor_aluminium_anvil.prm", small_anvil),
      bodies("kernels", "taylor_aluminium_anvil.prm", small_anvil, {"Contact/Scheme=kernel"}),
      magnified(bodies("projectile", "slab_127_deformable.prm", small_slab)),
      bodies("witness", "slab_127_witness.prm", small_slab, plate_behind),
      bodies("culvert", "slab_127.prm", small_slab, {"culvert/Model=ring"}),
      bodies("clamped", "slab_127.prm", small_slab, {"slab/Supports=clamped"}),
      bodies("supported", "slab_127.prm", small_slab,
             {"slab/Supports=simple", "slab/Support diameter=0.15 m"}),
      bodies("reinforced", "slab_127.prm", small_slab, joined(small_mesh, {"slab/Reinforcement/Bond=slip"})),
      bodies("rigid_bond", "slab_127.prm", small_slab,
             joined(small_mesh, {"slab/Reinforcement/Offset=20 mm", "Scene/Symmetry planes=none"})),
      scene("axis_bar", "taylor_aluminium.prm",
            {"Scene/Symmetry planes=axis", "bar/Rings=10", "bar/Layers=60",
             "Approximation/Double precision=yes"}),
      bodies("axis", "taylor_aluminium_anvil.prm", {"Scene/Symmetry planes=axis"},
             {"bar/Rings=10", "bar/Layers=40", "anvil/Rings=20", "anvil/Layers=14"}),
      scheme("SCNI", "SCNI", lagrangian),
      scheme("M_SCNI", "M-SCNI", lagrangian),
      slab("slab", true, 1e-9),
      slab("slab_single_precision", false, 1e-3)};
}

} // namespace spall::test
