#pragma once

#include "macro/dynamics/simulation.h"
#include "macro/output/fragments.h"
#include "shared/provenance.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace spall {

class Hdf5File;

/// Snapshots of all points: `fields.h5`, with `fields.xdmf` beside it for ParaView. Each frame has a file of
/// its own in the folder `fields`, to which those two lead: what ends the run while one is written leaves the
/// others alone, and a run that goes on from a checkpoint drops those after it. Layout seen through
/// `fields.h5`:
/// /initial_position (n x 3), /volume (n); /frames/NNN/ with attributes time (s) and projectile_position (z
/// of the tip, m), arrays position, velocity (n x 3), pressure (Pa, compression positive), volume_ratio, and
/// every history field of the material; `fragment`, if asked for: the number of the body's fragment a point
/// belongs to, 0 for the remainder. Those are of the first body; each other has the same arrays in /NAME/ and
/// /frames/NNN/NAME/ (ParaView shows one block per body).
class Frames {
public:
  /// Attributes describe the scene for the report.
  /// @param go_on leaves older frames as they are, until transfer() says which belong to the run
  Frames(const std::filesystem::path& directory, const Simulation& run, const std::string& scene,
         double thickness, const Provenance& provenance, bool go_on = false,
         const std::optional<FragmentInputs>& fragments = {});
  void transfer(Archive& archive);
  void write(const Simulation& run);

private:
  /// What a body has in every frame.
  struct Block {
    std::string name;
    std::string prefix; ///< of its arrays: empty for the first body, else NAME/
    std::vector<std::string> scalars;
    Share share = {}; ///< this rank's points of all
  };
  void find_shares(const Simulation& run);
  void write_initial(const Simulation& run) const;
  static void write_block(Hdf5File& out, const Block& block, const Solid& solid);
  /// The files that lead to the frames. On the first rank.
  void write_index() const;
  void write_xdmf() const;
  /// Removes the frames from the n-th on.
  void remove_from(std::size_t n) const;

  /// What describes the scene, as attributes of fields.h5.
  struct Description {
    std::vector<std::pair<std::string, std::string>> words;
    std::vector<std::pair<std::string, double>> numbers;
  };
  std::filesystem::path directory, folder;
  Ranks ranks;
  Description description;
  std::vector<double> times;
  std::vector<Block> blocks;
  std::optional<FragmentInputs> fragments; ///< of the first body
  double height;                           ///< of the body, m
};

} // namespace spall
