#pragma once

#include <array>
#include <cstddef>

namespace spall {

/// What MPI is used for.
enum class MpiUse {
  other, ///< checkpoints
  setup,
  velocities, ///< of the owners to remote points, in every step
  forces,     ///< gathered on remote points, to their owners, in every step
  contact,    ///< between bodies
  refreshes,  ///< neighbours and shape functions found anew
  looks,      ///< at the run's health
  output,
  reductions ///< of every step
};
inline constexpr std::array<const char*, 9> mpi_uses = {
    "other", "setup", "velocities", "forces", "contact", "refreshes", "looks", "output", "reductions"};

/// What this process has sent so far.
struct Traffic {
  std::size_t messages = 0, bytes = 0; ///< to one other process
  std::size_t collectives = 0;         ///< calls in which all take part
  std::size_t collective_bytes = 0;    ///< this process's own in them
  std::size_t gathered_bytes = 0;      ///< of those, the ones that all others receive
};

/// Counted in MPI's profiling interface (MPI 3.1, chapter 14), where every message passes, whoever sends it.
/// Nothing as long as MPI has not been started.
Traffic traffic_of(MpiUse use);
/// Processor time of the main thread inside MPI so far: waiting, copying, s.
double seconds_in_mpi();

/// As long as it lives, what is sent is counted for this use; but the first one counts if there are several.
class TrafficOf {
public:
  explicit TrafficOf(MpiUse use);
  ~TrafficOf();
  TrafficOf(const TrafficOf&) = delete;
  TrafficOf& operator=(const TrafficOf&) = delete;

private:
  MpiUse before;
};

} // namespace spall
