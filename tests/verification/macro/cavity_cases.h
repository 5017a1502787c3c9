#pragma once

#include "tests/unit/material/samples.h"
#include "tests/verification/macro/cavity_body.h"

#include <array>
#include <cstdio>
#include <ostream>
#include <string>
#include <vector>

namespace spall::test {

/// Concretes that have one more property each than the one before. None has damage.
enum class Concrete {
  elastic,    ///< without limits of strength, compression and tension
  frictional, ///< with the failure surface of Table 1: strength grows with pressure
  compacting, ///< with the hydrostat of Table 1: crushing
  cracking    ///< with the tension limit of Table 1
};
inline const char* name_of(Concrete concrete) {
  constexpr const char* names[] = {"elastic", "frictional", "compacting", "cracking"};
  return names[static_cast<int>(concrete)];
}
inline Afc make(Concrete concrete) {
  std::vector<std::string> changes;
  if (concrete < Concrete::cracking) changes.push_back("AFC/T_max=1000 GPa");
  if (concrete < Concrete::compacting) // the same bulk modulus, crushing out of reach
    changes.insert(changes.end(), {"AFC/C6=55140 MPa", "AFC/C7=2.5", "AFC/C9=25"});
  if (concrete < Concrete::frictional)
    changes.insert(changes.end(), {"AFC/C1=1000 GPa", "AFC/C5 limits=nothing"});
  Afc law = wes5000(changes);
  law.shear.active = false;
  return law;
}

/// A cavity in concrete: the hole of a projectile of 25 mm radius that starts from half of it.
struct CavityCase {
  Concrete concrete = Concrete::cracking;
  Scheme scheme = Scheme::subpoint;
  int hoops = 1; ///< 1 cylindrical, 2 spherical
  double spacing = 4e-3, radius = 12e-3, opened = 25e-3, velocity = 50;
  int refresh_interval = 5;
  double least_stretch = SupportInputs{}.min_stretch; ///< that supports follow

  Cavity cavity() const {
    Cavity c{.hoops = hoops, .radius = radius, .opened = opened, .velocity = velocity};
    // The wave, at 3710 m/s, does not come back to the gauges.
    c.outer_radius = 0.5 * 3710 * c.end_time() + 0.1;
    // Shells beside each other alternate: gauges are at three of them.
    for (const double middle : {28e-3, 40e-3})
      for (const int side : {-1, 0, 1}) c.gauges.push_back(middle + side * spacing);
    return c;
  }
  ShellGrading grading() const {
    if (hoops == 1) return {.spacing = spacing};
    return {.spacing = spacing, .fine_radius = 48e-3, .widest = 30e-3};
  }
  SolidInputs numerics() const {
    SolidInputs inputs;
    inputs.integration.scheme = scheme;
    inputs.integration.stabilization = 1;
    inputs.approximation.support.min_stretch = least_stretch;
    return inputs;
  }
  CavityBody body() const { return {make(concrete), cavity(), grading(), numerics()}; }
};
inline void PrintTo(const CavityCase& c, std::ostream* out) {
  *out << name_of(c.concrete) << ' ' << name_of(c.scheme) << (c.hoops == 1 ? " cylinder" : " sphere");
}

/// Radial stress at a gauge, averaged over the second half of the time, of three neighbour shells a, b, c.
struct GaugeStress {
  double mean;        ///< (a + 2 b + c) / 4, Pa
  double alternating; ///< (2 b - a - c) / 4, Pa
};
inline GaugeStress stress_at_gauge(const CavityResult& result, std::size_t gauge) {
  const double a = result.gauges.late_mean(3 * gauge), b = result.gauges.late_mean(3 * gauge + 1),
               c = result.gauges.late_mean(3 * gauge + 2);
  return {(a + 2 * b + c) / 4, (2 * b - a - c) / 4};
}

/// Points against the one-dimensional solution, parts of it.
struct CavityDeviation {
  std::array<double, 2> stress{};      ///< of the mean at the gauges
  std::array<double, 2> alternating{}; ///< of neighbour shells from each other, over the mean
  std::array<double, 2> volume{};      ///< of J from the shells' volumes
  std::array<double, 2> noise{};       ///< of the pressure within a shell
  double crushed = 0, flowing = 0;     ///< of the radii of the zones, in spacings there
};

inline CavityDeviation compare(const CavityCase& c, const CavityResult& exact, const CavityBody& body,
                               const CavityResult& points) {
  CavityDeviation d;
  const Cavity cavity = c.cavity();
  for (std::size_t k = 0; k < 2; ++k) {
    const GaugeStress found = stress_at_gauge(points, k), known = stress_at_gauge(exact, k);
    d.stress[k] = found.mean / known.mean - 1;
    d.alternating[k] = (found.alternating - known.alternating) / std::abs(known.mean);
    const std::size_t shell = body.shell_at(cavity.gauges[3 * k + 1]);
    d.volume[k] = body.volume_error(shell);
    d.noise[k] = body.noise(shell);
  }
  const auto zone = [&](std::vector<double> RadialProfile::*field, double threshold) {
    const double known = exact.end.reach(exact.end.*field, threshold);
    return (points.end.reach(points.end.*field, threshold) - known) / body.spacing_at(known);
  };
  d.crushed = zone(&RadialProfile::largest_compression, make(c.concrete).hydrostat.C7);
  d.flowing = zone(&RadialProfile::plastic_strain, 1e-4);
  std::printf(
      "%-8s %-10s %-8s h %.0f mm, %.0f m/s, refresh %d, stretch %.1f: stress %+.1f %+.1f %%, "
      "alternating %+.1f %+.1f %%, J %+.2f %+.2f %%, noise %.1f %.1f %%, crushed %+.2f, flowing %+.2f "
      "spacings\n",
      c.hoops == 1 ? "cylinder" : "sphere", name_of(c.concrete), name_of(c.scheme), 1e3 * c.spacing,
      c.velocity, c.refresh_interval, c.least_stretch, 100 * d.stress[0], 100 * d.stress[1],
      100 * d.alternating[0], 100 * d.alternating[1], 100 * d.volume[0], 100 * d.volume[1], 100 * d.noise[0],
      100 * d.noise[1], d.crushed, d.flowing);
  return d;
}

/// Opens the cavity with both solvers.
inline CavityDeviation deviation(const CavityCase& c) {
  const CavityResult exact = open_in_one_dimension(make(c.concrete), c.cavity());
  CavityBody body = c.body();
  const CavityResult points = body.run(c.refresh_interval);
  return compare(c, exact, body, points);
}

} // namespace spall::test
