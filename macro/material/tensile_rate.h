#pragma once

#include "macro/points/lane_math.h"
#include "shared/input/parameters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spall {

/// How the tensile strength of concrete grows with the strain rate.
enum class TensileRateLaw {
  constant,        ///< not at all: one factor
  malvar_crawford, ///< Malvar and Crawford (1998): fit of the tests collected by Malvar and Ross (1998)
  ceb_1990,        ///< CEB-FIP Model Code 1990
  fib_2010         ///< fib Model Code 2010
};

/// Dynamic over static tensile strength. All laws are a slow power of the rate (slow, static) up to a bend
/// and its cube root beyond. Beyond the range of the tests they are held at its end: the strain rates of
/// detached points are not limited by that range.
struct TensileRate {
  TensileRateLaw law = TensileRateLaw::malvar_crawford;
  double constant = 1;                  ///< factor of the constant law
  double compressive_strength = 38.2e6; ///< static, Pa: for the laws before 2010
  /// Factor at which all laws but the constant one are held. 4.07: the largest one measured together with the
  /// fracture energy, in a spall bar at 37 1/s (Schuler, Mayrhofer and Thoma 2006). Collected tests at higher
  /// rates have larger ones, part of which is inertia of the specimen (Ozbolt et al. 2014).
  double largest = 4.07;
  /// Exponent of the factor of the fracture energy. 0.24: in a spall bar at 37 1/s the strength is 4.07 times
  /// the static one and the fracture energy 1.40 times (Schuler, Mayrhofer and Thoma 2006). 1: openings do
  /// not depend on the rate; 0: the energy does not.
  double energy_exponent = 0.24;

  bool is_constant() const { return law == TensileRateLaw::constant; }

  /// The factor at a strain rate in 1/s, of one point or of several (lane_math.h).
  template<Numbers V> V operator()(const V& rate) const {
    return is_constant() ? broadcast<V>(constant) : smaller(largest, of_tests(rate));
  }
  double operator()(double rate) const { return operator()<double>(rate); }

  /// Strain of the static test at the same damage. With the strength R times and the fracture energy R^n
  /// times the static one, a strain is R times the elastic one of the static test, threshold (1 - d), and
  /// R^(n - 1) times that of its opening crack, over the width that the crack has to itself. @param factor R
  /// @param damage d of the strength, of the step before  @param width over that of the static test
  double static_strain(double strain, double threshold, double factor, double damage, double width) const {
    const double elastic = threshold * (1 - damage);
    return elastic + width * std::pow(factor, 1 - energy_exponent) * (strain - factor * elastic);
  }

  void declare(Parameters::Section& section);
  /// Without the compressive strength: for laws that state it themselves.
  void declare_law(Parameters::Section& section);

private:
  template<class V> V of_tests(const V& rate) const {
    const double f = compressive_strength / 10e6;
    switch (law) {
    case TensileRateLaw::malvar_crawford: {
      const double delta = 1 / (1 + 8 * f);
      return bent(rate, {1e-6, delta, 6 * delta - 2, 1, 160});
    }
    case TensileRateLaw::ceb_1990: {
      const double delta = 1 / (10 + 6 * f);
      return bent(rate, {3e-6, 1.016 * delta, 7.11 * delta - 2.33, 30, 300});
    }
    case TensileRateLaw::fib_2010:
      return bent(rate, {1e-6, 0.018, std::log10(0.0062), 10, 300});
    case TensileRateLaw::constant:
      break;
    }
    return broadcast<V>(constant);
  }
  struct Shape {
    double at_rest, power; ///< static rate, 1/s, and exponent below the bend
    double beyond;         ///< decimal logarithm of the factor of the cube root
    double bend, last;     ///< 1/s
  };
  template<class V> static V bent(const V& rate, const Shape& s) {
    const V logarithm = natural_logarithm(V(smaller(s.last, larger(s.at_rest, rate)) / s.at_rest));
    return exponential_function(
        select(rate <= s.bend, V(s.power * logarithm), V(s.beyond * std::numbers::ln10 + logarithm / 3)));
  }
};

} // namespace spall
