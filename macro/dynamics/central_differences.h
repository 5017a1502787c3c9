#pragma once

#include "macro/points/points.h"
#include "shared/archive.h"

#include <cstddef>
#include <string>
#include <vector>

namespace spall {

/// Sums over the owned points of a solid: kinetic energy, J, and momentum along z, N s.
struct MotionSums {
  double kinetic = 0, momentum = 0;
};
/// Added up in a fixed order, whatever the number of threads.
MotionSums motion_sums(const Points& points);

/// Central differences with velocities at half steps (leapfrog) of the points of one solid, with Newmark's
/// gamma > 1/2 as an option: beta = 0 reads w' = w + dt (a + (gamma - 1/2)(a - a_last)) in velocities at half
/// steps.
class CentralDifferences {
public:
  explicit CentralDifferences(double gamma) : extra(gamma - 0.5) {}

  /// v += duration f / m. With gamma > 1/2 the forces f become f + (gamma - 1/2)(f - f_last).
  /// @return the energy that the extra part takes away, J
  double kick(Points& points, double duration);
  /// x += dt v
  static void drift(Points& points, double dt);

  /// The forces of the last step, if gamma > 1/2. @param name of the solid
  void transfer(Archive& archive, const std::string& name, std::size_t owned, std::size_t block_size);

private:
  double add_memory(Points& points, double duration);

  double extra;           ///< gamma - 1/2
  VectorField last_force; ///< of the last step, N
  bool has_memory = false;
};

} // namespace spall
