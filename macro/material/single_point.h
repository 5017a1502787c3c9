#pragma once

#include "macro/material/material.h"
#include "shared/error.h"
#include "shared/input/quantity.h"

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
  explicit SinglePoint(const Material& material_) : material(material_) {}

  Sym3 strain{}; ///< sum of the increments
  Sym3 stress{}; ///< Pa
  typename Material::State state{};
  Mat3 deformation = identity3; ///< F
  double work = 0;              ///< integral of stress : d strain, J/m^3

  double volume_ratio() const { return std::exp(trace(strain)); }

  Tangent advance(const Sym3& increment, double dt) {
    const Sym3 before = stress;
    for (int i = 0; i < 6; ++i) strain[i] += increment[i];
    deformation = multiply(exponential(increment), deformation);
    const Tangent tangent = material.update(stress, state, {increment, dt, volume_ratio(), deformation});
    work += (contract(before, increment) + contract(stress, increment)) / 2;
    return tangent;
  }

  /// The same with increments yy and zz chosen so that the stresses yy and zz vanish (to 1e-10 of the shear
  /// modulus): Newton's method with finite differences and step halving.
  /// @throws ComputationError if none is found; the point is then as before.
  void advance_with_free_sides(Sym3 increment, double dt) {
    const double tolerance = 1e-10 * material.shear_modulus();
    constexpr double probe = 1e-8; // strain
    constexpr int most_iterations = 60;
    double yy = increment[0] * ratio[0], zz = increment[0] * ratio[1];
    const auto sides = [&](double a, double b) {
      SinglePoint trial = *this;
      increment[1] = a, increment[2] = b;
      trial.advance(increment, dt);
      return std::array{trial.stress[1], trial.stress[2]};
    };
    const auto size = [](const std::array<double, 2>& r) { return std::hypot(r[0], r[1]); };
    auto r = sides(yy, zz);
    for (int iteration = 0; size(r) > tolerance; ++iteration) {
      const auto ry = sides(yy + probe, zz), rz = sides(yy, zz + probe);
      const double a = (ry[0] - r[0]) / probe, b = (rz[0] - r[0]) / probe, c = (ry[1] - r[1]) / probe,
                   d = (rz[1] - r[1]) / probe, det = a * d - b * c;
      double dy = -(d * r[0] - b * r[1]) / det, dz = -(a * r[1] - c * r[0]) / det;
      auto next = sides(yy + dy, zz + dz);
      for (int halving = 0; halving < 30 && !(size(next) < size(r)); ++halving) {
        dy /= 2, dz /= 2;
        next = sides(yy + dy, zz + dz);
      }
      if (iteration == most_iterations || !(size(next) < size(r)))
        throw ComputationError("no lateral strains with free sides found at exx = " +
                               format_quantity(strain[0] + increment[0], Dimension::none) +
                               ": lateral stress " + format_quantity(size(r), Dimension::stress) + " after " +
                               std::to_string(iteration) + " iterations; use more Path/Substeps");
      yy += dy, zz += dz, r = next;
    }
    increment[1] = yy, increment[2] = zz;
    advance(increment, dt);
    if (increment[0] != 0) ratio = {yy / increment[0], zz / increment[0]};
  }

private:
  const Material& material;
  std::array<double, 2> ratio{}; ///< lateral over axial increment of the last step: where Newton starts
};

} // namespace spall
