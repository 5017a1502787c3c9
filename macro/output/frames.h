#pragma once

#include "macro/dynamics/simulation.h"
#include "macro/output/fragments.h"
#include "shared/provenance.h"

#include <filesystem>
#include <string>
#include <vector>

namespace spall {

class Hdf5File;

/// Description of a scene, which is written as attributes of fields.h5.
struct FrameDescription {
  std::vector<std::pair<std::string, std::string>> words;
  std::vector<std::pair<std::string, double>> numbers;
  /// Contours of rigid bodies of revolution: z, r, z, r ...
  std::vector<std::pair<std::string, std::vector<double>>> outlines;
};
/// Returns symmetry, spacing and provenance of a run.
FrameDescription describe_frames(const Simulation& run, const std::string& main_body,
                                 const Provenance& provenance);

/// Snapshots of all points: `fields.h5`, with `fields.xdmf` beside it for ParaView. Each frame has a file of
/// its own in the folder `fields`, to which those two link. So a crash while one is written does not damage
/// the others, and a run that continues from a checkpoint removes the later ones. The layout as read through
/// `fields.h5`: /NAME/initial_position (n x 3) and /NAME/volume (n) of every deformable body; /frames/NNN/
/// with the attribute time (s) and, for every rigid body, NAME_x, NAME_y, NAME_z (of its origin, m) and
/// NAME_qw to NAME_qz (quaternion that turns its axes into those of space); /NAME/outline (m x 2: z and
/// radius of its contour from tip to tail, m); /frames/NNN/NAME/ with the arrays position, velocity (n x 3),
/// pressure (Pa, compression positive), volume_ratio, and every history field of the material; bodies whose
/// fragments are needed also have `fragment`: the number of the fragment that a point belongs to, 0 for the
/// remainder. ParaView shows one block per body.
class Frames {
public:
  /// @param description attributes of fields.h5 that tell the report what it sees
  /// @param fragmented bodies whose fragments are written, and when two of their points hold together
  /// @param go_on leaves older frames as they are, until go_on() is called
  Frames(const std::filesystem::path& directory, const Simulation& run, FrameDescription description,
         const std::vector<std::string>& fragmented, const FragmentInputs& fragments, bool go_on = false);
  /// Loading changes no file. @throws InputError if a frame of the run is gone
  void transfer(Archive& archive);
  /// After loading: removes the frames that were written after the state was saved.
  void go_on() const;
  /// Adds a frame, unless there is one of this time already.
  void write(const Simulation& run);

private:
  /// The data of a body in every frame.
  struct Block {
    std::string name;
    std::vector<std::string> scalars;
    bool fragmented = false;
    Share share = {}; ///< this rank's share of the points
  };
  void find_shares(const Simulation& run);
  void write_initial(const Simulation& run) const;
  void write_block(Hdf5File& out, const Block& block, const Solid& solid) const;
  /// Writes the file that links to the frames, on the first rank.
  void write_index() const;
  void write_xdmf() const;
  /// Removes the frames from the n-th on.
  void remove_from(std::size_t n) const;

  std::filesystem::path directory, folder;
  Ranks ranks;
  FrameDescription description;
  std::vector<double> times;
  std::vector<Block> blocks;
  FragmentInputs fragments;
};

} // namespace spall
