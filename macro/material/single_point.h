#pragma once

#include "macro/material/material.h"
#include "shared/error.h"
#include "shared/input/quantity.h"

#include <algorithm>
#include <cmath>

namespace spall {

/// exp(a) by scaling and squaring, to round-off for strains of any practical size.
inline Mat3 exponential(const Sym3& a) {
  int squarings = 0;
  double scale = 1;
  for (double size = std::sqrt(contract(a, a)); size * scale > 0.125; ++squarings) scale /= 2;
  const Mat3 x = {a[0] * scale, a[3] * scale, a[5] * scale, a[3] * scale, a[1] * scale,
                  a[4] * scale, a[5] * scale, a[4] * scale, a[2] * scale};
  Mat3 sum = identity3, term = identity3;
  for (int k = 1; k <= 10; ++k) { // 0.125^11 / 11! < 1e-16
    term = multiply(term, x);
    for (int i = 0; i < 9; ++i) sum[i] += (term[i] /= k);
  }
  for (; squarings > 0; --squarings) sum = multiply(sum, sum);
  return sum;
}

/// One material point driven by small-strain increments without spin: F grows by exp(increment), so that
/// ln J is the trace of the sum of the increments.
template<class Material> class SinglePoint {
public:
  /// `spacing`: edge of the cell the point stands for, m (laws that soften). `radius`: StrainStep::radius, m.
  explicit SinglePoint(const Material& material_, double spacing_ = 0, double radius_ = 0)
      : material(&material_), spacing(spacing_), radius(radius_) {}

  Sym3 strain{}; ///< sum of the increments
  Sym3 stress{}; ///< Pa
  typename Material::State state{};
  Mat3 deformation = identity3; ///< F
  double work = 0;              ///< integral of volume() stress : d strain, J/m^3
  double exchanged_work = 0;    ///< the same with every step's work counted as positive
  double largest_stress = 0;    ///< largest component so far, Pa

  double volume_ratio() const { return std::exp(trace(strain)); }
  /// Present volume over the one that the law's energies belong to.
  double volume() const {
    if constexpr (requires { Material::volume(state); })
      return Material::volume(state);
    else
      return 1;
  }

  Stiffness advance(const Sym3& increment, double dt) {
    const Sym3 before = volume() * stress;
    for (int i = 0; i < 6; ++i) strain[i] += increment[i];
    deformation = multiply(exponential(increment), deformation);
    const Stiffness tangent = material->update(
        stress, state, {increment, dt, volume_ratio(), deformation, spacing, radius, &rotation});
    rotation = identity3;
    const double done = (contract(before, increment) + volume() * contract(stress, increment)) / 2;
    work += done;
    exchanged_work += std::abs(done);
    largest_stress = std::max(largest_stress, largest_component(stress));
    return tangent;
  }

  /// Turns the point as a whole, with its stress: a rotation before the next increment.
  void turn(const Mat3& q) {
    stress = rotate(q, stress);
    strain = rotate(q, strain);
    deformation = multiply(q, deformation);
    rotation = multiply(q, rotation);
  }

  /// Uniaxial stress along x: the increments yy = zz are found, by bisection, that leave no stress across.
  /// Every history so far must have been uniaxial too. A bracketing method, because a law that softens has
  /// steep kinks there that Newton's method does not survive.
  /// @throws ComputationError if no increment brings the stress across below 1e-8 of the shear modulus; the
  /// point is then as before.
  void advance_with_free_sides(double axial, double dt) {
    const double aim = 1e-11 * material->shear_modulus(), acceptable = 1e-8 * material->shear_modulus();
    const auto across = [&](double lateral) {
      SinglePoint trial = *this;
      trial.advance({axial, lateral, lateral, 0, 0, 0}, dt);
      return trial.stress[1];
    };
    // Bracket, from the last step's ratio of lateral to axial increment: the stress across rises with
    // lateral.
    double lateral = ratio * axial, stress_across = across(lateral);
    double near = lateral, far = lateral, reach = 1e-3 * std::abs(axial) + 1e-12;
    const double side = stress_across > 0 ? -1 : 1;
    for (int doubling = 0; std::abs(stress_across) > aim && side * stress_across < 0 && doubling < 60;
         ++doubling) {
      near = lateral;
      lateral = far += side * reach;
      reach *= 2;
      stress_across = across(lateral);
    }
    for (int halving = 0; std::abs(stress_across) > aim && halving < 120; ++halving) {
      lateral = (near + far) / 2;
      stress_across = across(lateral);
      (side * stress_across < 0 ? near : far) = lateral;
    }
    if (!(std::abs(stress_across) <= acceptable))
      throw ComputationError("no lateral strain with free sides found at exx = " +
                             format_quantity(strain[0] + axial, Dimension::none) + ": stress across " +
                             format_quantity(stress_across, Dimension::stress) + "; use more Path/Substeps");
    advance({axial, lateral, lateral, 0, 0, 0}, dt);
    if (axial != 0) ratio = lateral / axial;
  }

private:
  const Material* material;
  Mat3 rotation = identity3; ///< since the last increment
  double spacing, radius;
  double ratio = 0; ///< lateral over axial increment of the last step
};

} // namespace spall
