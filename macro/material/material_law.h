#pragma once

#include "macro/material/material.h"
#include "shared/input/parameters.h"

#include <concepts>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace spall {

/// Names and values that a law adds to the summary of a run.
using Description = std::vector<std::pair<std::string, std::string>>;

/// What a constitutive law is: a small value that holds its constants, and a state per material point. A law
/// of the list (materials.h) that lacks one of these does not compile.
template<class Law>
concept MaterialLaw = std::is_trivially_copyable_v<typename Law::State> &&
    std::is_default_constructible_v<typename Law::State> &&
    requires(Law law, const Law constant, typename Law::State& state, const typename Law::State& present,
             Sym3& stress, const Sym3& known, const StrainStep& step, Parameters& parameters, Needed needed,
             const std::string& text, const std::vector<double>& spacings) {
  // Of every law.
  { Law::name } -> std::convertible_to<std::string>; // in `Material/Law`, and of the section of its constants
  { Law::ductile } -> std::convertible_to<bool>;     // bends and flows where others break out of a face
  { *Law::fields.begin() } -> std::convertible_to<HistoryField<typename Law::State>>; // for output

  // In the loop over points.
  {
    constant.update(stress, state, step)
    } -> std::same_as<Stiffness>;                            // stress and state at the end of a step
  { constant.elastic(present) } -> std::same_as<Stiffness>;  // elastic moduli of the present state
  { constant.sound_speed(present) } -> std::same_as<double>; // of the stiffest branch, m/s
  { constant.stored_energy(known, present) } -> std::same_as<StoredEnergy>; // free energy of this stress

  // For the set-up of a run.
  { constant.density } -> std::convertible_to<double>;   // of the undeformed material, kg/m^3
  { constant.bulk_modulus() } -> std::same_as<double>;   // of the undamaged material, Pa
  { constant.shear_modulus() } -> std::same_as<double>;  // of the undamaged material, Pa
  { constant.strength_limit() } -> std::same_as<double>; // largest stress difference, Pa; may be infinite
  { constant.softens() } -> std::same_as<bool>;          // whether damage takes strength with these constants
  { constant.needs_spacing() } -> std::same_as<bool>;    // whether StrainStep::spacing must be given
  { constant.describe() } -> std::same_as<Description>;  // for the summary of a run
  law.prepare(spacings); // gets ready for points of these spacings (m; in any order); once, before the run

  // Inputs. `declare` binds the keys of a section; `needed` says whether they must be set (empty: always).
  law.declare(parameters, needed, text);
  constant.validate(text, text); // checks across keys; arguments: name of the file, name of the section
};

} // namespace spall
