#pragma once

#include "macro/output/body_answer.h"
#include "shared/summary.h"

#include <string>
#include <utility>
#include <vector>

namespace spall {

/// Momentum and energy that a body has received: `BODY`.
class MomentumAnswer : public BodyAnswer {
public:
  static constexpr const char* name = "Momentum";
  static constexpr const char* help = "bodies whose received momentum is measured, separated by commas: "
                                      "momentum along z in all and from each other body, energy, deflection";

  MomentumAnswer(const std::vector<std::string>& bodies, const SceneInputs& scene, const FragmentInputs&,
                 const std::string& file);

  /// Always true, so that other answers or the key Run/Until determine the end: the body may receive more at
  /// any time.
  bool settled(const Simulation&) const { return true; }
  bool complete(const Simulation&) const { return true; }
  double part_done(const Simulation&, Until) const { return 1; }
  double shortest_time(const Simulation&, Until) const { return 0; }
  void measure(const Simulation& run, Warnings&, bool);
  Settlement settlement(const Simulation&) const { return {"", "momentum, energy, deflection"}; }
  void add_to(Summary& summary, const Simulation& run, const std::string& prefix) const;
  std::string in_words() const;

private:
  // The measured values of the whole body, SI.
  double momentum = 0; ///< momentum along z
  double kinetic_energy = 0;
  double energy = 0; ///< kinetic energy and work of the stresses
  double largest_plastic_strain = 0;
  double largest_deflection = 0;                    ///< largest deflection of a point along z
  std::vector<std::pair<std::string, double>> from; ///< momentum along z that other bodies have given
};

} // namespace spall
