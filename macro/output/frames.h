#pragma once

#include "macro/dynamics/simulation.h"
#include "shared/provenance.h"

#include <filesystem>
#include <string>
#include <vector>

namespace spall {

/// Snapshots of all points in `fields.h5`, with `fields.xdmf` beside it for ParaView. Layout:
/// /initial_position (n x 3), /volume (n); /frames/NNN/ with attributes time (s) and projectile_position (z
/// of the tip, m), arrays position, velocity (n x 3), pressure (Pa, compression positive), volume_ratio, and
/// every history field of the material. Those are of the first body; each other has the same arrays in
/// /NAME/ and /frames/NNN/NAME/ (ParaView shows one block per body). The file is closed after each frame, so
/// that whatever ends the run leaves it readable.
class Frames {
public:
  /// Creates the file. Attributes describe the scene for the report.
  Frames(const std::filesystem::path& directory, const Simulation& run, const std::string& scene,
         double thickness, const Provenance& provenance);
  void write(const Simulation& run);

private:
  /// What a body has in every frame.
  struct Block {
    std::string name;
    std::string prefix; ///< of its arrays: empty for the first body, else NAME/
    std::vector<std::string> scalars;
    std::size_t count; ///< points
  };
  void write_xdmf() const;
  std::filesystem::path file, xdmf;
  std::vector<double> times;
  std::vector<Block> blocks;
};

} // namespace spall
