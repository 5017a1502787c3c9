#pragma once

#include <limits>

namespace spall {

struct TimeInputs {
  double end_time = std::numeric_limits<double>::quiet_NaN(); ///< s
  double step_factor = 0.5;                                   ///< part of h / c
  /// Subcycling: blocks of points whose cells allow it take a step that is up to this many times as long as
  /// that of the smallest cell: 1, 2, 4 or 8 (Subcycle).
  int subcycles = 1;
  /// Steps between looks at the run's health: estimates of the largest stable step from the stiffness, which
  /// are obeyed, and the hourglass indicators; 0: never. A look costs about ten steps.
  int verify_every = 500;
  /// Newmark's constants in the explicit form: u' = u + dt v + dt^2 / 2 a, then a' from u', then v' = v + dt
  /// ((1 - gamma) a + gamma a'). beta > 0 would make a' depend on itself, gamma < 1/2 feeds energy. gamma >
  /// 1/2 damps a vibration of frequency omega at the rate (gamma - 1/2) omega^2 dt / 2 and shortens the
  /// largest stable step by sqrt(2 gamma).
  double beta = 0, gamma = 0.5;
};

} // namespace spall
