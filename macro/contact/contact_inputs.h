#pragma once

#include <string>
#include <utility>
#include <vector>

namespace spall {

/// Where the normal of the contact comes from.
enum class ContactNormal {
  fitted,    ///< of the plane through the other body's outermost points; starts from the level set
  level_set, ///< gradient of the level set of the joint approximation (paper Eqs. 17-19)
  pair       ///< direction between the points of a pair, averaged over the neighbours
};

inline const std::vector<std::pair<std::string, ContactNormal>> contact_normal_names = {
    {"fitted", ContactNormal::fitted},
    {"level set", ContactNormal::level_set},
    {"pair direction", ContactNormal::pair}};

struct ContactInputs {
  double friction = 0;          ///< Coulomb coefficient
  double stand_off = 0;         ///< distance at which a point touches, in its own spacings; constant in time
  double overlap_release = 0.1; ///< part of an existing overlap that is taken back per step
  ContactNormal normal = ContactNormal::fitted; ///< between deformable bodies
};

} // namespace spall
