#pragma once

#include <string>
#include <utility>
#include <vector>

namespace spall {

/// How two deformable bodies keep out of each other.
enum class ContactScheme {
  surface, ///< impulses between the points of one body and the surface of the other, which closes the gap
  kernel   ///< forces where kernels overlap (paper Eqs. 12-16): bodies stop about a support apart
};

/// Where the normal of overlapping kernels comes from. Impulses go along the normal of the other body's
/// surface.
enum class ContactNormal {
  level_set, ///< gradient of the level set of the joint approximation (paper Eqs. 17-19)
  pair       ///< direction between the points of a pair, averaged over the neighbours
};

inline const std::vector<std::pair<std::string, ContactScheme>> contact_scheme_names = {
    {"surface", ContactScheme::surface}, {"kernel", ContactScheme::kernel}};
inline const char* name_of(ContactScheme scheme) {
  std::size_t i = 0;
  while (contact_scheme_names[i].second != scheme) ++i;
  return contact_scheme_names[i].first.c_str();
}
inline const std::vector<std::pair<std::string, ContactNormal>> contact_normal_names = {
    {"level set", ContactNormal::level_set}, {"pair direction", ContactNormal::pair}};

struct ContactInputs {
  double friction = 0;          ///< Coulomb coefficient
  double stand_off = 0;         ///< distance at which a point touches, in its own spacings; constant in time
  double overlap_release = 0.1; ///< part of an existing overlap that is taken back per step
  ContactScheme scheme = ContactScheme::surface;   ///< between deformable bodies
  ContactNormal normal = ContactNormal::level_set; ///< of overlapping kernels
};

} // namespace spall
