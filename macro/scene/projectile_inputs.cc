#include "macro/scene/projectile_inputs.h"

#include "macro/shape/fill.h"
#include "shared/error.h"

namespace spall {

void ProjectileInputs::declare(Parameters& parameters, const std::function<bool()>& needed) {
  auto section = parameters.section("Projectile", needed);
  section.quantity("Diameter", diameter, Dimension::length, {above_zero, 1e3}, "of the body");
  section.quantity("Length", length, Dimension::length, {above_zero, 1e3}, "tip to tail");
  section.number("Caliber radius head", caliber_radius_head, {0.5, 100},
                 "radius of the ogive's arc in diameters; 0.5 is a hemisphere");
  section.quantity("Mass", mass, Dimension::mass, {above_zero, 1e9}, "of the whole projectile");
  section.choice("Model", model,
                 {{"rigid", ProjectileModel::rigid}, {"deformable", ProjectileModel::deformable}},
                 "rigid: six unknowns; deformable: an empty casing of J2 steel, the keys below");
  const auto deformable = [this, needed] { return needed() && is_deformable(); };
  auto casing = parameters.section("Projectile", deformable);
  casing.quantity("Nose thickness", nose_thickness, Dimension::length, {above_zero, 1e3},
                  "of the casing, from the tip to the cavity");
  casing.quantity("Base thickness", base_thickness, Dimension::length, {above_zero, 1e3},
                  "of the casing, from the cavity to the tail; its wall follows from Mass and Density");
  casing.integer("Rings", rings, {1, 1000}, "points through the wall");
  casing.integer("Layers", layers, {1, 100000}, "points over the length; also sets their distance around");
  j2.declare(parameters, deformable, "Projectile");
  auto optional = parameters.section("Projectile", [] { return false; });
  optional.quantity(
      "Centre of mass", centre_of_mass, Dimension::length, {above_zero, 1e3},
      "distance from the tip; if not set, that of a homogeneous body of this shape (as the two moments)");
  optional.quantity("Axial moment", axial_moment, Dimension::moment_of_inertia, {above_zero, 1e9},
                    "of inertia about the axis");
  optional.quantity("Transverse moment", transverse_moment, Dimension::moment_of_inertia, {above_zero, 1e9},
                    "of inertia about an axis across, through the centre of mass");
}

void ProjectileInputs::validate(const std::string& file, const SymmetryPlanes& planes,
                                const Flight& flight) const {
  if (length < projectile().nose_length())
    throw InputError(file +
                     ": key 'Projectile/Length': shorter than the nose that Diameter and Caliber radius head "
                     "make");
  if (centre_of_mass >= length)
    throw InputError(file + ": key 'Projectile/Centre of mass': found " +
                     format_quantity(centre_of_mass, Dimension::length) +
                     " from the tip, allowed: less than Projectile/Length");
  if (2 * transverse_moment < axial_moment)
    throw InputError(file + ": key 'Projectile/Transverse moment': found less than half the axial moment, "
                            "which no body has");
  if (is_deformable() &&
      !(nose_thickness + base_thickness < length && nose_thickness < projectile().nose_length()))
    throw InputError(file + ": key 'Projectile/Nose thickness': nose and base leave no cavity, or the cavity "
                            "does not reach into the nose");
  if (is_deformable() && !(wall_thickness() > 0))
    throw InputError(file + ": key 'Projectile/Mass': found " + format_quantity(mass, Dimension::mass) +
                     ", which at this Density no wall makes up with this nose and base");
  if (!flight.is_normal() && !planes.moves_along(0))
    throw InputError(file + ": key 'Scene/Symmetry planes': x and axis are no symmetry of an impact with "
                            "Scene/Obliquity or Scene/Angle of attack; allowed: none or y");
}

Projectile ProjectileInputs::projectile() const {
  return {.diameter = diameter,
          .length = length,
          .nose = {.kind = NoseKind::ogive, .caliber_radius_head = caliber_radius_head}};
}

double ProjectileInputs::wall_thickness() const {
  return side_wall(projectile(), {.nose = nose_thickness, .base = base_thickness}, mass / j2.density);
}

Points ProjectileInputs::fill(const SymmetryPlanes& planes, const Flight& flight) const {
  const Revolution body_shape =
      casing(projectile(), {.nose = nose_thickness, .base = base_thickness, .side = wall_thickness()});
  Points points = spall::fill(body_shape, {.rings = rings, .layers = layers}, planes, j2.density);
  const RigidBody body = rigid_body(planes, flight);
  const Mat3 axes = matrix_of(body.orientation);
  for (std::size_t i = 0; i < points.owned; ++i) {
    points.position.set(i, add(body.position, 1, times(axes, points.position[i])));
    points.velocity.set(i, body.velocity);
  }
  points.initial_position = points.position;
  return points;
}

KnownSurface ProjectileInputs::surface(const SymmetryPlanes& planes, const Flight& flight,
                                       const Points& points) const {
  const RigidBody body = rigid_body(planes, flight);
  return known_surface(body.shape, matrix_of(body.orientation), body.position, points);
}

RigidBody ProjectileInputs::rigid_body(const SymmetryPlanes& planes, const Flight& flight) const {
  const Revolution shape{.outer = projectile().contour()};
  const MassProperties whole = shape.mass_properties();
  const auto chosen = [](double given, double computed) { return std::isnan(given) ? computed : given; };
  const double copies = planes.multiplicity();
  const double across = chosen(transverse_moment, mass * whole.moments[0]) / copies;

  RigidBody body;
  body.shape = shape;
  body.mass = mass / copies;
  body.centre = {0, 0, chosen(-centre_of_mass, whole.centre)};
  body.moments = {across, across, chosen(axial_moment, mass * whole.moments[2]) / copies};
  for (int c = 0; c < 3; ++c) {
    body.free[c] = planes.moves_along(c);
    body.turns[c] = planes.turns_about(c);
  }
  body.velocity = {flight.speed * std::sin(flight.obliquity), 0, flight.speed * std::cos(flight.obliquity)};
  if (!flight.is_normal()) body.orientation = about_axis(1, flight.obliquity + flight.attack);
  body.position = {0, 0, -flight.start_gap};
  body.position[2] -= body.front() - body.position[2];
  return body;
}

} // namespace spall
