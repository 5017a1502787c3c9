#pragma once

#include "macro/dynamics/simulation.h"
#include "macro/output/fragments.h"
#include "macro/output/xdmf.h"
#include "macro/shape/triangles.h"
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
};
/// Returns symmetry, spacing and provenance of a run.
FrameDescription describe_frames(const Simulation& run, const std::string& main_body,
                                 const Provenance& provenance);

/// Snapshots of all bodies: `fields.h5`, with `fields.xdmf` beside it for ParaView, which shows one block per
/// body: the points of a deformable one, the surface of a rigid one. Each frame has a file of its own in the
/// folder `fields`, to which those two link. So a crash while one is written does not damage the others, and
/// a run that continues from a checkpoint removes the later ones. Every array has the attribute `unit`.
///
/// The layout as read through `fields.h5`, for every deformable body NAME of n points:
///   /NAME/initial_position (n x 3), /NAME/volume (n), /NAME/spacing (n)
///   /frames/FFF/NAME/      position, displacement, velocity (n x 3), pressure (compression positive),
///                          equivalent_stress (von Mises), volume_ratio, every history field of the material;
///                          fragment, if its fragments are needed: the number of the fragment that a point
///                          belongs to, 0 for the remainder
/// and for every rigid body with an end, whose surface has m points:
///   /NAME/outline          contour from tip to tail: z and radius
///   /NAME/triangles        its surface: three points each
///   /frames/FFF/NAME/      position, displacement, velocity (m x 3) of the points of the surface
/// and for the reinforcing bars of a body, "NAME bars", whose s segments have two points each:
///   /NAME bars/segments    (s x 2): the points of each segment
///   /frames/FFF/NAME bars/ position, displacement, velocity (2s x 3), axial_stress, plastic_strain
///                          (accumulated), ruptured (0 or 1), slip (of the node against the concrete)
/// A frame /frames/FFF has the attributes time (s) and, for every rigid body, NAME_x, NAME_y, NAME_z (of its
/// origin, m) and NAME_qw to NAME_qz (quaternion that turns its axes into those of space).
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
  /// An array in every frame.
  struct Field {
    std::string name, unit;
    std::size_t columns = 1;
  };
  /// A deformable body.
  struct Cloud {
    std::string name;
    std::vector<Field> fields;
    bool fragmented = false;
    Share share = {}; ///< this rank's share of the points
  };
  /// A rigid body with an end.
  struct Surface {
    std::size_t body; ///< index among the rigid bodies
    std::string name;
    Triangles triangles;
    std::vector<Vec3> start; ///< its points at the start, m
  };
  /// The bars of a body: two points for each segment, so that a value belongs to one segment.
  struct Bars {
    std::string name;
    std::size_t segments;
  };
  /// The fields of every body, rigid or deformable.
  static std::vector<Field> fields_of_motion();
  static std::vector<Field> fields_of(const Solid& solid, bool fragmented);
  static std::vector<Field> fields_of_bars();
  /// The values at this rank's points, row by row.
  std::vector<float> values_of(const Solid& solid, const std::string& field) const;
  void find_shares(const Simulation& run);
  void write_initial(const Simulation& run) const;
  void write_initial(Hdf5File& out, const Cloud& cloud, const Points& points) const;
  void write_initial(Hdf5File& out, const Surface& surface, const std::vector<ContourPoint>& contour) const;
  void write_surface(Hdf5File& out, const Surface& surface, const RigidBody& body) const;
  void write_bars(Hdf5File& out, const Reinforcement& bars) const;
  /// Writes the files that refer to the frames, on the first rank.
  void write_index() const;
  XdmfGrid grid_of(const Cloud& cloud, std::size_t frame) const;
  XdmfGrid grid_of(const Surface& surface, std::size_t frame) const;
  static XdmfGrid grid_of(const Bars& bars, std::size_t frame);
  /// Points and fields of a body in a frame, without cells.
  static XdmfGrid grid_of(const std::string& body, const std::vector<Field>& fields, std::size_t points,
                          std::size_t frame);
  /// Removes the frames from the n-th on.
  void remove_from(std::size_t n) const;

  std::filesystem::path directory, folder;
  Ranks ranks;
  FrameDescription description;
  std::vector<double> times;
  std::vector<Cloud> clouds;
  std::vector<Surface> surfaces;
  std::vector<Bars> reinforcements;
  FragmentInputs fragments;
};

} // namespace spall
