#pragma once

#include "macro/output/body_answer.h"
#include "shared/summary.h"

#include <string>
#include <utility>
#include <vector>

namespace spall {

/// What a body has received: `BODY`.
class MomentumAnswer : public BodyAnswer {
public:
  static constexpr const char* name = "Momentum";
  static constexpr const char* help =
      "bodies of which is asked what they have received, separated by commas: momentum "
      "along z and from whom, energy, deflection";

  MomentumAnswer(const std::vector<std::string>& bodies, const SceneInputs& scene, const FragmentInputs&,
                 const std::string& file);

  /// More may come at any time: it is for Run/Until to say when that is enough.
  bool settled(const Simulation&) const { return true; }
  double part_done(const Simulation&) const { return 1; }
  double shortest_time(const Simulation&) const { return 0; }
  void measure(const Simulation& run, Warnings&);
  void add_to(Summary& summary, const Simulation& run, const std::string& prefix) const;
  std::string in_words() const;

private:
  // As measured, of the whole body, SI.
  double momentum = 0; ///< along z
  double kinetic_energy = 0;
  double energy = 0; ///< kinetic and work of the stresses
  double largest_plastic_strain = 0;
  double largest_deflection = 0;                    ///< of a point, along z
  std::vector<std::pair<std::string, double>> from; ///< momentum along z that other bodies have given
};

} // namespace spall
