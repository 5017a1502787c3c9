#pragma once

#include "macro/contact/rigid_pairs.h"
#include "macro/output/frames.h"
#include "macro/output/history.h"
#include "macro/output/run_summary.h"
#include "macro/restart/checkpoint.h"
#include "macro/restart/rebalance.h"
#include "macro/setup/run_inputs.h"
#include "shared/error.h"
#include "shared/progress.h"
#include "shared/result_folder.h"

#include <memory>
#include <string>
#include <vector>

namespace spall {

/// How the steps of a run have ended.
struct StepsEnd {
  std::string failure = {}; ///< empty: there was none
  bool sound = true;        ///< whether the state can be saved and gone on from
};

/// A run under way: the state, what it has left behind, and when the next of it is due. What it writes is
/// complete at every moment: history and frames as far as they have come, a checkpoint from which the rest
/// can be computed, and at the end the summary, first without the answers, whatever their evaluation does.
class Run {
public:
  Run(const SceneInputs& scene, const RunInputs& inputs, RunRecord record, ResultFolder& folder);

  /// Files that a run writes (see ResultFolder).
  static std::vector<std::string> files();

  /// Begins anew, in place of results that are there.
  void begin();
  /// Goes on where the newest checkpoint is. @return false if the run is finished, which it says
  /// @throws InputError if there is no checkpoint of this scene; nothing has been changed.
  bool go_on();
  /// Advances to the end, an interruption or a failure.
  StepsEnd go();
  /// Writes what belongs to the end of a run. @throws ComputationError with the failure, if there was one
  ExitCode conclude(StepsEnd end);

  RunRecord record; ///< times up to the begin of this process's steps, until conclude()

private:
  void transfer(Archive& archive);
  void make_files(bool go_on);
  /// What the user is told, and what a run that has begun owes to those that read its folder.
  void announce();
  bool finished() const { return !(simulation.time < inputs.time.end_time) || answers.reached(simulation); }
  /// History and frames that are due.
  void record_step();
  void write_history();
  void check_energy() const;
  void check_rigid_pairs();
  /// Part of the way to the last answer or to the end time, whichever is nearer.
  double part_done() const {
    return std::max(simulation.time / inputs.time.end_time, answers.part_done(simulation));
  }
  std::string progress_line() const;
  /// Memory of the bodies on all ranks, bytes.
  double model_bytes() const;
  /// A checkpoint. One that cannot be written is no reason to stop. @return whether it was written
  bool save();
  /// Writes something at the end of the run. If that fails, the run has failed, but goes on writing the rest.
  void keep(StepsEnd& end, const std::function<void()>& write);
  void write_summary(bool answered);
  /// What this rank asks of all (Simulation::request): to stop, if it has been told to; a checkpoint by the
  /// clock of the first rank.
  static constexpr double nothing = 0, to_save = 1, to_stop = 2;
  double request() const;
  bool stopped() const { return simulation.request == to_stop; }
  double wall() const { return record.wall + watch.seconds(); }

  const SceneInputs& scene;
  const RunInputs& inputs;
  const Ranks ranks;
  ResultFolder& folder;
  Simulation simulation;
  Answers answers;
  Balancer balancer{inputs.balance};
  Checkpoints checkpoints;
  RigidPairs rigid_pairs;
  std::unique_ptr<History> history;
  std::unique_ptr<Frames> frames;
  double next_frame = 0, next_history = 0; ///< s of simulated time
  Stopwatch watch, since_checkpoint;
};

} // namespace spall
