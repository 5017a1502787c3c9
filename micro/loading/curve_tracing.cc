#include "micro/loading/curve_tracing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace spall {
namespace {

/// Number of stable rows with growing strain under damage control before strain control is tried again.
constexpr int rows_before_return = 3;
/// Largest number of iterations of a step after which the next step is larger.
constexpr int easy_iterations = 6;

/// The state of one curve's computation; trace_curve() runs it.
template<int dim> class Tracer {
public:
  Tracer(const InterfaceProblem<dim>& problem_, const SteppingSettings& settings_,
         const std::function<bool(const DamageCurve&)>& continue_after_)
      : problem(problem_), settings(settings_), continue_after(continue_after_),
        strength(problem_.law.strength()),
        unit(
            strength * problem_.direction.norm() /
            (problem_.youngs_modulus * problem_.direction.dot(problem_.cell.uncracked * problem_.direction))),
        state(unloaded_state(problem_)), before(state) {
    double ligament = 0;
    for (std::size_t i = 0; i < problem.cell.nodes.size(); ++i)
      if (!problem.cell.nodes[i].initially_open)
        ligament +=
            problem.cell.nodes[i].weight * problem.law_at(i).dissipation(problem.law_at(i).final_opening());
    total = ligament / problem.cell_size;
    damage_step = settings.damage_step * total;
    trace.curve.cell_size = problem.cell_size;
  }

  CurveTrace<dim> run() {
    record(state, {.stability = settings.every_eigenvalue ? stability(problem, state) : Stability{}});
    const double failure = problem.law.final_opening() / problem.cell_size;
    const double last = settings.final_strain * std::max(failure, 2 * unit);
    step = settings.growth * unit;
    std::vector<double> goals = settings.turning_strains;
    goals.push_back(last);
    last_goal = last;
    for (const double goal : goals)
      if (!reach(goal, failure)) break;
    close_snap_back();
    // A converged stress is off by a few times the tolerance of the tractions.
    set_strength_damage(trace.curve, 10 * problem.newton.tolerance);
    const EnergyChecks checks = check_energies(trace.curve);
    trace.curve.psi_stress_error = checks.stress;
    trace.curve.psi_work_error = checks.work;
    return std::move(trace);
  }

private:
  /// Loads the cell up to one of the turning strains or the final one. @return false to end the computation
  bool reach(double goal, double failure) {
    const double sign = goal > strain() ? 1 : -1;
    const double tolerance = 1e-12 * std::abs(goal);
    while (sign * (goal - strain()) > tolerance) {
      if (static_cast<int>(trace.states.size()) >= settings.most_rows)
        return fail("the largest number of rows is reached");
      const bool done = control == Control::strain ? step_by_strain(goal, failure, sign) : step_by_damage();
      if (!trace.failure.empty()) return false;
      if (done && !continue_after(trace.curve)) {
        trace.interrupted = !(goal == last_goal && sign * (goal - strain()) <= tolerance);
        return false;
      }
    }
    return true;
  }

  /// Attempts a step under strain control. @return true if it added a row
  bool step_by_strain(double goal, double failure, double sign) {
    // There is a row exactly at total failure and at the goal; a tiny step before them is avoided.
    double target = strain() + sign * step;
    for (const double landmark : {failure, goal})
      if (sign * (landmark - strain()) > 0 && sign * (target - landmark) > -0.1 * step) {
        target = landmark;
        break;
      }
    // Openings grow smoothly, so extrapolating them halves the number of iterations.
    const double last_step = strain() - strain_of(before);
    const double slope =
        trace.states.size() > 1 && last_step * sign > 0 ? (target - strain()) / last_step : 0;
    const Eigen::VectorXd guess = state.opening + slope * (state.opening - before.opening);
    CellState<dim> next = state;
    NewtonReport report = equilibrate<dim>(problem, target * problem.direction, guess, next);
    trace.newton_iterations += report.iterations;
    std::string reason = refusal(report, next);
    if (!reason.empty()) {
      ++trace.cut_steps;
      step = 0.5 * std::abs(target - strain());
      if (step >= settings.smallest_step * unit) return false;
      if (sign < 0) return fail(reason);
      if (report.outcome == NewtonReport::Outcome::unstable && leave_branch(target, next)) {
        if (!trace.failure.empty()) return false;
        reason.clear();
      } else {
        if (settings.snap_back == AtInstability::refuse)
          return fail(
              reason +
              ". The response snaps back: the bulk releases more energy than the crack can dissipate. "
              "Set Loading/Snap-back to follow, or use smaller cells");
        if (damage_failed_here) return fail(reason + "; damage control finds no next state either");
        control = Control::damage;
        rows_forward = 0;
        blocked = reason;
        failed_target = target;
        return false;
      }
    }
    damage_failed_here = false;
    Stability found = settings.every_eigenvalue ? stability(problem, next) : Stability{};
    take(std::move(next), Control::strain, report.iterations, std::move(found));
    step = std::min(2 * step, settings.growth * std::max(unit, std::abs(strain())));
    return true;
  }

  /// Attempts a step under damage control. @return true if it added a row
  bool step_by_damage() {
    const double now = damage_measure(problem, state), grown = now - damage_measure(problem, before);
    const double share = grown > 0 ? damage_step / grown : 0;
    CellState<dim> guess = state;
    guess.opening += share * (state.opening - before.opening);
    guess.strain += share * (state.strain - before.strain);
    // Before any damage the openings cannot be extrapolated; the guess is the strain at which strain control
    // failed.
    if (share == 0) guess.strain = failed_target * problem.direction;
    CellState<dim> next = state;
    const NewtonReport report = equilibrate_damage(problem, now + damage_step, guess, next);
    trace.newton_iterations += report.iterations;
    std::string reason = refusal(report, next);
    if (reason.empty() && std::abs(strain_of(next) - strain()) > largest_move()) reason = "the strain jumps";
    if (!reason.empty()) {
      ++trace.cut_steps;
      damage_step *= 0.5;
      if (damage_step >= settings.smallest_damage_step * total) return false;
      // Damage cannot grow from this state unless the strain grows first.
      control = Control::strain;
      step = settings.growth * unit;
      damage_step = settings.damage_step * total;
      if (damage_failed_here)
        return fail(blocked + "; damage control finds no next state either (" + reason + ")");
      damage_failed_here = true;
      return false;
    }
    damage_failed_here = false;
    Stability found = stability(problem, next);
    if (found.negative > 1 && !change_branch(next, found)) return false;
    const double moved = strain_of(next) - strain();
    take(std::move(next), Control::damage, report.iterations, std::move(found));
    if (report.iterations <= easy_iterations) damage_step *= 1.5;
    rows_forward = moved > 0 && trace.reports.back().stability.negative == 0 ? rows_forward + 1 : 0;
    if (rows_forward >= rows_before_return) {
      control = Control::strain;
      step = std::min(moved, settings.growth * std::max(unit, strain()));
    }
    return true;
  }

  /// Searches for a stable state at `target` beside the unstable one, along the lowest eigenvector of the
  /// last stable state. @return true if there is one, in `next`; sets a failure if branches must not be
  /// followed
  bool leave_branch(double target, CellState<dim>& next) {
    const Stability stable = stability(problem, state);
    const double size = size_of_push();
    for (double push = 1e-4; push < 2 && stable.modes.size() > 0; push *= 10)
      for (const double side : {1.0, -1.0}) {
        next = state;
        const NewtonReport report =
            equilibrate<dim>(problem, target * problem.direction,
                             state.opening + side * push * size * stable.modes.col(0), next);
        trace.newton_iterations += report.iterations;
        if (!refusal(report, next).empty()) continue;
        if (settings.bifurcation == AtInstability::refuse) {
          fail("the equilibrium path branches and the symmetric branch is unstable. Set Loading/Bifurcation "
               "to follow to continue on the stable branch, or set Cracks/Imperfection");
          return true;
        }
        trace.events.push_back({CurveEvent::Kind::bifurcation, strain(), target});
        return true;
      }
    return false;
  }

  /// Under damage control, at a state `next` whose stability `found` has two or more negative eigenvalues:
  /// searches for a state of the same damage with fewer of them. If there is one, it replaces `next` and
  /// `found`; if not, they are kept and an event records that a branch was passed. @return false, with a
  /// failure set, if branches must not be followed
  bool change_branch(CellState<dim>& next, Stability& found) {
    const double measure = damage_measure(problem, next);
    for (Eigen::Index k = 0; k < found.modes.cols(); ++k)
      for (double push = 1e-3; push < 2; push *= 10)
        for (const double side : {1.0, -1.0}) {
          CellState<dim> guess = next, other = state;
          guess.opening += side * push * size_of_push() * found.modes.col(k);
          const NewtonReport report = equilibrate_damage(problem, measure, guess, other);
          trace.newton_iterations += report.iterations;
          if (!refusal(report, other).empty() || std::abs(strain_of(other) - strain()) > largest_move())
            continue;
          Stability there = stability(problem, other);
          if (there.negative >= found.negative) continue;
          if (settings.bifurcation == AtInstability::refuse)
            return fail("while the strain decreases the equilibrium path branches, and the symmetric branch "
                        "is the unstable one. Set Loading/Bifurcation to follow to continue on the other");
          trace.events.push_back({CurveEvent::Kind::bifurcation, strain(), strain_of(other)});
          next = std::move(other);
          found = std::move(there);
          return true;
        }
    if (settings.bifurcation == AtInstability::refuse)
      return fail(
          "while the strain decreases the equilibrium path branches. Set Loading/Bifurcation to follow");
    if (trace.reports.back().stability.negative < 2)
      trace.events.push_back({CurveEvent::Kind::branch_passed, strain(), strain_of(next)});
    for (auto event = trace.events.rbegin(); event != trace.events.rend(); ++event)
      if (event->kind == CurveEvent::Kind::branch_passed) {
        event->to = strain_of(next);
        break;
      }
    return true;
  }

  /// Returns the size of opening that perturbations are relative to in the search for a branch, m.
  double size_of_push() const {
    return std::max(state.opening.cwiseAbs().maxCoeff(),
                    strength / problem.youngs_modulus * problem.cell_size);
  }

  std::string refusal(const NewtonReport& report, const CellState<dim>& next) const {
    if (report.outcome != NewtonReport::Outcome::converged) return describe(report);
    const double stress = homogenize(problem, next).stress.dot(problem.direction) / problem.direction.norm();
    const double last = trace.curve.stress.back() / problem.direction.norm();
    return std::abs(stress - last) > settings.stress_change * strength
               ? "the stress jumps at the smallest step"
               : "";
  }

  void take(CellState<dim>&& next, Control how, int iterations, Stability&& found) {
    before = std::move(state);
    state = std::move(next);
    const RowReport report{.control = how, .iterations = iterations, .stability = std::move(found)};
    if (how == Control::damage && strain() < strain_of(before)) {
      if (!snapping) {
        trace.events.push_back({CurveEvent::Kind::snap_back, strain_of(before), strain()});
        snap_back = trace.events.size() - 1;
      }
      snapping = true;
      trace.events[snap_back].to = strain();
    } else {
      close_snap_back();
    }
    record(state, report);
  }
  void close_snap_back() { snapping = false; }

  void record(const CellState<dim>& row, RowReport report) {
    append_row(trace.curve, problem, row);
    trace.states.push_back(row);
    report.stability.modes.resize(0, 0);
    trace.reports.push_back(std::move(report));
  }

  bool fail(const std::string& reason) {
    char text[200];
    std::snprintf(
        text, sizeof text,
        "cell of %.6g mm stopped at strain %.6g (stress %.4g MPa, damage %.3f): ", problem.cell_size * 1e3,
        trace.curve.strain.back(), trace.curve.stress.back() / 1e6, trace.curve.damage.back());
    trace.failure = text + reason;
    return false;
  }

  double strain_of(const CellState<dim>& s) const {
    return s.strain.dot(problem.direction) / problem.direction.squaredNorm();
  }
  double strain() const { return strain_of(state); }
  /// Returns the largest change of strain in a step of damage control; a larger one is a jump to another
  /// branch.
  double largest_move() const { return settings.growth * std::max(unit, std::abs(strain())); }

  const InterfaceProblem<dim>& problem;
  const SteppingSettings& settings;
  const std::function<bool(const DamageCurve&)>& continue_after;
  const double strength, unit; ///< strength f_t, Pa, and the strain f_t / M
  double total = 0;            ///< damage_measure() at total failure, J/m^3
  CellState<dim> state, before;
  CurveTrace<dim> trace;
  Control control = Control::strain;
  double step = 0, damage_step = 0, failed_target = 0, last_goal = 0;
  int rows_forward = 0;
  bool damage_failed_here = false, snapping = false;
  std::size_t snap_back = 0; ///< index of the snap-back's event while `snapping`
  std::string blocked;       ///< reason why strain control failed
};

} // namespace

template<int dim>
CurveTrace<dim> trace_curve(const InterfaceProblem<dim>& problem, const SteppingSettings& settings,
                            const std::function<bool(const DamageCurve&)>& continue_after) {
  return Tracer<dim>(problem, settings, continue_after).run();
}

template CurveTrace<2> trace_curve(const InterfaceProblem<2>&, const SteppingSettings&,
                                   const std::function<bool(const DamageCurve&)>&);
template CurveTrace<3> trace_curve(const InterfaceProblem<3>&, const SteppingSettings&,
                                   const std::function<bool(const DamageCurve&)>&);

} // namespace spall
