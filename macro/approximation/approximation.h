#pragma once

#include "macro/approximation/support.h"

#include <string>
#include <utility>
#include <vector>

namespace spall {

enum class Profile { cubic_spline, wendland_c4 };
inline const std::vector<std::pair<std::string, Profile>> profile_names = {
    {"cubic spline", Profile::cubic_spline}, {"Wendland C4", Profile::wendland_c4}};

/// The configuration in which the shape functions are defined.
enum class Configuration {
  semi_lagrangian, ///< present: neighbours change (paper Eq. 8)
  lagrangian       ///< initial: neighbours stay (paper Eq. 7), for bodies that stay whole
};
inline const std::vector<std::pair<std::string, Configuration>> configuration_names = {
    {"semi-Lagrangian", Configuration::semi_lagrangian}, {"Lagrangian", Configuration::lagrangian}};

struct ApproximationInputs {
  Profile profile = Profile::cubic_spline;
  int order = 1; ///< order of the monomial basis (paper Eq. 4): 0, 1 or 2
  Configuration configuration = Configuration::semi_lagrangian;
  SupportInputs support;

  /// The support that nodal cells and shape functions have in the present configuration. In the Lagrangian
  /// configuration it follows the deformation without limit.
  SupportInputs present_support() const {
    SupportInputs present = support;
    if (configuration == Configuration::lagrangian) present.min_stretch = 0, present.max_stretch = 1e300;
    return present;
  }
};

} // namespace spall
