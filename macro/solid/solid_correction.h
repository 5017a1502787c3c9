#pragma once

#include "macro/solid/linear_correction.h"
#include "macro/solid/solid_of.h"

#include <sstream>

namespace spall {

template<class Material, class T, class Stress>
SolverReport SolidOf<Material, T, Stress>::correct_gradients() {
  const VectorField velocity = points.velocity, force = points.force;
  std::vector<GradientOperators<T>*> operators;
  for (Block& block : blocks) operators.push_back(&block.operators);
  const OperatorLayout layout = layout_of(inputs.integration);
  LinearCorrection<T> correction(std::move(operators), stencils, reduction, points, ghosts,
                                 layout.use == OperatorUse::subpoints ? layout.count : 1);
  std::vector<double> residual;
  const SolverReport report = correction.apply(residual);
  points.velocity = velocity;
  points.force = force;
  if (!report.converged) throw ComputationError(why_not_corrected(report, residual));
  return report;
}

template<class Material, class T, class Stress>
std::string SolidOf<Material, T, Stress>::why_not_corrected(const SolverReport& report,
                                                            const std::vector<double>& residual) const {
  // The place is that of the largest residual; without numbers, the first point.
  std::size_t place = 0;
  double largest = -1;
  for (std::size_t k = 0; k < residual.size(); ++k)
    if (std::abs(residual[k]) > largest) largest = std::abs(residual[k]), place = k / 3;
  const Ranks& ranks = ghosts.processes();
  std::vector<std::string> places;
  if (const double of_all = ranks.max(largest); largest == of_all && points.owned > 0)
    places.push_back(describe(place));
  places = ranks.gather(places);
  std::ostringstream text;
  text << "the linear correction of the gradients of " << label << " has not converged: after "
       << report.iterations << " iterations the residual is " << report.residual
       << " of the first, largest at " << (places.empty() ? "no point" : places.front())
       << "; the points there are too irregular, or the body is too long: choose Integration/Variational "
          "correction = none";
  return text.str();
}

} // namespace spall
