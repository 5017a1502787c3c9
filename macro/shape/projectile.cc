#include "macro/shape/projectile.h"

#include <stdexcept>

namespace spall {
namespace {

/// Places over the length of a nose at which the cavity is compared with it.
constexpr int checks = 200;

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

/// The cavity of a casing, its tip at z = 0: see casing().
Contour cavity(const Projectile& outside, const CasingWalls& walls) {
  const double radius = 0.5 * outside.diameter - walls.side, nose = outside.nose_length() - walls.nose;
  const double length = outside.length - walls.nose - walls.base;
  require(radius > 0 && length > 0, "the walls leave no cavity");
  if (nose <= 0 || length <= nose) return Projectile{2 * radius, length, {.kind = NoseKind::flat}}.contour();
  if (outside.nose.kind == NoseKind::cone)
    return Projectile{2 * radius, length, {.kind = NoseKind::cone, .length = nose}}.contour();
  const double arc = (radius * radius + nose * nose) / (2 * radius);
  TangentOgive ogive{.radius = radius, .length = length, .arc_radius = arc};
  // A nose shorter than wide cannot be pointed and tangent: the arc begins square to the axis.
  if (arc < radius) ogive.tip_radius = 2 * (radius - arc);
  return ogive.contour();
}

} // namespace

double TangentOgive::nose_length() const {
  const double d = arc_radius - radius + tip_radius;
  return std::sqrt(arc_radius * arc_radius - d * d);
}

Contour TangentOgive::contour() const {
  const double shoulder = -nose_length();
  ContourBuilder contour({0, 0});
  contour.line_to({0, tip_radius});
  contour.arc_to({shoulder, radius}, {shoulder, radius - arc_radius}, arc_radius);
  return contour.line_to({-length, radius}).line_to({-length, 0}).contour();
}

double Projectile::nose_length() const {
  const double radius = 0.5 * diameter, arc = nose.caliber_radius_head * diameter;
  switch (nose.kind) {
  case NoseKind::ogive:
    return TangentOgive{radius, length, arc}.nose_length();
  case NoseKind::truncated_ogive:
    return TangentOgive{radius, length, arc, 0.5 * nose.tip_diameter}.nose_length();
  case NoseKind::hemisphere:
    return radius;
  case NoseKind::cone:
    return nose.length;
  case NoseKind::flat:
    return 0;
  case NoseKind::blunt:
    return nose.edge_radius;
  }
  return 0;
}

Contour Projectile::contour() const {
  require(diameter > 0 && length > 0, "diameter and length must be positive");
  require(length >= (1 - 1e-12) * nose_length(), "the body is shorter than its nose");
  const double radius = 0.5 * diameter, arc = nose.caliber_radius_head * diameter;
  ContourBuilder contour({0, 0});
  switch (nose.kind) {
  case NoseKind::ogive:
  case NoseKind::truncated_ogive: {
    const double tip = nose.kind == NoseKind::ogive ? 0 : 0.5 * nose.tip_diameter;
    require(arc >= radius, "the calibre radius head must be at least 0.5");
    require(tip >= 0 && tip < radius, "the tip must be narrower than the shaft");
    return TangentOgive{radius, length, arc, tip}.contour();
  }
  case NoseKind::hemisphere:
    return TangentOgive{radius, length, radius}.contour();
  case NoseKind::cone:
    require(nose.length > 0, "the nose length must be positive");
    contour.line_to({-nose.length, radius});
    break;
  case NoseKind::flat:
    contour.line_to({0, radius});
    break;
  case NoseKind::blunt: {
    const double edge = nose.edge_radius;
    require(edge > 0 && edge <= radius, "the edge radius must be positive and at most the body's radius");
    contour.line_to({0, radius - edge}).arc_to({-edge, radius}, {-edge, radius - edge}, edge);
    break;
  }
  }
  return contour.line_to({-length, radius}).line_to({-length, 0}).contour();
}

Contour sphere_contour(double diameter) {
  require(diameter > 0, "the diameter must be positive");
  const double radius = 0.5 * diameter;
  return ContourBuilder({0, 0})
      .arc_to({-radius, radius}, {-radius, 0}, radius)
      .arc_to({-diameter, 0}, {-radius, 0}, radius)
      .contour();
}

Revolution casing(const Projectile& projectile, const CasingWalls& walls) {
  Revolution body{.outer = projectile.contour(), .inner = cavity(projectile, walls), .inner_z = -walls.nose};
  const double nose = projectile.nose_length();
  for (int i = 0; i <= checks; ++i) {
    const double z = -nose * i / checks, inside = body.inner_radius(z);
    require(!(inside > 0) || inside < body.outer_radius(z), "the cavity breaks through the nose");
  }
  return body;
}

double side_wall(const Projectile& projectile, const CasingWalls& walls, double volume) {
  const double wanted = projectile.contour().mass_properties().volume - volume; // of the cavity
  const auto cavity_volume = [&](double side) {
    return cavity(projectile, {walls.nose, walls.base, side}).mass_properties().volume;
  };
  double thin = 0, thick = 0.5 * projectile.diameter;
  if (wanted > cavity_volume(thin) || !(wanted > 0)) return 0;
  for (int n = 0; n < 60; ++n) { // to round-off
    const double side = 0.5 * (thin + thick);
    (cavity_volume(side) > wanted ? thin : thick) = side;
  }
  return 0.5 * (thin + thick);
}

} // namespace spall
