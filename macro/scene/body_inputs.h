#pragma once

#include "macro/contact/elastic_ring.h"
#include "macro/contact/held_points.h"
#include "macro/contact/rigid_body.h"
#include "macro/material/material_inputs.h"
#include "macro/points/ghosts.h"
#include "macro/scene/filling_inputs.h"
#include "macro/scene/reinforcement_inputs.h"
#include "macro/scene/shape_inputs.h"
#include "shared/input/parameters.h"

#include <optional>
#include <string>

namespace spall {

/// How a body is computed.
enum class BodyModel {
  deformable, ///< points with a material
  rigid,      ///< six unknowns at most
  ring,       ///< an elastic ring around another body
  none        ///< left out of the scene
};

/// Where a body is at the start. Every body but a ring is moved along z until its lowest or highest point is
/// where these keys say; x and y of its axis follow from the offsets.
struct PlaceInputs {
  std::string behind; ///< its lowest point is `gap` above the highest one of this body
  std::string before; ///< its highest point is `gap` below the lowest one of this body
  double gap = 0;     ///< m
  double lowest = 0;  ///< z of its lowest point if it is neither behind nor before another body, m
  double offset_x = 0, offset_y = 0; ///< m

  void declare(Parameters& parameters, const std::string& section);
};

/// How a body moves at the start: it flies in the x-z plane and spins about its axis.
struct MotionInputs {
  double velocity = 0;  ///< along its flight, m/s; positive towards +z
  double obliquity = 0; ///< of the flight from the z axis, towards +x, rad
  double attack = 0;    ///< of the body's axis from the flight, towards +x, rad
  double spin = 0;      ///< about the body's axis, rad/s
  /// Velocity of a fragment of a cloud, m/s, instead of velocity and obliquity.
  std::optional<Vec3> of_fragment;

  void declare(Parameters& parameters, const std::string& section);
  bool is_normal() const {
    return obliquity == 0 && attack == 0 &&
           (!of_fragment || ((*of_fragment)[0] == 0 && (*of_fragment)[1] == 0));
  }
  Vec3 velocity_vector() const;   ///< m/s
  Vec3 angular_velocity() const;  ///< rad/s
  Quaternion orientation() const; ///< turns the shape's axes into those of space
};

/// Mass and inertia of a body that does not follow from a material.
struct MassInputs {
  double mass = required, density = required; ///< kg, kg/m^3: one of the two
  /// From the origin of the shape against its axis (of a projectile: from the tip), m; about axes through it,
  /// kg m^2. NaN: of a homogeneous body of this shape and mass.
  double centre_of_mass = required, axial_moment = required, transverse_moment = required;

  void declare(Parameters& parameters, const std::string& section);
};

/// One body: a section of the scene file that has the body's name.
struct BodyInputs {
  explicit BodyInputs(std::string name_) : name(std::move(name_)) {}

  std::string name;
  BodyModel model = BodyModel::deformable;
  ShapeInputs shape;
  PlaceInputs place;
  MotionInputs motion;
  // rigid
  MassInputs mass;
  bool held = false;     ///< does not move
  std::string fragments; ///< file of a cloud, for which this body stands (fragment_cloud.h); empty: none
  // deformable
  bool has_material = false; ///< whether the file or the command line says which
  MaterialInputs material;
  FillingInputs filling;
  bool known_surface = false; ///< contact takes the surface of the shape, carried by the points
  BodySupportInputs support;
  ReinforcementInputs reinforcement;
  std::string bonded_to; ///< name of another deformable body; empty: none
  // ring
  std::string around;
  RingInputs ring;

  void declare(Parameters& parameters);
  /// Checks that go beyond one key. @throws InputError. `file` names the input in messages.
  void validate(const std::string& file, const SymmetryPlanes& planes) const;

  bool is_deformable() const { return model == BodyModel::deformable; }
  /// It stands for the fragments of a file, which are bodies of their own.
  bool is_cloud() const { return model == BodyModel::rigid && !fragments.empty(); }
  bool is_rigid() const { return model == BodyModel::rigid && !is_cloud(); }
  bool is_held() const { return is_rigid() && (held || shape.kind == ShapeKind::half_space); }
  /// Its shape begins with a tip at z = 0 and goes on towards -z; other shapes stand on z = 0.
  bool has_tip() const;
  /// It fills a place: deformable or rigid.
  bool has_shape() const { return is_deformable() || is_rigid(); }
  /// The shape with the wall of a casing that mass and density make, if that is how it is given.
  Shape solid_shape() const { return completed_shape().shape(); }
  /// kg: of a rigid body as given or of its shape and density, of a deformable one of its shape and material.
  double total_mass() const;

  /// A rigid body: the part of it between the symmetry planes, with the motions that keep the planes.
  /// @param position of the shape's origin, m
  RigidBody rigid_body(const SymmetryPlanes& planes, const Vec3& position) const;
  /// The points of a deformable body.
  /// About how many points() it will have, before any is made.
  double expected_points(const SymmetryPlanes& planes) const;
  Points points(const SymmetryPlanes& planes, const Vec3& position) const;

private:
  ShapeInputs completed_shape() const;
  void validate_surface(const std::string& file, const SymmetryPlanes& planes) const;
  void validate_support(const std::string& file) const;
  /// Refuses masses, centres and moments of inertia that no rigid body of this shape has.
  void validate_mass(const std::string& file) const;
  void validate_reinforcement(const std::string& file, const SymmetryPlanes& planes) const;
};

} // namespace spall
