#pragma once

#include "macro/scene/body_inputs.h"

#include <filesystem>
#include <vector>

namespace spall {

/// A fragment of a cloud: a rigid sphere.
struct CloudFragment {
  double mass;          ///< kg
  Vec3 place, velocity; ///< of its centre, m; m/s
};

/// Most fragments of a file: each of them is a body with columns of its own in history.csv.
inline constexpr std::size_t most_fragments = 500;

/// Reads a CSV file (read_number_rows) with the columns mass, x, y, z, vx, vy, vz, a row for each fragment.
/// @throws InputError: file, line, column, found, allowed.
std::vector<CloudFragment> read_fragments(const std::filesystem::path& file);

/// Makes a body of each fragment of a cloud's file: CLOUD_1, CLOUD_2 ..., spheres of the cloud's mean
/// density.
/// @param file names the input in messages  @throws InputError if the cloud lacks a density, has keys that
/// its fragments do not have, or the scene has symmetry planes
std::vector<BodyInputs> fragments_of(const BodyInputs& cloud, const SymmetryPlanes& planes,
                                     const std::string& file);

} // namespace spall
