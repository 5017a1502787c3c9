#pragma once

#include "macro/contact/rigid_contact.h"
#include "macro/dynamics/solid.h"
#include "shared/provenance.h"

#include <filesystem>
#include <string>
#include <vector>

namespace spall {

/// Snapshots of all points in `fields.h5`, with `fields.xdmf` beside it for ParaView. Layout:
/// /initial_position (n x 3), /volume (n); /frames/NNN/ with attributes time (s) and projectile_position (z
/// of the tip, m), arrays position, velocity (n x 3), pressure (Pa, compression positive), volume_ratio, and
/// every history field of the material. The file is closed after each frame, so that whatever ends the run
/// leaves it readable.
class Frames {
public:
  /// Creates the file. Attributes describe the scene for the report.
  Frames(const std::filesystem::path& directory, const Solid& solid, const RigidBody& body,
         const std::string& scene, double thickness, const Provenance& provenance);
  void write(const Solid& solid, const RigidBody& body, double time);

private:
  void write_xdmf() const;
  std::filesystem::path file, xdmf;
  std::vector<double> times;
  std::vector<std::string> scalars;
  std::size_t count;
};

} // namespace spall
