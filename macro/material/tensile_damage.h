#pragma once

#include "macro/material/cracks.h"
#include "macro/material/material.h"
#include "macro/material/tensile_rate.h"

#include "shared/damage_law.h"
#include "shared/input/parameters.h"

#include <algorithm>
#include <limits>
#include <string>
#include <type_traits>
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
  /// beyond the undamaged tension limit may count as one crack (Trial::volume_alone), and the plastic strain
  /// along the largest
  /// principal stress of a point that flows while it is closed.
  tensile
};

/// Which share of kappa's strain counts where one direction is in tension and another in compression.
enum class DamageWeight {
  lee_fenves, ///< r = sum `<s_i>` / sum |s_i| of the principal stresses (Lee and Fenves 1998)
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
  /// Cracks along a radius, with rotational symmetry: hoop tension opens one over each 2 pi r /
  /// radial_cracks. 0: one over every crack band, as the cracks in other directions; in three dimensions
  /// cracks find their places themselves.
  double radial_cracks = 0;
  /// Spacings over which the approximation spreads the opening of one crack, so that d_t is that of a cell of
  /// this size: with a linear basis and supports of less than two spacings, a jump between two layers of
  /// points is a strain [u] / (2 h) of both.
  double crack_band = 2;
  /// On T_max and on the strain where tensile damage starts. A law is followed until the point opens or is
  /// damaged, and then held: its cracks have started at that rate.
  TensileRate rate;

  /// V: one point or several (lane_math.h).
  template<class V> struct StateOf : Cracks::StateOf<V> {
    V tensile_damage = broadcast<V>(0);         ///< d_t of Eq. 30
    V tensile_strain = broadcast<V>(0);         ///< kappa, the strain history that drives d_t (DamageStrain)
    V tensile_plastic_strain = broadcast<V>(0); ///< the part of kappa that the deviator no longer holds
    V tensile_rate_factor = broadcast<V>(1);    ///< in force
    V crack_width = broadcast<V>(1);            ///< of the material that a crack has to itself, over its band
  };
  using State = StateOf<double>;

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
  template<class V> V limit(const V& damage, const std::type_identity_t<V>& factor) const {
    return T_max * factor * (1 - damage);
  }
  double limit(double damage) const { return limit(damage, 1); }
  /// The same of a point.
  template<class V> V limit(const StateOf<V>& state, const Curve& curve) const {
    return limit(state.tensile_damage, state.tensile_rate_factor * curve.strength);
  }

  /// Starts a step: the damage of the unloaded cell, and the rate factor of a point that is neither open nor
  /// damaged: also under pressure, where its largest principal stress can be limited (TensionLimit). @param
  /// pressure trial pressure (without tension cut-off), Pa
  template<class V>
  void begin(StateOf<V>& state, const Curve& curve, const V& pressure, const StrainStepOf<V>& step) const {
    state.tensile_damage = larger(state.tensile_damage, curve.first);
    if (rate.is_constant()) {
      state.tensile_rate_factor = broadcast<V>(rate.constant);
      return;
    }
    const Mask<V> sound = (state.tensile_damage <= curve.first) & (state.bulk_left == 1.) &
                          (pressure >= -limit(broadcast<V>(curve.first), state.tensile_rate_factor));
    if (any(sound))
      state.tensile_rate_factor =
          select(sound, rate(V(square_root(contract(step.increment, step.increment)) / step.dt)),
                 state.tensile_rate_factor);
  }

  /// Trial state of a step: the stress that would be there without tension cut-off, Pa.
  template<class V> struct Trial {
    V pressure, modulus;     ///< of the hydrostat: P, dP / dmu
    Sym<V> deviator;         ///< predictor, of an open point with the shear stiffness it has left
    V equivalent;            ///< equivalent stress of the predictor
    V shear_modulus;         ///< of the predictor
    V return_factor;         ///< strength over equivalent stress, at most 1: what the strength keeps of it
    V carried;               ///< equivalent stress of the predictor before the strain of the step
    const Mat3& deformation; ///< F at the end of the step
    double spacing, radius;  ///< StrainStep, m
    /// Whether the volume beyond the undamaged limit is one crack that no change of shape belongs to: a point
    /// whose mean tension is limited for itself. Otherwise volume and shape open together.
    bool volume_alone;
  };
  template<class V> struct Growth {
    Mask<V> damaged{};          ///< whether d_t has grown
    V strain = broadcast<V>(0); ///< weighted strain of the deviator along the largest principal stress: what
                                ///< becomes plastic if all of the trial deviator flows away
  };
  /// Raises kappa and d_t if the trial stress is tensile in some direction (Eq. 30).
  Growth<double> grow(State& state, const Curve& curve, const Trial<double>& trial) const;
  /// The same of several points: one after the other, as few at a time are near their next damage.
  template<class V> Growth<V> grow(StateOf<V>& state, const Curve& curve, const Trial<V>& trial) const;

  /// Width of the material that a crack has to itself, over its band, for a crack that the axis of rotation
  /// lies in and hoop tension opens; 1 without such an axis (`radius` 0). @param radius, spacing StrainStep,
  /// m
  double width_of_radial_crack(double radius, double spacing) const;

  bool uses_table() const { return law == TensileLaw::table && !table.empty(); }
  /// Makes the curves for points of these spacings (m, in any order): reads the damage table, if one is named
  /// and the law is `table`. @param youngs_modulus, poisson_ratio those of the material (Pa, 1).
  /// @throws InputError: unreadable, made for another material, not made by pulling, or without damage
  void prepare(const std::vector<double>& spacings, double youngs_modulus, double poisson_ratio);
  /// The same from a table in memory.
  void use(const DamageTable& table, std::vector<double> spacings);

  void declare(Parameters::Section& section);
  /// The keys of d_t alone: for laws with a strength of their own.
  void declare_damage(Parameters::Section& section);

private:
  /// Upper bound of the kappa of a trial state, by the `tensile` strain: most points stop here, below the
  /// largest so far. No bound is known of a point that flows.
  template<class V>
  V largest_tension_strain(const StateOf<V>& state, const Curve& curve, const Trial<V>& trial) const;
  /// kappa where damage can grow. A higher rate factor delays the start of damage by as much as it raises the
  /// elastic strain at the limit.
  template<class V> V threshold_of(const StateOf<V>& state, const Curve& curve) const {
    return larger(state.tensile_strain, V(state.tensile_rate_factor * curve.threshold));
  }
  void add(const DamageLaw& law, double spacing);
  /// StateOf::crack_width across the largest principal stress; as before if there is none.
  double width_of_crack(const State& state, const Trial<double>& trial) const;
  /// r of the principal stresses, at least one of which is positive.
  double weight_of(const Vec3& principal) const;
  /// kappa from the largest principal strain of the whole deformation; not above `floor`: some value that is
  /// not above it.
  double total_strain(const Sym3& stress, const Mat3& deformation, double floor) const;
  /// kappa from what tension has strained, in the same way; sets `along` to the strain of Growth.
  double tension_strain(const State& state, const Curve& curve, const Trial<double>& trial, double floor,
                        double& along) const;

  std::vector<Curve> curves; ///< ascending spacing; empty: no tensile damage
  Curve no_damage;
};

template<class V>
V TensileDamage::largest_tension_strain(const StateOf<V>& state, const Curve& curve,
                                        const Trial<V>& trial) const {
  const V undamaged_limit = limit(broadcast<V>(curve.first), state.tensile_rate_factor * curve.strength);
  const V mean_tension = trial.modulus * state.opened - trial.pressure;
  const V elastic = trial.volume_alone ? smaller(mean_tension, undamaged_limit) : mean_tension;
  const V mean = elastic / (3 * trial.modulus),
          opening = larger(0, V(mean_tension - elastic)) / trial.modulus;
  // The largest principal deviator is at most 2/3 of the equivalent stress, the weight at most 1.
  const V shear = 2 * trial.shear_modulus;
  const V shape = select(shear > 0., V(2. / 3 * trial.equivalent / shear), 0);
  return select(trial.return_factor == 1.,
                V(state.tensile_plastic_strain + larger(0, V(opening + mean + shape))),
                std::numeric_limits<double>::infinity());
}

template<class V>
TensileDamage::Growth<V> TensileDamage::grow(StateOf<V>& state, const Curve& curve,
                                             const Trial<V>& trial) const {
  constexpr int L = sizeof(V) / sizeof(double);
  Growth<V> growth;
  // The largest principal stress is at most 2/3 of the equivalent stress plus the mean.
  Mask<V> near = (state.tensile_damage < curve.last) &
                 (2. / 3 * trial.return_factor * trial.equivalent > trial.pressure);
  if (strain == DamageStrain::tensile)
    near &= largest_tension_strain(state, curve, trial) > threshold_of(state, curve);
  if (!any(near)) return growth;
  for (int m = 0; m < L; ++m) {
    if (!near[m]) continue;
    State one = state_in_lane<L, StateOf>(state, m);
    const Growth<double> growth_of_one = grow(one, curve,
                                              {.pressure = trial.pressure[m],
                                               .modulus = trial.modulus[m],
                                               .deviator = lane<L>(trial.deviator, m),
                                               .equivalent = trial.equivalent[m],
                                               .shear_modulus = trial.shear_modulus[m],
                                               .return_factor = trial.return_factor[m],
                                               .carried = trial.carried[m],
                                               .deformation = trial.deformation,
                                               .spacing = trial.spacing,
                                               .radius = trial.radius,
                                               .volume_alone = trial.volume_alone});
    growth.damaged[m] = growth_of_one.damaged ? -1 : 0;
    growth.strain[m] = growth_of_one.strain;
    state.tensile_damage[m] = one.tensile_damage;
    state.tensile_strain[m] = one.tensile_strain;
    state.crack_width[m] = one.crack_width;
  }
  return growth;
}

} // namespace spall
