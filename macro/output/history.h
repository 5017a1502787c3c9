#pragma once

#include "macro/dynamics/simulation.h"

#include <filesystem>
#include <fstream>
#include <limits>

namespace spall {

/// `history.csv`: one line per recorded step, SI, for the whole body (sums of the modelled part times the
/// number of symmetric copies). For a Taylor bar the projectile_* columns are the bar's centre of mass.
class History {
public:
  explicit History(const std::filesystem::path& directory);
  /// One line for the present step, unless it has one already.
  void write(const Simulation& run);

private:
  std::ofstream stream;
  std::size_t last_step = std::numeric_limits<std::size_t>::max();
};

/// Height of the centre of mass of the points, m.
double centre_of_mass(const Points& points);

} // namespace spall
