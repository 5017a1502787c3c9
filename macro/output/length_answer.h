#pragma once

#include "macro/output/body_answer.h"
#include "macro/scene/placement.h"
#include "shared/summary.h"

#include <string>
#include <vector>

namespace spall {

/// Present shape of a bar, by the measures that are taken from recovered bars.
struct BarShape {
  double length = 0;        ///< length, m
  double foot_diameter = 0; ///< largest diameter of the lower end, m
  /// Largest, volume-weighted 95 % quantile, mean.
  double max_plastic_strain = 0, plastic_strain_95 = 0, mean_plastic_strain = 0;
};
/// Measures a bar. All ranks must call it. @param boundary positions of the outermost points: on the surface
/// or half a cell inside
BarShape measure_bar(const Solid& solid, Boundary boundary);

/// The final length of a bar that hits a wall below it: `BODY`.
class LengthAnswer : public BodyAnswer {
public:
  static constexpr const char* name = "Length";
  static constexpr const char* help =
      "bodies whose length after the impact is measured, separated by commas: length over initial length, "
      "diameter of the lower end, plastic strain";

  LengthAnswer(const std::vector<std::string>& bodies, const SceneInputs& scene, const FragmentInputs&,
               const std::string& file);

  /// Returns whether the bar has rebounded, so that its momentum has changed its sign. There it is shortest,
  /// and its length is within 0.1 % for 1 us of 31 (aluminium, 5 rings) or 2 of 77 (copper) on either side,
  /// so that an earlier end would save nothing. Later it springs back, by 0.9 and 0.4 % until it leaves the
  /// wall.
  bool settled(const Simulation& run) const { return momentum_left(run) <= 0; }
  bool complete(const Simulation& run) const { return settled(run); }
  double part_done(const Simulation& run, Until) const { return 1 - momentum_left(run); }
  double shortest_time(const Simulation&, Until) const { return elastic_time; }
  std::optional<NumericalError> numerical_error(const Simulation& run) const;
  void measure(const Simulation& run, Warnings&, bool) {
    shape = measure_bar(*run.bodies.solid(body), boundary);
    error = *numerical_error(run);
  }
  Settlement settlement(const Simulation& run) const;
  void add_to(Summary& summary, const Simulation& run, const std::string& prefix) const;
  std::string in_words() const;

private:
  /// Returns the momentum along z over that at the start.
  double momentum_left(const Simulation& run) const;
  Band ratios() const { return length_band(shape.length / length, error.relative()); }

  double length = 0, velocity = 0; ///< initial length and velocity, m and m/s
  double radius = 0;               ///< m
  std::string unmeasured;          ///< why there is no study of such a bar; empty: there is
  double momentum = 0;             ///< initial momentum of the modelled part along z, N s
  double elastic_time = 0;         ///< time of an elastic wave along the bar and back, s
  Boundary boundary = Boundary::centred;
  BarShape shape;
  NumericalError error; ///< of the shortening
};

} // namespace spall
