#pragma once

#include "macro/output/fragments.h"

#include <array>
#include <filesystem>
#include <limits>
#include <numbers>

namespace spall {

/// The debris of a target by the angle between its flight and +z: of every point that belongs to a fragment
/// behind the target, by its velocity. Rings of a model around the axis have angles too, where fragments have
/// none. Sums are of the whole body, and those over all bins are the sums over the debris.
struct DebrisCone {
  static constexpr std::size_t bins = 36;                  ///< of 5 degrees each, up to 180
  static constexpr double width = std::numbers::pi / bins; ///< of a bin, rad

  std::array<double, bins> mass{}, momentum{}, kinetic_energy{}; ///< kg; along z, N s; J
  /// Half angles of the cones that hold 50 and 90 % of the kinetic energy, rad; NaN without debris.
  double half_of_energy = std::numeric_limits<double>::quiet_NaN(), most_of_energy = half_of_energy;
};

/// @param fragments of the body, of the same moment. All ranks must call it.
DebrisCone debris_cone(const Solid& solid, const Fragments& fragments);

/// One line per bin: its two angles (rad), mass, momentum, kinetic energy, SI.
void write_debris_cone(const std::filesystem::path& file, const DebrisCone& cone);

} // namespace spall
