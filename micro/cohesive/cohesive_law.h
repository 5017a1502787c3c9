#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace spall {

/// Extrinsic cohesive (traction-separation) law in terms of one effective opening (the length of the opening
/// vector): rigid up to the strength, then softening to zero at the final opening. Every law unloads along
/// the secant to the origin, so that half traction times opening is the stored energy (Eq. 26, second term).
class CohesiveLaw {
public:
  virtual ~CohesiveLaw() = default;
  /// Traction at which an intact ligament starts to open, f_t, Pa.
  virtual double strength() const = 0;
  /// Opening at which the traction reaches zero, w_f, m.
  virtual double final_opening() const = 0;
  /// Traction under monotonic opening, Pa; 0 <= opening <= w_f.
  virtual double traction(double opening) const = 0;
  /// Derivative of traction(), Pa/m, <= 0.
  virtual double slope(double opening) const = 0;
  /// Area under traction() from 0 to `opening`, J/m^2; G_f at w_f.
  virtual double work(double opening) const = 0;
  /// Steepest slope of the softening branch, the largest -slope(), Pa/m.
  virtual double steepest_slope() const = 0;

  /// Dissipated energy when the largest opening so far is `largest` (clipped at w_f), J/m^2.
  double dissipation(double largest) const;
  /// Derivative of the dissipated energy with the largest opening, Pa; 0 from w_f on.
  double dissipation_slope(double largest) const;
};

/// Shapes of the softening branch. A new law needs a file with its class, an enumerator here and a line in
/// the list of cohesive_law.cc; the tests of tests/unit/micro/softening_laws.cc then check it too.
enum class Softening { linear, bilinear, exponential };
const std::vector<std::pair<std::string, Softening>>& softening_words();

/// @param strength tensile strength f_t, Pa; @param fracture_energy G_f, N/m
std::unique_ptr<CohesiveLaw> make_cohesive_law(Softening softening, double strength, double fracture_energy);

} // namespace spall
