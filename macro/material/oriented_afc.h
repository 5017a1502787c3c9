#pragma once

#include "macro/material/afc.h"
#include "macro/material/oriented_cracks.h"

namespace spall {

/// The Advanced Fundamental Concrete model with cracks that have directions (`Crack model` of Afc, which
/// holds the constants). Under pressure it is Afc: hydrostat, strength and shear damage of Eqs. 20 to 24. In
/// tension Eqs. 23 and 30 are replaced by a limit of the tension across each crack,
///
///   f = min(T_max R (1 - d_t), (C1 - C2) (1 - d)),
///
/// with the rate factor R, the damage d_t of the microcell at the crack's own largest opening, and the shear
/// damage d, which leaves rubble without tension. Between the cracks the strength is that of Eq. 22, at P = 0
/// if the mean stress is tension. A strain that opens cracks is no plastic strain: it raises d_t alone.
///
/// The stress of the concrete between the cracks acts on its own volume, the share exp(-(e1 + e2 + e3)) of
/// the point's. Without that share a point whose crack opens would gain the elastic energy of its own growth.
struct OrientedAfc {
  static constexpr const char* name = Afc::name;
  static constexpr bool ductile = Afc::ductile;

  Afc afc;
  OrientedCracks cracks;
  FailureSurface strength; ///< of Eq. 22 alone

  OrientedAfc() = default;
  explicit OrientedAfc(const Afc& constants);

  struct State : Afc::State, OrientedCracks::State {
    double swelling = 0; ///< volumetric strain that is not in J (StrainStep::swelling)

    /// Volume of the concrete between the cracks over that of the cell.
    double solid_share() const { return cracked() ? std::exp(swelling - opened) : 1; }
  };
  /// Whether a sub-point has a volume of its own: its cracks have opened.
  static bool own_volume(const State& state) { return state.cracked(); }
  /// Those of Afc.
  static constexpr auto fields = [] {
    std::array<HistoryField<State>, Afc::fields.size()> all{};
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i] = {Afc::fields[i].name, Afc::fields[i].value, Afc::fields[i].unit};
    return all;
  }();
  /// Volume of the cell over that of the concrete between its cracks: what energies per volume belong to.
  static double volume(const State& state) { return 1 / state.solid_share(); }

  double density = required; ///< kg/m^3
  double bulk_modulus() const { return afc.bulk_modulus(); }
  double shear_modulus() const { return afc.G; }
  double sound_speed(const State& state) const { return afc.sound_speed(state); }
  Stiffness elastic(const State& state) const { return afc.elastic(state); }
  /// Free energy (OrientedCracks).
  StoredEnergy stored_energy(const Sym3& stress, const State& state) const;
  /// Advances the (already rotated) Cauchy stress and the state by one step. Returns the stiffness for
  /// stabilisation, not the derivative of the stress.
  Stiffness update(Sym3& stress, State& state, const StrainStep& step) const;

  void declare(Parameters&, const Needed&, const std::string&) {} ///< Afc binds its keys
  void validate(const std::string& file, const std::string& section) const { afc.validate(file, section); }
  void prepare(const std::vector<double>& spacings) { afc.prepare(spacings); }
  bool softens() const { return afc.softens(); }
  bool needs_spacing() const { return afc.needs_spacing(); }
  double strength_limit() const { return afc.strength_limit(); }
  Description describe() const { return afc.describe(); }

private:
  bool may_crack(State& state, const TensileDamage::Curve& curve, const Sym3& stress,
                 const StrainStep& step) const;
  void limit_tension(State& state, const TensileDamage::Curve& curve) const;
  void damage(State& state, const TensileDamage::Curve& curve, const StrainStep& step) const;
};

} // namespace spall
