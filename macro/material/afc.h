#pragma once

#include "macro/material/failure_surface.h"
#include "macro/material/hydrostat.h"
#include "macro/material/material.h"
#include "macro/material/principal.h"

#include "shared/damage_law.h"
#include "shared/input/parameters.h"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace spall {

/// How the volumetric strain mu follows from J.
enum class VolumetricStrain {
  logarithmic,  ///< mu = -ln J: small strain increments add up to it
  density_ratio ///< mu = 1 / J - 1
};

/// Where d_t(kappa) of Eq. 30 comes from.
enum class TensileLaw {
  table,      ///< of the microcell, at the points' own spacing
  exponential ///< DamageLaw::exponential: the same at any spacing, for verification against other programs
};

/// Concrete: the Advanced Fundamental Concrete model (Eqs. 20-24), with tensile damage informed by
/// microcracks (Eq. 30) if a damage table is loaded. Constants of Table 1 in SI units; tension positive,
/// pressures and mu compression positive.
///
/// The pressure is a function of J and of the largest compression reached, cut off at the tension limit
/// T_max (1 - d_t): a point that has opened closes along the same line. The deviator is elastic, then
/// returned radially to the failure surface at that pressure.
///
/// T_max is the strength of the mean concrete. The weak and strong tables of an ensemble say by which factor
/// their peak stress differs from the mean's, and T_max is multiplied by it: their strength damage starts at
/// 0 like the mean's, as a strength above the mean's cannot be a damage. The damages of stiffness hold the
/// stress itself and need no factor.
struct Afc {
  Hydrostat hydrostat;
  FailureSurface surface;
  double density = required; ///< kg/m^3
  double G = required;       ///< shear modulus, Pa
  double D1 = required;      ///< 1/Pa
  VolumetricStrain volumetric_strain = VolumetricStrain::logarithmic;
  bool shear_damage = true;
  /// Smallest plastic strain to failure. Eq. 24 as printed (0) divides by a pressure that vanishes and fails
  /// the point at its first plastic step in tension; 0.01 is EFmin of Holmquist, Johnson and Cook's concrete.
  double failure_strain_floor = 0.01;
  TensileLaw tensile_law = TensileLaw::table;
  std::string damage_table;       ///< path; empty: the original AFC, no tensile damage
  double damage_threshold = 6e-4; ///< of the exponential law, kappa where damage starts
  double damage_scale = 1e-3;     ///< of the exponential law, kappa beyond it where d_t = 1 - 1 / e
  DamageDefinition damage_definition = DamageDefinition::strength;

  struct State {
    double largest_compression = 0; ///< largest mu so far
    double shear_damage = 0;        ///< d of Eq. 24
    double tensile_damage = 0;      ///< d_t of Eq. 30
    double tensile_strain = 0;      ///< kappa, the strain history that drives d_t (see grow_tensile_damage)
    double plastic_strain = 0;      ///< effective, deviatoric
  };
  /// History variables by name, for output.
  static constexpr std::array<std::pair<const char*, double State::*>, 5> fields = {
      {{"largest_compression", &State::largest_compression},
       {"shear_damage", &State::shear_damage},
       {"tensile_damage", &State::tensile_damage},
       {"tensile_strain", &State::tensile_strain},
       {"plastic_strain", &State::plastic_strain}}};

  double bulk_modulus() const { return hydrostat.elastic_modulus(); } ///< of the uncrushed material, Pa
  double shear_modulus() const { return G; }
  double youngs_modulus() const { return 9 * bulk_modulus() * G / (3 * bulk_modulus() + G); }
  double poisson_ratio() const { return (3 * bulk_modulus() - 2 * G) / (2 * (3 * bulk_modulus() + G)); }
  /// Longitudinal wave speed of the stiffest branch the point can be on (unloading), m/s: for the time step.
  double sound_speed(const State& state) const {
    return std::sqrt((hydrostat.unloading_modulus(state.largest_compression) + 4. / 3 * G) / density);
  }

  /// Moduli of the stiffest branch the point can be on, for the stiffness.
  Tangent elastic(const State& state) const {
    return {.bulk = hydrostat.unloading_modulus(state.largest_compression), .shear = G};
  }

  /// Advances the (already rotated) Cauchy stress and the state by one step. Returns the tangent that
  /// stabilisation may use: the bulk modulus of the current branch (0 beyond the tension cut-off) and the
  /// shear stiffness of the radial return at fixed pressure (2G S / q across the flow direction, 0 along it;
  /// the dependence of S on pressure is left out because it is not symmetric). Shear is further scaled by the
  /// share of the strength that shear damage has left, and both by 1 - d_t in tension: a cracked point must
  /// not be held together by its stabilisation.
  Tangent update(Sym3& stress, State& state, const StrainStep& step) const;

  /// Binds the section "AFC". `needed`: whether its constants must be set (default: always).
  void declare(Parameters& parameters, std::function<bool()> needed = {});
  /// What no single key can check. @throws InputError, starting with `file`.
  void validate(const std::string& file) const;
  bool uses_table() const { return tensile_law == TensileLaw::table && !damage_table.empty(); }
  /// Makes the damage law for points `spacing` (m) apart: reads the damage table, if one is named and the law
  /// is `table`. Call after reading the inputs.
  /// @throws InputError: unreadable, or made for another material.
  void load(double spacing);
  /// The same from a table in memory.
  void use(const DamageTable& table, double spacing) { use(DamageLaw(table, spacing, damage_definition)); }
  void use(DamageLaw law);

private:
  struct TensileDamage {
    DamageLaw law;
    double threshold; ///< strain below which damage keeps its first value
    double delay;     ///< how far the tensile rate factor moves the threshold
    double first;     ///< damage of the unloaded cell
    double last;      ///< of the broken one: kappa is followed until damage gets there
  };
  std::optional<TensileDamage> tensile;

  double compression(double volume_ratio) const {
    return volumetric_strain == VolumetricStrain::logarithmic ? -std::log(volume_ratio)
                                                              : 1 / volume_ratio - 1;
  }
  /// Raises kappa and d_t if the stress pulls in some direction.
  void grow_tensile_damage(State& state, const Sym3& stress, const Mat3& deformation) const;
};

inline Tangent Afc::update(Sym3& stress, State& state, const StrainStep& step) const {
  // (i) pressure from the volume, before the cut-off (Eqs. 20 and 21)
  const double mu = compression(step.volume_ratio);
  double crushing = 0;
  if (mu > state.largest_compression) {
    crushing = hydrostat.crushed(mu) - hydrostat.crushed(state.largest_compression);
    state.largest_compression = mu;
  }
  const auto [uncut, modulus] = hydrostat(mu, state.largest_compression);

  // (ii) elastic predictor of the deviator
  const Sym3 de = deviator(step.increment);
  const double rate = std::sqrt(2. / 3 * contract(de, de)) / step.dt;
  Sym3 s = deviator(stress);
  for (int i = 0; i < 6; ++i) s[i] += 2 * G * de[i];
  const double q = equivalent_stress(s);

  // (iii) strength at the pressure and damage reached (Eqs. 22 and 23)
  if (tensile) state.tensile_damage = std::max(state.tensile_damage, tensile->first);
  double tension = surface.tension_limit(state.tensile_damage);
  auto strength = surface(uncut, state.shear_damage, tension, rate, s);

  // (iv) tensile damage from the stress that would be there without cut-off, then the strength it leaves
  // (Eq. 30)
  if (tensile) {
    const double kept = q > strength.stress ? strength.stress / q : 1;
    Sym3 pulled;
    for (int i = 0; i < 6; ++i) pulled[i] = kept * s[i] - (i < 3 ? uncut : 0);
    const double before = state.tensile_damage;
    if (!is_compressive(pulled)) grow_tensile_damage(state, pulled, step.deformation);
    if (state.tensile_damage > before) {
      tension = surface.tension_limit(state.tensile_damage);
      if (uncut < 0) strength = surface(uncut, state.shear_damage, tension, rate, s);
    }
  }

  // (v) tension cut-off
  const bool cut = uncut < -tension;
  const double pressure = cut ? -tension : uncut;
  const double soundness = uncut < 0 ? 1 - state.tensile_damage : 1;
  Tangent tangent{.bulk = cut ? 0 : modulus * soundness, .shear = G * soundness * strength.intact_share};
  if (volumetric_strain == VolumetricStrain::density_ratio) tangent.bulk /= step.volume_ratio;

  tangent.limit = strength.stress;

  // (vi) return map at that pressure
  if (q > strength.stress) {
    const double plastic = (q - strength.stress) / (3 * G);
    const double kept = strength.stress / q, norm = std::sqrt(1.5) / q;
    for (int i = 0; i < 6; ++i) {
      tangent.direction[i] = s[i] * norm;
      s[i] *= kept;
    }
    tangent.shear *= kept;
    tangent.flow = tangent.shear;
    state.plastic_strain += plastic;
    // Eq. 24, first term
    if (shear_damage)
      state.shear_damage += plastic / std::max(failure_strain_floor, D1 * surface.invariant_of(pressure));
  }
  // Eq. 24, second term, and its bound
  if (shear_damage) state.shear_damage = std::min(1.0, state.shear_damage + crushing / (1.5 * hydrostat.C9));

  for (int i = 0; i < 6; ++i) stress[i] = s[i] - (i < 3 ? pressure : 0);
  return tangent;
}

} // namespace spall
