#pragma once

#include <array>
#include <cstddef>

namespace spall {

/// Purposes that the MPI traffic is counted for.
enum class MpiUse {
  other, ///< checkpoints
  setup,
  velocities, ///< velocities from the owner of a point to its remote copies, in every step
  forces,     ///< forces from the remote copies of a point to its owner, in every step
  contact,    ///< between bodies
  refreshes,  ///< when neighbours and shape functions are recomputed
  looks,      ///< checks for instabilities and errors of the run
  output,
  reductions ///< sums and extrema over the ranks, in every step
};
inline constexpr std::array<const char*, 9> mpi_uses = {
    "other", "setup", "velocities", "forces", "contact", "refreshes", "looks", "output", "reductions"};

/// Messages that this process has sent so far.
struct Traffic {
  std::size_t messages = 0, bytes = 0; ///< messages to one other process
  std::size_t collectives = 0;         ///< calls in which all processes take part
  std::size_t collective_bytes = 0;    ///< bytes that this process contributed to them
  std::size_t gathered_bytes = 0;      ///< the part of collective_bytes that every other process receives
};

/// Traffic so far for one purpose, counted in MPI's profiling interface (MPI 3.1, chapter 14), which every
/// message passes, deal.II's too. All zeros as long as MPI has not been initialised.
Traffic traffic_of(MpiUse use);
/// Processor time that the main thread has spent inside MPI so far (waiting and copying), s.
double seconds_in_mpi();

/// While an object lives, messages are counted for its purpose. Of nested objects the outermost one decides.
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
