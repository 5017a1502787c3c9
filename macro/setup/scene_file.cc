#include "macro/setup/scene_file.h"

namespace spall {

SceneFile::SceneFile() {
  scene.bodies.emplace_back("NAME");
  scene.declare(parameters);
  run.declare(parameters);
}

SceneFile::SceneFile(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  const InputText text = InputText::read(file);
  scene.find_bodies(text, overrides);
  scene.declare(parameters);
  run.declare(parameters);
  parameters.read(text, overrides);
  scene.validate(file.string());
  run.validate(file.string());
  // Questions about bodies that do not exist are refused here, before anything is computed.
  Answers(run.answers, scene, run.fragments, file.string());
}

} // namespace spall
