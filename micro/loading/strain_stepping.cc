#include "micro/loading/strain_stepping.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace spall {
namespace {

/// Voigt component normal to the crack.
constexpr int pull = 1;

std::string failure_message(const InterfaceProblem& problem, const CurveTrace& trace,
                            const std::string& reason) {
  char text[400];
  std::snprintf(text, sizeof text,
                "cell of %.6g mm stopped at strain %.6g (stress %.4g MPa, damage %.3f): %s. Strain control "
                "cannot follow a response that snaps back, as a large cell's does: the bulk then holds more "
                "energy than the crack can take. Use smaller cells; the curve can be rescaled to a larger "
                "size at equal stress",
                problem.cell_size * 1e3, trace.curve.strain.back(), trace.curve.stress.back() / 1e6,
                trace.curve.damage.back(), reason.c_str());
  return text;
}

} // namespace

CurveTrace trace_curve(const InterfaceProblem& problem, const SteppingSettings& settings,
                       const std::function<bool(const CurveTrace&)>& continue_after) {
  const double strength = problem.law.strength();
  const double unit = strength / (problem.youngs_modulus * problem.cell.uncracked(pull, pull));
  const double failure_strain = problem.law.final_opening() / problem.cell_size;
  const double last = settings.final_strain * std::max(failure_strain, 2 * unit);

  CurveTrace trace;
  trace.curve.cell_size = problem.cell_size;
  CellState state = unloaded_state(problem), before = state;
  const auto record = [&] {
    append_row(trace.curve, problem, state, pull);
    trace.states.push_back(state);
  };
  record();

  double strain = 0, step = settings.growth * unit;
  while (strain < last) {
    // A row exactly at total failure and at the end; no sliver of a step before them.
    double target = strain + step;
    for (const double landmark : {failure_strain, last})
      if (strain < landmark && target > landmark - 0.1 * step) {
        target = landmark;
        break;
      }
    // Openings grow smoothly: extrapolating them halves the iterations.
    const double slope = strain > 0 ? (target - strain) / (strain - before.strain[pull]) : 0;
    const Eigen::VectorXd guess = state.opening + slope * (state.opening - before.opening);
    CellState next = state;
    const NewtonReport report = equilibrate(problem, Voigt::Unit(pull) * target, guess, next);
    trace.newton_iterations += report.iterations;
    std::string reason;
    if (report.outcome != NewtonReport::Outcome::converged) {
      reason = describe(report);
    } else {
      const double change = std::abs(homogenize(problem, next).stress[pull] - trace.curve.stress.back());
      if (change > settings.stress_change * strength) reason = "the stress jumps at the smallest step";
    }
    if (!reason.empty()) {
      ++trace.cut_steps;
      step = 0.5 * (target - strain);
      if (step >= settings.smallest_step * unit) continue;
      trace.failure = failure_message(problem, trace, reason);
      break;
    }
    before = std::move(state);
    state = std::move(next);
    strain = target;
    record();
    step = std::min(2 * step, settings.growth * std::max(unit, strain));
    if (!continue_after(trace)) {
      trace.interrupted = strain < last;
      break;
    }
  }
  // A converged stress is off by a few times the tolerance of the tractions.
  set_strength_damage(trace.curve, 10 * problem.newton.tolerance);
  return trace;
}

} // namespace spall
