#pragma once

#include "macro/scene/scene_inputs.h"
#include "macro/setup/run_inputs.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace spall {

/// A scene file as it was read: the bodies and how they are computed. It stays where it is, as the parameters
/// are bound to it.
struct SceneFile {
  SceneInputs scene;
  RunInputs run;
  Parameters parameters;

  /// The keys of a scene with one body 'NAME', for `--help`.
  SceneFile();
  /// Reads a file with all its checks. @throws InputError
  SceneFile(const std::filesystem::path& file, const std::vector<std::string>& overrides);
  /// Help on the keys. @param topic as Parameters::help; the first part may be the name of any body
  /// @throws InputError
  std::string help(const std::string& topic) const;
  SceneFile(const SceneFile&) = delete;
  SceneFile& operator=(const SceneFile&) = delete;
};

} // namespace spall
