#pragma once

#include "macro/output/body_answer.h"
#include "macro/scene/placement.h"
#include "shared/summary.h"

#include <string>
#include <vector>

namespace spall {

/// Shape of a bar now: what is measured on a recovered bar.
struct BarShape {
  double length = 0;        ///< m
  double foot_diameter = 0; ///< largest diameter of the lower end, m
  double max_plastic_strain = 0, plastic_strain_95 = 0,
         mean_plastic_strain = 0; ///< largest, volume-weighted 95 % quantile, mean
};
/// All ranks must call it. @param boundary of the points that fill the bar
BarShape measure_bar(const Solid& solid, Boundary boundary);

/// How a bar that is shot at a wall below it is shortened: `BODY`.
class LengthAnswer : public BodyAnswer {
public:
  static constexpr const char* name = "Length";
  static constexpr const char* help =
      "bodies whose length after the impact is asked, separated by commas: length over "
      "initial length, diameter of the lower end, plastic strain";

  LengthAnswer(const std::vector<std::string>& bodies, const SceneInputs& scene, const FragmentInputs&,
               const std::string& file);

  /// The bar rebounds: its momentum is turned round.
  bool settled(const Simulation& run) const { return momentum_left(run) <= 0; }
  double part_done(const Simulation& run) const { return 1 - momentum_left(run); }
  double shortest_time(const Simulation&) const { return elastic_time; }
  void measure(const Simulation& run, Warnings&) { shape = measure_bar(*run.bodies.solid(body), boundary); }
  void add_to(Summary& summary, const Simulation& run, const std::string& prefix) const;
  std::string in_words() const;

private:
  /// Momentum along z over that at the start.
  double momentum_left(const Simulation& run) const;

  double length = 0, velocity = 0; ///< at the start, m, m/s
  double momentum = 0;             ///< of the modelled part along z at the start, N s
  double elastic_time = 0;         ///< of a wave forth and back, s
  Boundary boundary = Boundary::centred;
  BarShape shape;
};

} // namespace spall
