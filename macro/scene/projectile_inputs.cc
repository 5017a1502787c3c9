#include "macro/scene/projectile_inputs.h"

#include "macro/contact/revolution.h"
#include "shared/error.h"

namespace spall {

void ProjectileInputs::declare(Parameters& parameters, const std::function<bool()>& needed) {
  auto section = parameters.section("Projectile", needed);
  section.quantity("Diameter", diameter, Dimension::length, {above_zero, 1e3}, "of the body");
  section.quantity("Length", length, Dimension::length, {above_zero, 1e3}, "tip to tail");
  section.number("Caliber radius head", caliber_radius_head, {0.5, 100},
                 "radius of the ogive's arc in diameters; 0.5 is a hemisphere");
  section.quantity("Mass", mass, Dimension::mass, {above_zero, 1e9}, "of the whole projectile");
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
  if (length < ogive().nose_length())
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
  if (!flight.is_normal() && !planes.moves_along(0))
    throw InputError(file + ": key 'Scene/Symmetry planes': x and axis are no symmetry of an impact with "
                            "Scene/Obliquity or Scene/Angle of attack; allowed: none or y");
}

Ogive ProjectileInputs::ogive() const {
  return {.radius = 0.5 * diameter, .length = length, .ogive_radius = caliber_radius_head * diameter};
}

RigidBody ProjectileInputs::rigid_body(const SymmetryPlanes& planes, const Flight& flight) const {
  const Ogive shape = ogive();
  const MassProperties whole =
      revolve([&](double z) { return shape.section_radius(z); }, {-length, -shape.nose_length(), 0});
  const auto chosen = [](double given, double computed) { return std::isnan(given) ? computed : given; };
  const double copies = planes.multiplicity();
  const double across = chosen(transverse_moment, mass * whole.transverse) / copies;

  RigidBody body;
  body.shape = shape;
  body.mass = mass / copies;
  body.centre = {0, 0, chosen(-centre_of_mass, whole.centre)};
  body.moments = {across, across, chosen(axial_moment, mass * whole.axial) / copies};
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
