#pragma once

namespace spall {

/// Condition that ends a run before its end time.
enum class Until {
  settled,  ///< the velocities, depths and lengths that are asked for do not change any more
  answered, ///< craters and fragments have come about as well: projectiles have left their targets
  end_time  ///< the run does not end before its end time
};

} // namespace spall
