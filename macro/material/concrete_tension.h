#pragma once

#include "macro/material/cracks.h"
#include "macro/material/tensile_damage.h"

#include <string>
#include <vector>

namespace spall {

/// What limits the mean tension of a concrete.
enum class Tension {
  own,         ///< the law's own equations
  damage_table ///< TensileDamage: the damage table of the microcell, at the points' own spacing
};

/// Tension of concretes other than AFC: which limit, and the cracks that open at it. An open point loses
/// stiffness and closes along the secant, so that opening takes up energy, with either limit.
struct ConcreteTension {
  Tension law = Tension::own;
  TensileDamage tensile; ///< T_max and all of the table
  Cracks cracks;

  using State = TensileDamage::State;

  bool own() const { return law == Tension::own; }
  /// Whether the spacing of the points must be known.
  bool needs_spacing() const { return !own() && tensile.uses_table(); }
  std::string table() const { return needs_spacing() ? tensile.table : std::string(); }

  /// Makes the curves of the damage table for points of these spacings (m).
  /// @param strength compressive strength, Pa: for the rate laws of tension
  /// @throws InputError: the table is unreadable, or not for a material of these constants in tension
  void prepare(const std::vector<double>& spacings, double youngs_modulus, double poisson_ratio,
               double strength);
  /// Declares all keys but the static strength in tension, tensile.T_max.
  void declare(Parameters::Section& section);
  /// @throws InputError: a table that is asked for but not named, or named but not asked for
  void validate(const std::string& file, const std::string& section) const;
};

} // namespace spall
