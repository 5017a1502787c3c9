#pragma once

#include "macro/contact/friction.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace spall {

/// The surface of a body that stays whole (projectile, plate).
enum class ContactSurface {
  known, ///< the surface of its shape, carried by its points
  fitted ///< a surface fitted through its outermost points
};

/// Definition of the contact normal of overlapping kernels. (Impulses act along the normal of the other
/// body's surface.)
enum class ContactNormal {
  level_set, ///< gradient of the level set of the joint approximation (paper Eqs. 17-19)
  pair       ///< direction between the points of a pair, averaged over the neighbours
};

inline const std::vector<std::pair<std::string, ContactNormal>> contact_normal_names = {
    {"level set", ContactNormal::level_set}, {"pair direction", ContactNormal::pair}};

inline const std::vector<std::pair<std::string, ContactSurface>> contact_surface_names = {
    {"known", ContactSurface::known}, {"fitted", ContactSurface::fitted}};

/// With which part of its cell a point touches a rigid body.
enum class TouchingPart {
  cell, ///< all of its present extent
  /// What is left of it without the volume that has opened: the extent over J where J > 1. Cells that a nose
  /// has spread into a tunnel have opened to J = 3 or so, and would hold the next ones off it.
  solid
};

inline const std::vector<std::pair<std::string, TouchingPart>> touching_part_names = {
    {"cell", TouchingPart::cell}, {"solid", TouchingPart::solid}};

struct ContactInputs {
  Friction friction = 0;
  TouchingPart touching = TouchingPart::cell; ///< with rigid bodies
  /// Fraction of an existing overlap that is removed per step, and the largest velocity of that, m/s, because
  /// points that are pushed out keep it.
  double overlap_release = 0.1, release_speed = 5;
  /// Between deformable bodies, a word of contact_laws.h: "surface" (impulses between the points of one body
  /// and the surface of the other, which closes the gap) or "kernel" (forces where kernels overlap, paper
  /// Eqs. 12-16: bodies stop about a support apart).
  std::string law = "surface";
  /// Deformable bodies that stay joined instead, by their names.
  std::vector<std::pair<std::string, std::string>> bonded = {};
  /// Surface of bodies that stay whole, with the law "surface".
  ContactSurface surface = ContactSurface::known;
  ContactNormal normal = ContactNormal::level_set; ///< contact normal of overlapping kernels

  /// Least normal velocity of a touching point: with it the gap is closed at the end of the step, or part of
  /// an older overlap is removed.
  double target_velocity(double gap, double dt) const {
    return gap >= 0 ? -gap / dt : std::min(-overlap_release * gap / dt, release_speed);
  }
};

} // namespace spall
