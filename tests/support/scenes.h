#pragma once

#include "macro/setup/make_simulation.h"
#include "macro/setup/scene_file.h"
#include "tests/unit/shared/scratch_folder.h"

#include <memory>
#include <string>
#include <vector>

namespace spall::test {

/// Reads a scene of the data folder with overrides.
inline std::shared_ptr<SceneFile> shipped(const std::string& name,
                                          const std::vector<std::string>& overrides = {}) {
  return std::make_shared<SceneFile>(std::string(SPALL_DATA "/scenes/") + name, overrides);
}
/// Reads a scene from a text. Paths of `include` lines are relative to the data folder.
inline std::shared_ptr<SceneFile> written(const std::string& text,
                                          const std::vector<std::string>& overrides = {}) {
  const ScratchFolder folder;
  std::filesystem::create_directory_symlink(SPALL_DATA, folder / "data");
  return std::make_shared<SceneFile>(folder.write("scene.prm", text), overrides);
}

/// Makes the simulation of a scene, distributed over `ranks`.
inline Simulation start(const SceneFile& file, const Ranks& ranks = {}) {
  RunInputs inputs = file.run;
  inputs.solid.ranks = ranks;
  return make_simulation(file.scene, inputs);
}

} // namespace spall::test
