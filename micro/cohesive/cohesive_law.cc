#include "micro/cohesive/cohesive_law.h"

#include "micro/cohesive/bilinear_softening.h"
#include "micro/cohesive/exponential_softening.h"
#include "micro/cohesive/linear_softening.h"

#include <algorithm>
#include <stdexcept>

namespace spall {
namespace {

template<class Law> std::unique_ptr<CohesiveLaw> make(double strength, double fracture_energy) {
  return std::make_unique<Law>(strength, fracture_energy);
}

/// The list of all laws: the word in a case file, the enumerator and the class of each.
constexpr struct {
  const char* word;
  Softening softening;
  std::unique_ptr<CohesiveLaw> (*make)(double strength, double fracture_energy);
} laws[] = {{"linear", Softening::linear, make<LinearSoftening>},
            {"bilinear", Softening::bilinear, make<BilinearSoftening>},
            {"exponential", Softening::exponential, make<ExponentialSoftening>}};

} // namespace

double CohesiveLaw::dissipation(double largest) const {
  const double opening = std::min(largest, final_opening());
  return work(opening) - 0.5 * traction(opening) * opening;
}

double CohesiveLaw::dissipation_slope(double largest) const {
  return largest >= final_opening() ? 0 : 0.5 * (traction(largest) - slope(largest) * largest);
}

const std::vector<std::pair<std::string, Softening>>& softening_words() {
  static const auto words = [] {
    std::vector<std::pair<std::string, Softening>> all;
    for (const auto& law : laws) all.emplace_back(law.word, law.softening);
    return all;
  }();
  return words;
}

std::unique_ptr<CohesiveLaw> make_cohesive_law(Softening softening, double strength, double fracture_energy) {
  for (const auto& law : laws)
    if (law.softening == softening) return law.make(strength, fracture_energy);
  throw std::logic_error("no cohesive law belongs to this enumerator of Softening");
}

} // namespace spall
