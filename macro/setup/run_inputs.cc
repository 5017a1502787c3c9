#include "macro/setup/run_inputs.h"

#include "shared/error.h"

#include <tuple>

namespace spall {

namespace {

/// Frames, and rows of history.csv, up to the end time at most: a disk would be full of more.
constexpr double most_frames = 1e5, most_rows = 1e8;

/// Declares the section Approximation.
void declare_approximation(Parameters& parameters, SolidInputs& solid) {
  auto approximation = parameters.section("Approximation");
  approximation.choice("Basis order", solid.approximation.order, {{"0", 0}, {"1", 1}, {"2", 2}},
                       "order of the monomials that are reproduced; 2 needs a support of 3 spacings and "
                       "falls back to 1 where there are too few points, and NSNI needs 1 or 2");
  approximation.choice(
      "Kernel", solid.approximation.profile, profile_names,
      "kernel function: cubic B-spline, or the smoother and more peaked C4 function of Wendland");
  approximation.choice("Support shape", solid.approximation.support.shape, support_shape_names,
                       "shape of the kernel support: ellipsoid and box follow the deformation, a sphere "
                       "keeps its radius and loses neighbours where the body stretches");
  approximation.choice(
      "Configuration", solid.approximation.configuration, configuration_names,
      "configuration of the shape functions: present (neighbours change), or initial for bodies that stay "
      "whole");
  approximation.number(
      "Support size", solid.approximation.support.normalized_size, {1.2, 4},
      "radius of the kernel support in spacings; below 1.5 deformed clouds lose their neighbours");
  approximation.number(
      "Smallest stretch", solid.approximation.support.min_stretch, {0.05, 1},
      "smallest principal stretch that the support follows: cells that are flatter lose their "
      "confinement, and the time step falls with it");
  approximation.number("Largest stretch", solid.approximation.support.max_stretch, {1, 100},
                       "largest principal stretch that the support follows");
  approximation.flag(
      "Double precision", solid.double_precision,
      "computes shape functions and sums over neighbours in double instead of single precision");
}

/// Declares the section Integration.
void declare_integration(Parameters& parameters, SolidInputs& solid, bool& accept_unverified) {
  auto integration = parameters.section("Integration");
  integration.choice(
      "Scheme", solid.integration.scheme, scheme_names,
      "nodal integration scheme; NSNI, M-SNNI and M-SCNI are stabilised, DNI, SNNI and SCNI are not; "
      "SCNI and M-SCNI need Configuration = Lagrangian");
  integration.number(
      "Stabilization", solid.integration.stabilization, {0, 1},
      "stabilisation weight of the strain's variation over the cell in NSNI, and alpha of M-SNNI and M-SCNI");
  integration.choice(
      "Subcells", solid.integration.subcells, {{"4", 4}, {"6", 6}, {"8", 8}},
      "number of sample points of the cell: K of M-SNNI and M-SCNI, or the points of SUBPOINT");
  integration.choice(
      "Variational correction", solid.integration.correction, correction_names,
      "linear: changes the gradients at every refresh as little as possible so that non-conforming schemes "
      "pass the linear patch test; costs some hundred sums over neighbours per refresh");
  integration.integer("Refresh interval", solid.integration.refresh_interval, {1, 1000},
                      "largest number of steps between rebuilding neighbours and shape functions; with "
                      "subcycling at the end of its cycle");
  integration.number("Refresh deformation", solid.integration.refresh_deformation, {1e-3, 10},
                     "deformation since the last refresh above which neighbours are rebuilt earlier");
  integration.number(
      "Least deformation", solid.integration.least_deformation, {0, 1},
      "deformation since a region's last refresh below which the next refresh skips it; 0: none is skipped");
  integration.integer("Most skipped", solid.integration.most_skipped, {0, 100000},
                      "largest number of consecutive refreshes that may skip a region");
  integration.choice(
      "Unverified scheme", accept_unverified, {{"refuse", false}, {"accept", true}},
      "whether bodies that soften may be computed with other schemes than SUBPOINT, to compare them");
}

/// Declares the section Time.
void declare_time(Parameters& parameters, TimeInputs& time) {
  auto t = parameters.section("Time");
  t.quantity("End time", time.end_time, Dimension::time, {above_zero, 1e3},
             "simulated time at which the run ends at the latest");
  t.number("Step factor", time.step_factor, {1e-3, 1},
           "time step in units of the smallest h / c; h: extent of the deformed nodal cell");
  t.choice("Subcycles", time.subcycles, {{"1", 1}, {"2", 2}, {"4", 4}, {"8", 8}},
           "largest ratio of time steps: where cells are larger than the smallest, stresses are computed for "
           "two, four or eight steps at once; 1: in every step");
  t.integer("Verify step every", time.verify_every, {0, 1000000},
            "steps between stability estimates, which shorten a step that is too long, and checks for "
            "hourglass modes; 0: never");
  t.number("Newmark beta", time.beta, {0, 1},
           "Newmark's beta: only 0, the explicit scheme; other values need an implicit solver");
  t.number("Newmark gamma", time.gamma, {0, 1},
           "Newmark's gamma: 1/2: central differences, no damping; larger values damp high frequencies, "
           "smaller ones are unstable");
}

} // namespace

void RunInputs::declare(Parameters& parameters) {
  declare_approximation(parameters, solid);
  declare_integration(parameters, solid, accept_unverified_scheme);
  declare_time(parameters, time);

  auto output = parameters.section("Output");
  output.quantity("Frame interval", frame_interval, Dimension::time, {above_zero, 1e3},
                  "simulated time between frames of the fields");
  output.quantity("History interval", history_interval, Dimension::time, {above_zero, 1e3},
                  "simulated time between lines of history.csv");
  fragments.declare(parameters);
  answers.declare(parameters);

  auto run = parameters.section("Run");
  run.number("Accuracy", accuracy, {0, 100},
             "numerical error of the resistance of a target, or of the shortening of a bar, in percent: the "
             "cheapest model "
             "that has been measured to reach it replaces symmetry, spacing and scheme of the scene; 0: the "
             "scene as it is");
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
             "relative energy error above which the run stops");
}

void RunInputs::validate(const std::string& file) const {
  const ApproximationInputs& approximation = solid.approximation;
  if (approximation.order == 0 && solid.integration.scheme == Scheme::nsni)
    throw InputError(file +
                     ": key 'Approximation/Basis order': 0 has no derivatives for Integration/Scheme = "
                     "NSNI; choose 1 or 2");
  if (is_conforming(solid.integration.scheme) && approximation.configuration != Configuration::lagrangian)
    throw InputError(file + ": key 'Integration/Scheme': " + name_of(solid.integration.scheme) +
                     " uses the initial cells; it needs Approximation/Configuration = Lagrangian");
  const auto number = [](double value) { return format_quantity(value, Dimension::none); };
  for (const auto& [key, interval, most] : {std::tuple("Frame interval", frame_interval, most_frames),
                                            {"History interval", history_interval, most_rows}})
    if (time.end_time > most * interval)
      throw InputError(file + ": key 'Output/" + key + "': found " +
                       format_quantity(interval, Dimension::time) + ", allowed: at least " +
                       format_quantity(time.end_time / most, Dimension::time) + " (Time/End time over " +
                       number(most) + ")");
  if (time.beta != 0)
    throw InputError(file + ": key 'Time/Newmark beta': found " + number(time.beta) +
                     ", allowed: 0 (the step is explicit; other values need an implicit solver)");
  if (time.gamma < 0.5)
    throw InputError(file + ": key 'Time/Newmark gamma': found " + number(time.gamma) +
                     ", allowed: 0.5 to 1 (below 0.5 the scheme is unstable)");
  if (time.subcycles > 1 && time.gamma > 0.5)
    throw InputError(
        file + ": key 'Time/Subcycles': found " + std::to_string(time.subcycles) +
        ", allowed: 1 with a Newmark gamma above 0.5, whose damping needs all forces in every step");
}

} // namespace spall
