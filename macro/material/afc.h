#pragma once

#include "macro/material/failure_surface.h"
#include "macro/material/hydrostat.h"
#include "macro/material/material.h"
#include "macro/material/tensile_rate.h"

#include "shared/damage_law.h"
#include "shared/input/parameters.h"

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

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

/// Which strain the history kappa of tensile damage follows. Both are the strain of a cell that is pulled in
/// one direction, in uniaxial stress or strain, from the start.
enum class DamageStrain {
  /// Largest principal strain of the whole deformation: a point that was sheared under pressure is broken as
  /// soon as any tension meets it.
  total,
  /// What tension has strained: the largest principal elastic strain, the volume that has opened beyond the
  /// undamaged tension limit, as one crack, and the plastic strain along the pull of a point that flows while
  /// it is not open.
  tensile
};

/// What counts of kappa's strain where one direction pulls and another presses.
enum class DamageWeight {
  lee_fenves, ///< r = sum <s_i> / sum |s_i| of the principal stresses (Lee and Fenves 1998)
  none        ///< all of it as soon as one direction pulls
};

/// Where a damage lowers the strength: on the side of P = 0 that it belongs to (that of shear in compression,
/// that of tension in tension), or on both.
enum class DamageSide { own, both };

/// Concrete: the Advanced Fundamental Concrete model (Eqs. 20-24), with tensile damage informed by
/// microcracks (Eq. 30) if a damage table is loaded. Constants of Table 1 in SI units; tension positive,
/// pressures and mu compression positive.
///
/// The pressure is a function of J and of the largest compression reached, cut off at the tension limit
/// T_max (1 - d_t), which may grow with the strain rate: a point that has opened closes along the same line,
/// but for the part of what has opened that stays (`opened_kept`). The deviator is elastic, then returned
/// radially to the failure surface at that pressure.
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
  /// Eqs. 22 and 30 as printed: d takes the cohesion on both sides, d_t the mean tension alone.
  DamageSide shear_damage_side = DamageSide::both, tensile_damage_side = DamageSide::own;
  /// The plastic strain to failure of Eq. 24 belongs to points this far apart, m; at another spacing h it is
  /// multiplied by reference / h, so that a shear band one spacing wide dissipates the same per area at any
  /// spacing (crack band: Bazant and Oh 1983). 0: the same strain at any spacing.
  double shear_reference = 0; // at spacing 0, a point that is driven alone, the strain is not scaled
  /// Smallest plastic strain to failure. Eq. 24 as printed (0) divides by a pressure that vanishes and fails
  /// the point at its first plastic step in tension; 0.01 is EFmin of Holmquist, Johnson and Cook's concrete.
  double failure_strain_floor = 0.01;
  TensileLaw tensile_law = TensileLaw::table;
  std::string damage_table;       ///< path; empty: the original AFC, no tensile damage
  double damage_threshold = 6e-4; ///< of the exponential law, kappa where damage starts
  double damage_scale = 1e-3;     ///< of the exponential law, kappa beyond it where d_t = 1 - 1 / e
  DamageDefinition damage_definition = DamageDefinition::strength;
  DamageStrain damage_strain = DamageStrain::tensile;
  DamageWeight damage_weight = DamageWeight::lee_fenves;
  /// On T_max and on the strain where tensile damage starts. A law is followed until the point opens or is
  /// damaged, and then held: a strength that grew with an open crack would create energy.
  TensileRate tensile_rate;

  /// Part of the volume opened beyond the tension cut-off that stays, as the pieces no longer fit: 0, a point
  /// closes like the crack of the microcell before it carries pressure again; 1, pressure returns at once.
  double opened_kept = 0;
  /// Opening over slip where the faces of a rough crack touch again without pressure on them: an open point
  /// that is sheared keeps that much of what it has opened. The slip of a crack band is the engineering shear
  /// of the plastic strain that is left when the strain of a crack that just opens is taken off.
  double crack_dilatancy = 0;

  struct State {
    double largest_compression = 0;    ///< largest mu so far
    double opened = 0;                 ///< volumetric strain that has opened and stays
    double shear_damage = 0;           ///< d of Eq. 24
    double tensile_damage = 0;         ///< d_t of Eq. 30
    double tensile_strain = 0;         ///< kappa, the strain history that drives d_t (see DamageStrain)
    double plastic_strain = 0;         ///< effective, deviatoric
    double tensile_plastic_strain = 0; ///< the plastic part of kappa (DamageStrain::tensile)
    double tensile_rate_factor = 1;    ///< in force
  };
  /// History variables by name, for output.
  static constexpr std::array<std::pair<const char*, double State::*>, 6> fields = {
      {{"largest_compression", &State::largest_compression},
       {"shear_damage", &State::shear_damage},
       {"tensile_damage", &State::tensile_damage},
       {"tensile_strain", &State::tensile_strain},
       {"plastic_strain", &State::plastic_strain},
       {"tensile_rate_factor", &State::tensile_rate_factor}}};

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
  /// Makes the damage laws for points of these spacings (m, in any order, as often as there are points):
  /// reads the damage table, if one is named and the law is `table`. Call after reading the inputs.
  /// @throws InputError: unreadable, or made for another material.
  void load(const std::vector<double>& spacings);
  /// The same from a table in memory.
  void use(const DamageTable& table, std::vector<double> spacings);

private:
  struct TensileDamage {
    double spacing; ///< of the points it is for, m
    DamageLaw law;
    double strength;  ///< DamageLaw::strength_factor()
    double threshold; ///< strain below which damage keeps its first value
    double first;     ///< damage of the unloaded cell
    double last;      ///< of the broken one: kappa is followed until damage gets there
  };
  std::vector<TensileDamage> tensile; ///< ascending spacing; empty: no tensile damage
  void add(const DamageLaw& law, double spacing);
  /// The law of the spacing nearest to this one; null if there is none.
  const TensileDamage* tensile_at(double spacing) const {
    std::size_t i = 0;
    while (i + 1 < tensile.size() && 2 * spacing > tensile[i].spacing + tensile[i + 1].spacing) ++i;
    return tensile.empty() ? nullptr : &tensile[i];
  }

  /// Share of the cohesion C1 - C2 that damage has taken at a pressure: d of Eqs. 22 and 30.
  double cohesion_lost(const State& state, double pressure) const {
    const bool sheared = pressure >= 0 || shear_damage_side == DamageSide::both;
    const bool cracked = tensile_damage_side == DamageSide::both;
    return 1 - (1 - (sheared ? state.shear_damage : 0)) * (1 - (cracked ? state.tensile_damage : 0));
  }
  double compression(double volume_ratio) const {
    return volumetric_strain == VolumetricStrain::logarithmic ? -std::log(volume_ratio)
                                                              : 1 / volume_ratio - 1;
  }
  /// Plastic strain to failure of Eq. 24 for points `spacing` apart.
  double failure_strain(double pressure, double spacing) const {
    const double strain = std::max(failure_strain_floor, D1 * surface.invariant_of(pressure));
    return shear_reference > 0 && spacing > 0 ? strain * shear_reference / spacing : strain;
  }
  /// The stress that would be there without tension cut-off.
  struct Pull {
    double pressure, modulus; ///< of the hydrostat, Pa
    double opened;            ///< volumetric strain that has opened and is not in that pressure
    const Sym3& trial;        ///< elastic predictor of the deviator, Pa
    double equivalent;        ///< of the trial, Pa
    double kept;              ///< share of the trial that the strength lets stand
    double first_limit;       ///< of mean tension without damage, Pa
    double limit;             ///< of mean tension now, Pa
    double carried;           ///< equivalent stress before the step, Pa
  };
  /// Raises kappa and d_t if that stress pulls in some direction. Returns the strain along the pull, with its
  /// weight, that becomes plastic if all of the trial deviator flows away.
  double grow_tensile_damage(State& state, const TensileDamage& law, const Pull& pull,
                             const Mat3& deformation) const;
  double weight(const Vec3& principal) const;
};

inline Tangent Afc::update(Sym3& stress, State& state, const StrainStep& step) const {
  // (i) pressure from the volume, before the cut-off (Eqs. 20 and 21)
  const double mu = compression(step.volume_ratio) + state.opened;
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

  // (iii) strength at the pressure, rate and damage reached (Eqs. 22 and 23)
  const TensileDamage* const law = tensile_at(step.spacing);
  const double first = law ? law->first : 0;
  if (state.tensile_damage < first) state.tensile_damage = first;
  if (tensile_rate.is_constant())
    state.tensile_rate_factor = tensile_rate.constant;
  else if (uncut < 0 && state.tensile_damage <= first &&
           uncut >= -surface.tension_limit(first, state.tensile_rate_factor))
    state.tensile_rate_factor = tensile_rate(std::sqrt(contract(step.increment, step.increment)) / step.dt);
  const double factor = state.tensile_rate_factor * (law ? law->strength : 1);
  double tension = surface.tension_limit(state.tensile_damage, factor);
  auto strength = surface(uncut, cohesion_lost(state, uncut), tension, rate, s);

  // (iv) tensile damage from the stress that would be there without cut-off, then the strength it leaves
  // (Eq. 30)
  double pulled_strain = 0;
  if (law) {
    const double before = state.tensile_damage;
    pulled_strain = grow_tensile_damage(state, *law,
                                        {.pressure = uncut,
                                         .modulus = modulus,
                                         .opened = state.opened,
                                         .trial = s,
                                         .equivalent = q,
                                         .kept = q > strength.stress ? strength.stress / q : 1,
                                         .first_limit = surface.tension_limit(first, factor),
                                         .limit = tension,
                                         .carried = equivalent_stress(deviator(stress))},
                                        step.deformation);
    if (state.tensile_damage > before) {
      tension = surface.tension_limit(state.tensile_damage, factor);
      strength = surface(uncut, cohesion_lost(state, uncut), tension, rate, s);
    }
  }

  // (v) tension cut-off
  const bool cut = uncut < -tension;
  const double opening = state.opened - (uncut + tension) / modulus; // if cut
  if (cut) // of the widest opening so far: opening again up to there adds nothing
    state.opened = std::max(state.opened, opened_kept * opening);
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
    if (cut) {
      // A band of a crack that opens by w and slips by s, per width: equivalent strain^2 = 4/9 w^2 + s^2 / 3.
      const double widening = trace(step.increment);
      const double slip = std::sqrt(std::max(0.0, 3 * plastic * plastic - 4. / 3 * widening * widening));
      state.opened = std::max(state.opened, std::min(opening, state.opened + crack_dilatancy * slip));
    }
    state.tensile_plastic_strain += (1 - kept) * pulled_strain;
    // Eq. 24, first term
    if (shear_damage) state.shear_damage += plastic / failure_strain(pressure, step.spacing);
  }
  // Eq. 24, second term, and its bound
  if (shear_damage) state.shear_damage = std::min(1.0, state.shear_damage + crushing / (1.5 * hydrostat.C9));

  for (int i = 0; i < 6; ++i) stress[i] = s[i] - (i < 3 ? pressure : 0);
  return tangent;
}

} // namespace spall
