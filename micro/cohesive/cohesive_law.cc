#include "micro/cohesive/cohesive_law.h"

#include "micro/cohesive/bilinear_softening.h"
#include "micro/cohesive/exponential_softening.h"
#include "micro/cohesive/linear_softening.h"

#include <algorithm>
#include <stdexcept>

namespace spall {

double CohesiveLaw::dissipation(double largest) const {
  const double opening = std::min(largest, final_opening());
  return work(opening) - 0.5 * traction(opening) * opening;
}

double CohesiveLaw::dissipation_slope(double largest) const {
  return largest >= final_opening() ? 0 : 0.5 * (traction(largest) - slope(largest) * largest);
}

const std::vector<std::pair<std::string, Softening>>& softening_words() {
  static const std::vector<std::pair<std::string, Softening>> words = {
      {"linear", Softening::linear},
      {"bilinear", Softening::bilinear},
      {"exponential", Softening::exponential}};
  return words;
}

std::unique_ptr<CohesiveLaw> make_cohesive_law(Softening softening, double strength, double fracture_energy) {
  switch (softening) {
  case Softening::linear:
    return std::make_unique<LinearSoftening>(strength, fracture_energy);
  case Softening::bilinear:
    return std::make_unique<BilinearSoftening>(strength, fracture_energy);
  case Softening::exponential:
    return std::make_unique<ExponentialSoftening>(strength, fracture_energy);
  }
  throw std::logic_error("softening without a law");
}

} // namespace spall
