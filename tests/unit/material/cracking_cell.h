#pragma once

#include "tests/unit/material/samples.h"

namespace spall::test {

/// Makes a damage table in closed form: a layer of the concrete of edge l with one crack that opens by w =
/// w_f (1 - stress / f) after the stress has reached f; its fracture energy is f w_f / 2. There is no initial
/// crack, so the stiffness damage starts at 0 too.
inline DamageTable cracking_cell(const Afc& afc, double cell_size, double strength, double fracture_energy) {
  DamageTable table;
  table.youngs_modulus = afc.youngs_modulus();
  table.poisson_ratio = afc.poisson_ratio();
  table.tensile_strength = strength;
  table.fracture_energy = fracture_energy;
  table.softening = "linear";
  table.crack_set = "one crack across the cell";
  table.boundary = "periodic";
  const double E = table.oedometric_modulus(), full_opening = 2 * fracture_energy / strength;
  DamageCurve curve;
  curve.cell_size = cell_size;
  const auto row = [&](double stress, double opening) {
    const double strain = stress / E + opening / cell_size;
    const bool broken = opening > 0;
    const double stiffness = strain > 0 ? 1 - stress / (E * strain) : 0;
    for (const DamageColumn& column : damage_columns) (curve.*column.values).push_back(0);
    curve.strain.back() = strain;
    curve.stress.back() = stress;
    curve.psi_undamaged.back() = curve.psi_undamaged_plus.back() = E * strain * strain / 2;
    curve.opening.back() = opening;
    curve.damage.back() = curve.damage_renormalised.back() = broken ? stiffness : 0;
    curve.damage_strength.back() = broken ? 1 - stress / strength : 0;
  };
  row(0, 0);
  for (int i = 0; i <= 200; ++i) row(strength * (1 - i / 200.), full_opening * i / 200.);
  table.curves.push_back(curve);
  return table;
}

} // namespace spall::test
