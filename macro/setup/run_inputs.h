#pragma once

#include "macro/dynamics/simulation.h"
#include "macro/output/answers.h"
#include "macro/points/balance.h"
#include "macro/solid/solid.h"
#include "shared/input/parameters.h"

namespace spall {

/// The numerical part of a scene file: how the scene is computed, and how much of it is written.
struct RunInputs {
  SolidInputs solid;
  TimeInputs time;
  double frame_interval = 1e-3, history_interval = 1e-6; ///< s of simulated time
  FragmentInputs fragments;
  AnswerInputs answers;
  double energy_tolerance = 0.1;    ///< relative energy error that stops the run
  double checkpoint_interval = 600; ///< s of wall time; 0: none but when interrupted
  double accuracy = 0;              ///< percent, see alternatives(); 0: as the scene says
  int threads = 0;                  ///< 0: all
  BalanceInputs balance;
  bool accept_unverified_scheme = false; ///< see check_schemes()

  void declare(Parameters& parameters);
  /// Checks that go beyond one key. @throws InputError. `file` names the input in messages.
  void validate(const std::string& file) const;
};

} // namespace spall
