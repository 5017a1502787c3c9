#include "macro/setup/run_inputs.h"

#include "shared/error.h"

namespace spall {

void RunInputs::declare(Parameters& parameters) {
  auto approximation = parameters.section("Approximation");
  approximation.choice(
      "Basis order", solid.approximation.order, {{"0", 0}, {"1", 1}, {"2", 2}},
      "of the monomials that are reproduced; 2 wants a support of 3 spacings, falls back to 1 "
      "where the points do not hold it, and NSNI needs 1 or 2");
  approximation.choice("Kernel", solid.approximation.profile, profile_names,
                       "cubic B-spline, or the smoother and more peaked C4 function of Wendland");
  approximation.choice("Support shape", solid.approximation.support.shape, support_shape_names,
                       "ellipsoid and box follow the deformation, a sphere keeps its radius and loses "
                       "neighbours where the body stretches");
  approximation.choice("Configuration", solid.approximation.configuration, configuration_names,
                       "of the shape functions: present (neighbours change), or initial for bodies that stay "
                       "whole");
  approximation.number(
      "Support size", solid.approximation.support.normalized_size, {1.2, 4},
      "radius of the kernel support in spacings; below 1.5 deformed clouds lose their neighbours");
  approximation.number("Smallest stretch", solid.approximation.support.min_stretch, {0.05, 1},
                       "principal stretches the support follows: lower clip");
  approximation.number("Largest stretch", solid.approximation.support.max_stretch, {1, 100}, "upper clip");
  approximation.flag("Double precision", solid.double_precision,
                     "shape functions and sums over neighbours in double instead of single precision");

  auto integration = parameters.section("Integration");
  integration.choice("Scheme", solid.integration.scheme, scheme_names,
                     "nodal integration; NSNI, M-SNNI and M-SCNI are stabilised, DNI, SNNI and SCNI are not; "
                     "SCNI and M-SCNI need Configuration = Lagrangian");
  integration.number("Stabilization", solid.integration.stabilization, {0, 1},
                     "weight of the strain's variation over the cell: NSNI, and alpha of M-SNNI and M-SCNI");
  integration.choice("Subcells", solid.integration.subcells, {{"4", 4}, {"6", 6}, {"8", 8}},
                     "sample points of the cell: K of M-SNNI and M-SCNI, or the points of SUBPOINT");
  integration.choice(
      "Variational correction", solid.integration.correction, correction_names,
      "linear: smallest change of the gradients at every refresh that makes non-conforming "
      "schemes pass the linear patch test; costs some hundred sums over neighbours per refresh");
  integration.integer("Refresh interval", solid.integration.refresh_interval, {1, 1000},
                      "most steps between rebuilding neighbours and shape functions");
  integration.number("Refresh deformation", solid.integration.refresh_deformation, {1e-3, 10},
                     "rebuild earlier when the deformation since the last time exceeds this");
  integration.number(
      "Least deformation", solid.integration.least_deformation, {0, 1},
      "regions that have deformed less since their last refresh are left out of the next; 0: none");
  integration.integer("Most skipped", solid.integration.most_skipped, {0, 100000},
                      "refreshes that a region may be left out of, one after the other");

  auto t = parameters.section("Time");
  t.quantity("End time", time.end_time, Dimension::time, {above_zero, 1e3},
             "of the simulation, if nothing ends it before");
  t.number("Step factor", time.step_factor, {1e-3, 1},
           "time step in units of the smallest h / c; h: extent of the deformed nodal cell");
  t.integer(
      "Verify step every", time.verify_every, {0, 1000000},
      "steps between estimates of the largest stable step, which shorten one that is too long, and looks "
      "for alternating fields; 0: never");
  t.number("Newmark beta", time.beta, {0, 1}, "only 0, the explicit scheme; others need an implicit solve");
  t.number("Newmark gamma", time.gamma, {0, 1},
           "1/2: central differences, no damping; more damps high frequencies, less is unstable");

  auto output = parameters.section("Output");
  output.quantity("Frame interval", frame_interval, Dimension::time, {above_zero, 1e3},
                  "simulated time between fields");
  output.quantity("History interval", history_interval, Dimension::time, {above_zero, 1e3},
                  "simulated time between lines of history.csv");
  fragments.declare(parameters);
  answers.declare(parameters);

  auto run = parameters.section("Run");
  run.integer("Threads", threads, {0, 1024}, "0: all cores");
  run.quantity("Checkpoint interval", checkpoint_interval, Dimension::time, {0, 1e9},
               "wall time between checkpoints for --restart, of about 2 kB per point; 0: only when the run "
               "ends or is interrupted (SIGINT, SIGTERM)");
  run.number(
      "Rebalance tolerance", balance.tolerance, {0, 100},
      "with several ranks: points are shared out anew when the time of a rank in the point loops exceeds "
      "the mean by more than this part of it; 0: never");
  run.integer("Rebalance interval", balance.interval, {1, 1000000}, "steps between looks at that");
  run.number("Energy tolerance", energy_tolerance, {1e-6, 1e6},
             "the run stops when the relative energy error exceeds this");
}

void RunInputs::validate(const std::string& file) const {
  const ApproximationInputs& approximation = solid.approximation;
  if (approximation.order == 0 && solid.integration.scheme == Scheme::nsni)
    throw InputError(file +
                     ": key 'Approximation/Basis order': 0 has no derivatives for Integration/Scheme = "
                     "NSNI; choose 1 or 2");
  if (is_conforming(solid.integration.scheme) && approximation.configuration != Configuration::lagrangian)
    throw InputError(file + ": key 'Integration/Scheme': " + name_of(solid.integration.scheme) +
                     " keeps the initial cells; it needs Approximation/Configuration = Lagrangian");
  const auto number = [](double value) { return format_quantity(value, Dimension::none); };
  if (time.beta != 0)
    throw InputError(file + ": key 'Time/Newmark beta': found " + number(time.beta) +
                     ", allowed: 0 (the step is explicit; others need an implicit solve)");
  if (time.gamma < 0.5)
    throw InputError(file + ": key 'Time/Newmark gamma': found " + number(time.gamma) +
                     ", allowed: 0.5 to 1 (below 0.5 every vibration grows)");
}

} // namespace spall
