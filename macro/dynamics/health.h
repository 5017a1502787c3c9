#pragma once

#include "macro/dynamics/bodies.h"

#include <limits>
#include <string>
#include <vector>

namespace spall {

/// What tells whether a run can be trusted: indicators, margins, counts, and warnings in plain words.
struct Health {
  std::vector<HourglassIndicators> hourglass; ///< of each solid, the worst of each indicator over the looks
  /// Largest stable step over the step asked for, smallest of the estimates.
  double smallest_step_margin = std::numeric_limits<double>::infinity();
  std::size_t step_reductions = 0;                     ///< estimates that shortened the steps after them
  std::size_t refreshes = 0, refreshed_points = 0;     ///< of shape functions
  std::size_t most_regularized = 0, most_isolated = 0; ///< points of one solid at one refresh
  double smallest_moment_fraction = 1;                 ///< of the bulk's determinant of moments
  double largest_energy_error = 0;                     ///< magnitude, relative to the initial energy
  double most_dissipated = 0;                          ///< by the materials so far, J
  /// Largest fall of the dissipated energy below the most so far, relative to the initial energy: dissipation
  /// only grows, so that a law which lets it fall creates energy. The energy error does not show that, as it
  /// counts the work of the stresses and not what becomes of it.
  double energy_created = 0;
  std::vector<std::string> warnings; ///< each once

  /// Counts a refresh of the shape functions.
  void note(const RefreshReport& refresh);
  /// Looks at the hourglass indicators of all solids, keeps the worst and warns. All ranks must call it.
  void look(const Bodies& bodies, double time);
  /// Keeps the largest energy error and warns. A number that is none counts as an error.
  void note_energy_error(double error, double time);
  /// Keeps the largest fall of the dissipated energy and warns. @param dissipated, initial J
  void note_dissipated(double dissipated, double initial, double time);
  /// Counts an estimate that shortens the steps, and warns if they become shorter than half of what was
  /// asked for. @param factor the largest one, of h / c
  void note_short_step(double factor, double asked, double time);

  void transfer(Archive& archive);

private:
  /// What has been said already.
  struct Said {
    bool strain = false, volume = false, energy = false, created = false, step = false;
  };
  void warn(bool Said::*about, const std::string& text, double time);

  Said said;
};

} // namespace spall
