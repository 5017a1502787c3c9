#pragma once

#include "macro/output/numerical_error.h"
#include "macro/setup/scene_file.h"

#include <filesystem>
#include <string>
#include <vector>

namespace spall {

/// A way to compute a scene whose numerical error has been measured.
struct Alternative {
  std::string model;                  ///< for example "around the axis, 8.0 mm"
  std::vector<std::string> keys = {}; ///< Section/Key=value that choose it
  std::size_t points = 0;             ///< modelled, of the target or bar
  NumericalError error; ///< the largest of this spacing and of all finer ones that have been measured
  double seconds = 0;   ///< expected processor time, within a factor of three
};

/// Returns the ways to compute the first answer of a scene, cheapest first: symmetries that the scene has,
/// with spacings of the points at which errors were measured (NumericalError). Models around the axis are
/// left out where craters and fragments are asked for (Run/Until = answered), which need cracks along radii.
/// @throws InputError if the scene has neither a shot at a round target nor a bar
std::vector<Alternative> alternatives(const std::filesystem::path& file,
                                      const std::vector<std::string>& overrides);

/// Returns the cheapest way whose error is at most `accuracy` (1: the whole quantity). @throws InputError
/// naming the most accurate one if there is none. `file` names the input
const Alternative& cheapest(const std::vector<Alternative>& all, double accuracy, const std::string& file);

/// A line per way: model, points, error, time.
std::string table_of(const std::vector<Alternative>& all);
/// Says what was chosen, with which keys, and what is expected of it.
std::string in_words(const Alternative& chosen, double accuracy);

} // namespace spall
