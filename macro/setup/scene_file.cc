#include "macro/setup/scene_file.h"

#include "shared/error.h"

#include <algorithm>

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
  scene.add_fragments(file.string());
  scene.validate(file.string());
  run.validate(file.string());
  // Questions about bodies that do not exist are refused here, before anything is computed.
  Answers(run.answers, scene, run.fragments, file.string());
}

std::string SceneFile::help(const std::string& topic) const {
  const std::size_t slash = topic.find('/');
  const std::vector<std::string>& own = SceneInputs::own_sections();
  if (slash == std::string::npos || std::find(own.begin(), own.end(), topic.substr(0, slash)) != own.end())
    return parameters.help(topic);
  try {
    return parameters.help(topic);
  } catch (const InputError&) {
    return parameters.help("NAME" + topic.substr(slash));
  }
}

} // namespace spall
