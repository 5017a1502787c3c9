#pragma once

#include "macro/setup/scene_simulation.h"
#include "tests/unit/output/small_bar.h"

#include <functional>
#include <string>
#include <vector>

namespace spall::test {

/// A scene and its numerics by name.
struct Case {
  std::string name;
  SceneInputs scene{};
  RunInputs numerics{};
  double tolerance = 1e-9; ///< of what round-off has become after some hundred steps
};
inline void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

/// A quarter of an aluminium bar on a rigid wall.
inline Case bar(const std::string& name, const std::function<void(RunInputs&)>& change = {}) {
  Case c{.name = name};
  c.scene = small_bar(Boundary::centred, {"x", "y"});
  c.scene.filling = {7, 14, Boundary::centred}; // five blocks: at least one for each of four ranks
  c.scene.contact.friction = 0.1;
  c.numerics.solid.double_precision = true;
  c.numerics.time.verify_every = 50;
  c.numerics.solid.integration.refresh_interval = 7;
  if (change) change(c.numerics);
  return c;
}

inline Case scheme(const std::string& name, Scheme which) {
  return bar(name, [&](RunInputs& n) {
    n.solid.integration.scheme = which;
    if (is_conforming(which)) n.solid.approximation.configuration = Configuration::lagrangian;
  });
}

/// A scene file with other values.
inline Case scene(const std::string& name, const std::string& file,
                  const std::vector<std::string>& overrides) {
  Case c{.name = name};
  Parameters parameters;
  c.scene.declare(parameters);
  c.numerics.declare(parameters);
  parameters.read(std::string(SPALL_DATA "/scenes/") + file, overrides);
  c.scene.validate(file);
  c.numerics.validate(file);
  c.numerics.time.verify_every = 50;
  return c;
}

/// The first steps of an ogive through concrete, regions that are quiet left out of refreshes.
inline Case slab(const std::string& name, bool double_precision, double tolerance) {
  Case c = scene(name, "slab_127.prm",
                 {"AFC/Damage table=", "Body/Diameter=0.3 m", "Body/Rings=12", "Body/Layers=8",
                  std::string("Approximation/Double precision=") + (double_precision ? "yes" : "no")});
  c.tolerance = tolerance;
  return c;
}

/// Several bodies that meet within a few steps.
inline Case bodies(const std::string& name, const std::string& file, std::vector<std::string> overrides,
                   const std::vector<std::string>& more = {}) {
  overrides.insert(overrides.end(), more.begin(), more.end());
  overrides.push_back("Approximation/Double precision=yes");
  return scene(name + "_bodies", file, overrides);
}
inline const std::vector<std::string> small_anvil = {"Body/Rings=5", "Body/Layers=20", "Anvil/Rings=8",
                                                     "Anvil/Layers=6"},
                                      small_slab = {"AFC/Damage table=", "Body/Diameter=0.2 m",
                                                    "Body/Rings=8", "Body/Layers=6"},
                                      plate_behind = {"Body/Height=30 mm", "Body/Layers=3",
                                                      "Witness/Distance=0 mm", "Witness/Diameter=0.2 m",
                                                      "Witness/Rings=10"};

/// All that is different in a step: schemes, precision, configurations, symmetries, and kinds of contact.
inline std::vector<Case> scheme_cases() {
  return {bar("NSNI"),
          bar("NSNI_regions_left_out", [](RunInputs& n) { n.solid.integration.least_deformation = 1e-3; }),
          scheme("SNNI", Scheme::snni),
          scheme("M_SNNI", Scheme::m_snni),
          scheme("sub_points", Scheme::subpoint),
          bar("Lagrangian",
              [](RunInputs& n) { n.solid.approximation.configuration = Configuration::lagrangian; }),
          bar("corrected", [](RunInputs& n) { n.solid.integration.correction = Correction::linear; }),
          bar("damped", [](RunInputs& n) { n.time.gamma = 0.6; }),
          bodies("anvil", "taylor_aluminium_anvil.prm", small_anvil),
          bodies("kernels", "taylor_aluminium_anvil.prm", small_anvil, {"Contact/Scheme=kernel"}),
          bodies("projectile", "slab_127_deformable.prm", small_slab),
          bodies("witness", "slab_127_witness.prm", small_slab, plate_behind),
          bodies("culvert", "slab_127.prm", small_slab, {"Rim/Model=culvert"}),
          scene("axis_bar", "taylor_aluminium.prm",
                {"Scene/Symmetry planes=axis", "Body/Rings=10", "Body/Layers=60",
                 "Approximation/Double precision=yes"}),
          bodies("axis", "taylor_aluminium_anvil.prm", {"Scene/Symmetry planes=axis"},
                 {"Body/Rings=10", "Body/Layers=40", "Anvil/Rings=20", "Anvil/Layers=14"}),
          scheme("SCNI", Scheme::scni),
          scheme("M_SCNI", Scheme::m_scni),
          slab("slab", true, 1e-9),
          slab("slab_single_precision", false, 1e-3)};
}

} // namespace spall::test
