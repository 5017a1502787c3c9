#pragma once

#include "macro/material/afc.h"
#include "macro/material/foam.h"
#include "macro/material/hjc.h"
#include "macro/material/j2.h"
#include "macro/material/johnson_cook.h"
#include "macro/material/material_law.h"
#include "macro/material/oriented_afc.h"
#include "macro/material/rht.h"

#include <tuple>
#include <variant>

namespace spall {

/// The constitutive laws by name. A new one is a header, perhaps a source file, and a word here and below;
/// inputs, programs and output follow.
using Laws = std::tuple<Afc, J2, JohnsonCook, Hjc, Rht, Foam>;
/// What points are made of: the laws, and forms of them that a key of theirs chooses. (CMake reads this
/// line.)
using Forms = std::tuple<Afc, OrientedAfc, J2, JohnsonCook, Hjc, Rht, Foam>;

namespace detail {
/// Where a law lacks something, the compiler says here what.
template<MaterialLaw Law> using Checked = Law;
template<class List> struct VariantOf;
template<class... Law> struct VariantOf<std::tuple<Law...>> { using Type = std::variant<Checked<Law>...>; };
} // namespace detail

/// A material: one of the forms with its constants.
using Material = detail::VariantOf<Forms>::Type;

/// Makes a material ready for points of these spacings (m, in any order, as often as there are points).
/// @throws InputError: its damage table is unreadable or not for this material in tension.
inline void prepare(Material& material, const std::vector<double>& spacings) {
  std::visit([&](auto& law) { law.prepare(spacings); }, material);
}

} // namespace spall
