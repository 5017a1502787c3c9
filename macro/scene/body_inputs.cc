#include "macro/scene/body_inputs.h"

#include "macro/shape/expected_points.h"
#include "shared/error.h"
#include "shared/memory.h"

#include <cmath>
#include <numbers>

namespace spall {
namespace {

/// Largest deviation of a surface of triangles from its mirror image, as a part of its smallest side, where
/// the scene has a symmetry plane: what the facets of a round body with some twenty of them leave.
constexpr double most_asymmetry = 0.01;

} // namespace

namespace {

/// Memory of a point while a body is filled: its place, its cell and its row in Points.
constexpr double bytes_to_fill = 400;

} // namespace

void PlaceInputs::declare(Parameters& parameters, const std::string& name) {
  auto section = parameters.section(name);
  section.text("Behind", behind,
               "name of a body: this one's lowest point is Gap above the highest point of that body");
  section.text("Before", before,
               "name of a body: this one's highest point is Gap below the lowest point of that body");
  section.quantity("Gap", gap, Dimension::length, {0, 1e3},
                   "distance to the body that it stands behind or before");
  section.quantity("Lowest point", lowest, Dimension::length, {-1e3, 1e3},
                   "z of the lowest point of a body that stands neither behind nor before another one");
  section.quantity("Offset x", offset_x, Dimension::length, {-1e3, 1e3}, "x of the body's axis");
  section.quantity("Offset y", offset_y, Dimension::length, {-1e3, 1e3}, "y of the body's axis");
}

void MotionInputs::declare(Parameters& parameters, const std::string& name) {
  auto section = parameters.section(name);
  section.quantity("Velocity", velocity, Dimension::velocity, {-1e4, 1e4},
                   "at the start, along the flight: towards +z if positive");
  section.quantity("Obliquity", obliquity, Dimension::angle, {-1.5, 1.5},
                   "angle in the x-z plane between the flight and the z axis; the body's axis turns with it");
  section.quantity("Angle of attack", attack, Dimension::angle, {-1.5, 1.5},
                   "angle in the x-z plane between the body's axis and its flight");
  section.quantity("Spin", spin, Dimension::angular_velocity, {-1e5, 1e5},
                   "about the body's axis, from x towards y if positive");
}

Vec3 MotionInputs::velocity_vector() const {
  if (of_fragment) return *of_fragment;
  if (obliquity == 0) return {0, 0, velocity};
  return {velocity * std::sin(obliquity), 0, velocity * std::cos(obliquity)};
}

Quaternion MotionInputs::orientation() const {
  return is_normal() ? Quaternion{} : about_axis(1, obliquity + attack);
}

Vec3 MotionInputs::angular_velocity() const { return times(matrix_of(orientation()), Vec3{0, 0, spin}); }

void MassInputs::declare(Parameters& parameters, const std::string& name) {
  auto section = parameters.section(name, Needed::never());
  section.quantity(
      "Mass", mass, Dimension::mass, {above_zero, 1e9},
      "of the whole body: of a rigid one instead of Density; of a casing it sets the wall, unless Wall "
      "thickness does");
  section.quantity("Mean density", density, Dimension::density, {above_zero, 1e6},
                   "of a rigid body, instead of Mass");
  section.quantity(
      "Centre of mass", centre_of_mass, Dimension::length, {above_zero, 1e3},
      "of a rigid body: distance from the tip of a projectile, or from the lower face of other shapes; "
      "if not set, that of a homogeneous body of this shape (as the two moments)");
  section.quantity("Axial moment", axial_moment, Dimension::moment_of_inertia, {above_zero, 1e9},
                   "of inertia about the axis");
  section.quantity("Transverse moment", transverse_moment, Dimension::moment_of_inertia, {above_zero, 1e9},
                   "of inertia about an axis across, through the centre of mass");
}

void BodyInputs::declare(Parameters& parameters) {
  static const Choices<BodyModel> models = {{"deformable", BodyModel::deformable},
                                            {"rigid", BodyModel::rigid},
                                            {"ring", BodyModel::ring},
                                            {"none", BodyModel::none}};
  const Needed if_deformable = needed_if("Model", model, models, {BodyModel::deformable}),
               if_ring = needed_if("Model", model, models, {BodyModel::ring}),
               has_law{[this] { return has_material; }, ""};
  auto section = parameters.section(name);
  section.choice(
      "Model", model, models,
      "deformable: points with a material; rigid: six unknowns at most; ring: an elastic ring around another "
      "body, which touches it at the start, pushes and slides; none: the body is left out");
  shape.declare(parameters, name, {[this] { return has_shape(); }, ""});
  place.declare(parameters, name);
  motion.declare(parameters, name);
  mass.declare(parameters, name);
  section.file(
      "Fragments", fragments,
      "file with a cloud of rigid spheres, for which this body stands: CSV with the columns "
      "mass,x,y,z,vx,vy,vz in kg, m, m/s, a row for each; with Mean density. They are bodies of their "
      "own: NAME_1, NAME_2 ...");
  section.flag("Held", held, "whether a rigid body stays where it is; a half space always does");
  filling.declare(parameters, name, if_deformable);
  section.choice(
      "Surface", known_surface, {{"fitted", false}, {"known", true}},
      "what other bodies touch of a deformable one, if they are before it in Contact/Order. fitted: a "
      "surface through its outermost points; known: that of its shape, carried by its points, for a body "
      "that stays whole");
  section.choice(
      "Supports", support.kind,
      {{"none", BodySupportKind::none},
       {"clamped", BodySupportKind::clamped},
       {"simple", BodySupportKind::simple}},
      "what holds a deformable body. clamped: the outermost points of its side do not move; simple: points "
      "of "
      "its upper face (the larger z) on a ring or at the edge do not move along z, neither way, and are free "
      "along the face. The force on the body is support_force in history.csv");
  section.quantity("Support diameter", support.diameter, Dimension::length, {0, 1e3},
                   "of the ring of a simple support; 0: the edge of the upper face");
  section.text("Bonded to", bonded_to,
               "name of a deformable body that this one stays joined to where they touch at the start");
  material.declare(parameters, name + "/", if_deformable && has_law);
  reinforcement.declare(parameters, name + "/Reinforcement", if_deformable);

  section.text("Around", around, "name of the body that a ring surrounds; must be set if Model = ring");
  auto of_ring = parameters.section(name, if_ring);
  of_ring.quantity("Thickness", ring.thickness, Dimension::length, {above_zero, 1}, "of a ring's wall");
  of_ring.quantity("Young's modulus", ring.youngs_modulus, Dimension::stress, {above_zero, 1e13},
                   "of a ring, along its circumference");
  of_ring.quantity("Yield stress", ring.yield_stress, Dimension::stress, {above_zero, 1e13},
                   "of a ring, without hardening");
  of_ring.quantity("Density", ring.density, Dimension::density, {above_zero, 1e5}, "of a ring");
}

void BodyInputs::validate(const std::string& file, const SymmetryPlanes& planes) const {
  const auto refuse = [&](const std::string& key, const std::string& why) {
    throw InputError(file + ": key '" + name + "/" + key + "': " + why);
  };
  if (model == BodyModel::ring && around.empty())
    refuse("Around", "a ring needs the name of the body that it surrounds");
  validate_support(file);
  if (!has_shape()) return validate_reinforcement(file, planes);
  completed_shape().validate(file, name);
  validate_surface(file, planes);
  validate_reinforcement(file, planes);
  if (!place.behind.empty() && !place.before.empty())
    refuse("Before", "found '" + place.before + "', allowed: either Behind or Before");
  if (!motion.is_normal() && !planes.moves_along(0))
    throw InputError(file + ": key 'Scene/Symmetry planes': x and axis are no symmetry of a body with " +
                     name + "/Obliquity or Angle of attack; allowed: none or y");
  for (const auto& [key, offset, axis] :
       {std::tuple("Offset x", place.offset_x, 0), {"Offset y", place.offset_y, 1}})
    if (offset != 0 && !planes.moves_along(axis))
      refuse(key, "found " + format_quantity(offset, Dimension::length) +
                      ", allowed: 0 with these Scene/Symmetry planes");
  if (motion.spin != 0 && !planes.turns_about(2))
    refuse("Spin", "found " + format_quantity(motion.spin, Dimension::angular_velocity) +
                       ", allowed: 0 with these Scene/Symmetry planes, about which no body turns");
  if (is_deformable()) {
    if (!has_material)
      throw InputError(file + ": the body '" + name +
                       "' has no material: include a material file in its section");
    filling.validate(file, name, solid_shape());
    if (planes.axis && (filling.filling.layout == Layout::lattice || !is_round(solid_shape())))
      refuse("Layout",
             "rotational symmetry (Scene/Symmetry planes = axis) needs a round body with polar layout");
    material.validate(file, name + "/");
    return;
  }
  if (is_held()) {
    if (motion.velocity != 0) refuse("Velocity", "a held body does not move");
    if (motion.spin != 0) refuse("Spin", "a held body does not turn");
    return;
  }
  validate_mass(file);
}

void BodyInputs::validate_mass(const std::string& file) const {
  const auto refuse = [&](const std::string& key, const std::string& why) {
    throw InputError(file + ": key '" + name + "/" + key + "': " + why);
  };
  if (std::isnan(mass.mass) == std::isnan(mass.density))
    refuse("Mass", "a rigid body needs either Mass or Mean density, or Held = yes");
  const Shape shape_of_it = solid_shape();
  const double length = extent(shape_of_it, {0, 0, 1}) + extent(shape_of_it, {0, 0, -1}),
               radius = std::hypot(extent(shape_of_it, {1, 0, 0}),
                                   is_round(shape_of_it) ? 0 : extent(shape_of_it, {0, 1, 0}));
  const MassProperties whole = mass_properties(shape_of_it);
  const double kilograms = total_mass(),
               axial = std::isnan(mass.axial_moment) ? kilograms * whole.moments[2] : mass.axial_moment,
               across =
                   std::isnan(mass.transverse_moment) ? kilograms * whole.moments[0] : mass.transverse_moment;
  // All mass at the rim, or as far from the centre of mass as the body reaches.
  for (const auto& [key, found, largest] :
       {std::tuple("Axial moment", axial, kilograms * radius * radius),
        {"Transverse moment", across, kilograms * (radius * radius + length * length)}})
    if (found > largest)
      refuse(key, "found " + format_quantity(found, Dimension::moment_of_inertia) + ", allowed: at most " +
                      format_quantity(largest, Dimension::moment_of_inertia) +
                      ", more than which no body of this shape and mass has");
  if (2 * across < axial)
    refuse(std::isnan(mass.transverse_moment) ? "Axial moment" : "Transverse moment",
           "found a transverse moment of less than half the axial one, which no body has");
  if (mass.centre_of_mass >= length)
    refuse("Centre of mass", "found " + format_quantity(mass.centre_of_mass, Dimension::length) +
                                 " from the end, allowed: less than the length of the body");
}

void BodyInputs::validate_surface(const std::string& file, const SymmetryPlanes& planes) const {
  if (shape.kind != ShapeKind::surface) return;
  const auto refuse = [&](const std::string& key, const std::string& why) {
    throw InputError(file + ": key '" + name + "/" + key + "': " + why);
  };
  for (const auto& [key, value] : {std::pair("Centre of mass", mass.centre_of_mass),
                                   {"Axial moment", mass.axial_moment},
                                   {"Transverse moment", mass.transverse_moment}})
    if (!std::isnan(value)) refuse(key, "follows from Shape = surface, for a homogeneous body");
  const ClosedSurface surface = std::get<ClosedSurface>(solid_shape());
  if (planes.axis) refuse("Shape", "triangles have no rotational symmetry (Scene/Symmetry planes = axis)");
  const Vec3 size = surface.high() - surface.low();
  const double allowed = most_asymmetry * std::min({size[0], size[1], size[2]});
  for (int c = 0; c < 2; ++c)
    if (planes.normal[c] && surface.asymmetry(c) > allowed)
      refuse("File", std::string("the surface is not symmetric about the plane ") + (c == 0 ? "x" : "y") +
                         " = 0 of Scene/Symmetry planes: found " +
                         format_quantity(surface.asymmetry(c), Dimension::length) +
                         ", allowed: " + format_quantity(allowed, Dimension::length));
}

void BodyInputs::validate_support(const std::string& file) const {
  const auto refuse = [&](const std::string& key, const std::string& why) {
    throw InputError(file + ": key '" + name + "/" + key + "': " + why);
  };
  const bool present = support.kind != BodySupportKind::none;
  if (present && !is_deformable())
    refuse("Supports", "allowed for this Model: none; a rigid body stays where it is with Held = yes");
  if (present && (motion.velocity != 0 || motion.spin != 0 || !motion.is_normal()))
    refuse("Supports", "a body that is held has neither Velocity nor Spin nor Obliquity nor Angle of attack");
  if (support.diameter > 0 && support.kind != BodySupportKind::simple)
    refuse("Support diameter", "found " + format_quantity(support.diameter, Dimension::length) +
                                   ", which needs Supports = simple");
}

void BodyInputs::validate_reinforcement(const std::string& file, const SymmetryPlanes& planes) const {
  if (!reinforcement.present() || model == BodyModel::none) return;
  const std::string section = name + "/Reinforcement";
  if (!is_deformable())
    throw InputError(file + ": key '" + section + "/Faces': allowed for this Model: none");
  if (!motion.is_normal())
    throw InputError(file + ": key '" + section +
                     "/Faces': allowed with Obliquity or Angle of attack of the body: none");
  for (const auto& [key, offset] : {std::pair("Offset x", place.offset_x), {"Offset y", place.offset_y}})
    if (offset != 0 && planes.multiplicity() > 1)
      throw InputError(file + ": key '" + name + "/" + key +
                       "': a body with bars stands on the axis if the scene has symmetry planes, allowed: 0");
  reinforcement.validate(file, section, solid_shape(), planes);
}

ShapeInputs BodyInputs::completed_shape() const {
  ShapeInputs complete = shape;
  if (is_deformable())
    complete.complete_wall(mass.mass, material.density());
  else if (std::isnan(shape.wall_thickness)) // a rigid casing without a wall is its outer surface
    complete.nose_thickness = complete.base_thickness = required;
  return complete;
}

bool BodyInputs::has_tip() const {
  return shape.kind == ShapeKind::projectile || shape.kind == ShapeKind::sphere ||
         shape.kind == ShapeKind::profile;
}

double BodyInputs::total_mass() const {
  if (!std::isnan(mass.mass)) return mass.mass;
  const double density = is_deformable() ? material.density() : mass.density;
  return density * mass_properties(solid_shape()).volume;
}

RigidBody BodyInputs::rigid_body(const SymmetryPlanes& planes, const Vec3& position) const {
  RigidBody body{.shape = solid_shape(), .position = position};
  body.orientation = motion.orientation();
  if (is_held()) {
    body.free = {false, false, false};
    return body;
  }
  const MassProperties whole = mass_properties(body.shape);
  const auto chosen = [](double given, double computed) { return std::isnan(given) ? computed : given; };
  const double copies = planes.multiplicity(), kilograms = total_mass();
  body.mass = kilograms / copies;
  const double across = mass.transverse_moment / copies;
  body.moments = {chosen(across, kilograms * whole.moments[0] / copies),
                  chosen(across, kilograms * whole.moments[1] / copies),
                  chosen(mass.axial_moment, kilograms * whole.moments[2]) / copies};
  const double from_end = has_tip() ? -mass.centre_of_mass : mass.centre_of_mass;
  body.centre = {whole.centre[0], whole.centre[1], chosen(from_end, whole.centre[2])};
  body.principal = whole.axes;
  for (int c = 0; c < 3; ++c) {
    body.free[c] = planes.moves_along(c);
    body.turns[c] = planes.turns_about(c);
  }
  body.velocity = motion.velocity_vector();
  const Mat3 inertia_axes = body.inertia_axes();
  const Vec3 about_axes = times_transposed(inertia_axes, motion.angular_velocity());
  body.angular_momentum =
      times(inertia_axes, Vec3{body.moments[0] * about_axes[0], body.moments[1] * about_axes[1],
                               body.moments[2] * about_axes[2]});
  return body;
}

double BodyInputs::expected_points(const SymmetryPlanes& planes) const {
  return spall::expected_points(solid_shape(), filling.filling, planes);
}

Points BodyInputs::points(const SymmetryPlanes& planes, const Vec3& position) const {
  const double expected = expected_points(planes);
  require_memory(expected * bytes_to_fill, "the " + format_quantity(std::round(expected), Dimension::none) +
                                               " points of the body '" + name + "'");
  Points points = fill(solid_shape(), filling.filling, planes, material.density());
  const Mat3 axes = matrix_of(motion.orientation());
  const Vec3 velocity = motion.velocity_vector(), spin = motion.angular_velocity();
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 from_origin = times(axes, points.position[i]);
    points.position.set(i, position + from_origin);
    points.velocity.set(i, velocity + cross(spin, from_origin));
  }
  points.initial_position = points.position;
  return points;
}

} // namespace spall
