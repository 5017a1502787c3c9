#pragma once

#include "macro/dynamics/simulation.h"
#include "shared/summary.h"

#include <limits>
#include <string>

namespace spall {

/// What the numerical error of an answer depends on.
struct Numerics {
  Scheme scheme = Scheme::nsni;
  double weight = 0; ///< of the stabilisation
  bool axis = false; ///< rotational symmetry
  double across = 0; ///< points over the radius of the projectile or bar: radius / smallest spacing
  TouchingPart touching = TouchingPart::cell; ///< of the target, with a rigid projectile
};
/// Returns the numerics of a body. All ranks must call it. @param radius of the projectile or bar, m
Numerics numerics_of(const Simulation& run, const Solid& solid, double radius);

/// The error that an answer has by numerics alone, as measured in studies (data/studies/README.md) and scaled
/// to the resolution of the scene. It holds neither the error of the material's law and constants nor that of
/// an experiment. NaN: not measured.
struct NumericalError {
  const char* quantity = "resistance"; ///< the quantity whose relative error it is
  /// Relative error of the spacing of the points, and relative standard deviation over layouts of the points.
  double spacing = std::numeric_limits<double>::quiet_NaN(), layout = spacing;
  double across = 0;       ///< points over the radius
  std::string remark = {}; ///< where the resolution is outside the measured range, or what is not measured

  bool known() const;
  /// sqrt(spacing^2 + (2 layout)^2)
  double relative() const;
  /// For example "8.5 % of the resistance (spacing 3.0 %, ...)". @param body that has the radius
  std::string in_words(const std::string& body) const;
  /// `numerical_error_percent`, its parts and the remark.
  void add_to(Summary& summary, const std::string& prefix) const;
};

/// Returns the error of the resistance of a target that softens: absorbed energy over path. Between measured
/// resolutions the parts are linear in 1 / across. Beyond the coarsest one they grow like 1 / across; beyond
/// the finest one they stay. The scatter of layouts averages out along the path.
/// @param path of the projectile in the target, 0 if not known yet (it may be deep)  @param thickness of the
/// target; both in radii of the projectile. Deep in targets thicker than the 254 mm slab it is that of
/// tunnels, the largest one from 277 to 642 m/s
NumericalError error_of_resistance(const Numerics& numerics, double path, double thickness = 0);
/// Returns the error of the shortening 1 - L / L0 of a metal bar on a rigid wall.
NumericalError error_of_shortening(const Numerics& numerics);
/// @param quantity that is not known, @param why as the end of "not measured for"
NumericalError not_measured(const char* quantity, const std::string& why);

/// The range of an answer that its numerical error leaves open. NaN: not known. A relative error of NaN gives
/// such a band.
struct Band {
  double low = std::numeric_limits<double>::quiet_NaN(), high = low;

  bool known() const { return low <= high; }
  /// For example " (numerically 211.2 to 227.4)"; empty if it is not known. @param scale of the numbers
  std::string in_words(int digits, double scale = 1) const;
  /// `NAME_low` and `NAME_high`.
  void add_to(Summary& summary, const std::string& name) const;
};

/// Exit velocities of a body that has perforated its target, m/s: sqrt(v0^2 - (v0^2 - v^2)(1 +- error)), 0 if
/// it may stop. @param in v0, @param out v, m/s; @param error relative error of the resistance
Band exit_band(double in, double out, double error);
/// Exit velocities of a body that was stopped at a depth, m/s: 0 to v0 sqrt(1 - (1 - error) thickness /
/// depth), which is above 0 if its depth may reach the back. Lengths in m.
Band exit_band_of_stopped(double in, double depth, double thickness, double error);
/// Depths of penetration, m: depth / (1 +- error), at most the thickness.
Band depth_band(double depth, double thickness, double error);
/// Ratios L / L0 of a bar: 1 - (1 - ratio)(1 +- error). @param error relative error of the shortening
Band length_band(double ratio, double error);

} // namespace spall
