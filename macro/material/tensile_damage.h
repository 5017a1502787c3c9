#pragma once

#include "macro/material/cracks.h"
#include "macro/material/material.h"
#include "macro/material/tensile_rate.h"

#include "shared/damage_law.h"
#include "shared/input/parameters.h"

#include <algorithm>
#include <string>
#include <vector>

namespace spall {

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
  /// What tension has strained: the largest principal strain of the free energy (Cracks), in which the volume
  /// beyond the undamaged tension limit counts as one crack, and the plastic strain along the largest
  /// principal stress of a point that flows while it is closed.
  tensile
};

/// Which share of kappa's strain counts where one direction is in tension and another in compression.
enum class DamageWeight {
  lee_fenves, ///< r = sum <s_i> / sum |s_i| of the principal stresses (Lee and Fenves 1998)
  none        ///< all of it as soon as one direction is in tension
};

/// What tension does to the strength of concrete: the limit T_max (1 - d_t) of the mean tension and its rate
/// effect, and the damage d_t informed by microcracks (Eq. 30, if there is a damage table). SI units, tension
/// positive, pressures compression positive.
///
/// T_max is the strength of the mean concrete. The weak and strong tables of an ensemble say by which factor
/// their peak stress differs from the mean's, and T_max is multiplied by it: their strength damage starts at
/// 0 like the mean's, because a strength above the mean's cannot be a damage. The damages of stiffness hold
/// the stress itself and need no factor.
struct TensileDamage {
  double T_max = required; ///< largest mean tension, undamaged and at rest, Pa
  TensileLaw law = TensileLaw::table;
  std::string table;       ///< path; empty: the original AFC, no tensile damage
  double threshold = 6e-4; ///< of the exponential law: kappa where damage starts
  double scale = 1e-3;     ///< of the exponential law: kappa beyond it where d_t = 1 - 1 / e
  DamageDefinition definition = DamageDefinition::strength;
  DamageStrain strain = DamageStrain::tensile;
  DamageWeight weight = DamageWeight::lee_fenves;
  /// On T_max and on the strain where tensile damage starts. A law is followed until the point opens or is
  /// damaged, and then held: its cracks have started at that rate.
  TensileRate rate;

  struct State : Cracks::State {
    double tensile_damage = 0;         ///< d_t of Eq. 30
    double tensile_strain = 0;         ///< kappa, the strain history that drives d_t (see DamageStrain)
    double tensile_plastic_strain = 0; ///< the part of kappa that the deviator no longer holds (tensile)
    double tensile_rate_factor = 1;    ///< in force
  };

  /// d_t(kappa) for points of one spacing. By default there is none.
  struct Curve {
    double spacing = 0; ///< of the points it is for, m
    DamageLaw damage;
    double strength = 1;  ///< factor on T_max (DamageLaw::strength_factor)
    double threshold = 0; ///< strain below which damage keeps its first value
    double first = 0;     ///< damage of the unloaded cell
    double last = 0;      ///< damage of the broken cell: kappa is followed until d_t gets there
  };
  /// The curve of the spacing nearest to this one.
  const Curve& curve_at(double spacing) const {
    if (curves.empty()) return no_damage;
    std::size_t i = 0;
    while (i + 1 < curves.size() && 2 * spacing > curves[i].spacing + curves[i + 1].spacing) ++i;
    return curves[i];
  }

  /// Largest mean tension at damage d_t, Pa (Eq. 30). @param factor of the rate and of the damage table
  double limit(double damage, double factor = 1) const { return T_max * factor * (1 - damage); }
  /// The same of a point.
  double limit(const State& state, const Curve& curve) const {
    return limit(state.tensile_damage, state.tensile_rate_factor * curve.strength);
  }

  /// Starts a step: the damage of the unloaded cell, and the rate factor of a point that is in tension but
  /// neither open nor damaged. @param pressure trial pressure (without tension cut-off), Pa
  void begin(State& state, const Curve& curve, double pressure, const StrainStep& step) const {
    if (state.tensile_damage < curve.first) state.tensile_damage = curve.first;
    if (rate.is_constant())
      state.tensile_rate_factor = rate.constant;
    else if (pressure < 0 && state.tensile_damage <= curve.first && state.bulk_left == 1 &&
             pressure >= -limit(curve.first, state.tensile_rate_factor))
      state.tensile_rate_factor = rate(std::sqrt(contract(step.increment, step.increment)) / step.dt);
  }

  /// Trial state of a step: the stress that would be there without tension cut-off, Pa.
  struct Trial {
    double pressure, modulus; ///< of the hydrostat: P, dP / dmu
    const Sym3& deviator;     ///< predictor, of an open point with the shear stiffness it has left
    double equivalent;        ///< equivalent stress of the predictor
    double shear_modulus;     ///< of the predictor
    double return_factor;     ///< strength over equivalent stress, at most 1: what the strength keeps of it
    double carried;           ///< equivalent stress of the predictor before the strain of the step
    const Mat3& deformation;  ///< F at the end of the step
  };
  struct Growth {
    bool damaged = false; ///< whether d_t has grown
    double strain = 0; ///< weighted strain of the deviator along the largest principal stress: what becomes
                       ///< plastic if all of the trial deviator flows away
  };
  /// Raises kappa and d_t if the trial stress is tensile in some direction (Eq. 30).
  Growth grow(State& state, const Curve& curve, const Trial& trial) const;

  bool uses_table() const { return law == TensileLaw::table && !table.empty(); }
  /// Makes the curves for points of these spacings (m, in any order): reads the damage table, if one is named
  /// and the law is `table`. @param youngs_modulus, poisson_ratio those of the material (Pa, 1).
  /// @throws InputError: unreadable, made for another material, not made by pulling, or without damage
  void prepare(const std::vector<double>& spacings, double youngs_modulus, double poisson_ratio);
  /// The same from a table in memory.
  void use(const DamageTable& table, std::vector<double> spacings);

  void declare(Parameters::Section& section);

private:
  void add(const DamageLaw& law, double spacing);
  /// r of the principal stresses, at least one of which is positive.
  double weight_of(const Vec3& principal) const;
  /// kappa from the largest principal strain of the whole deformation; not above `floor`: some value that is
  /// not above it.
  double total_strain(const Sym3& stress, const Mat3& deformation, double floor) const;
  /// kappa from what tension has strained, in the same way; sets `along` to the strain of Growth.
  double tension_strain(const State& state, const Curve& curve, const Trial& trial, double floor,
                        double& along) const;

  std::vector<Curve> curves; ///< ascending spacing; empty: no tensile damage
  Curve no_damage;
};

} // namespace spall
