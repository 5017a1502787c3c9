#pragma once

#include "shared/input/parameters.h"

namespace spall {

/// The constitutive laws a material file can choose.
enum class Law { J2, AFC };

/// Declares `Material/Law`, which every material file sets before the section of constants of that law.
inline void declare_law(Parameters& parameters, Law& law) {
  parameters.section("Material")
      .choice("Law", law, {{"J2", Law::J2}, {"AFC", Law::AFC}},
              "constitutive law; its constants are in the section of that name");
}

} // namespace spall
