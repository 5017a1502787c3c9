#pragma once

#include "macro/output/fragments.h"

#include <filesystem>
#include <vector>

namespace spall {

/// What is gone of a slab, seen from its faces. Every place of the undeformed slab belongs to the point that
/// was nearest to it, whatever the layout of the points; it is gone if that point belongs to a fragment or
/// has moved against the slab by more than half its spacing.
struct Crater {
  std::vector<double> outline; ///< by angle: radius of the sector with the area that is gone of the face, m
  std::vector<double>
      depth; ///< by radius: down to the first place that is still there, mean over the angles, m
  double mean_diameter = 0;    ///< of the disc with the area that is gone of the face, m
  double largest_diameter = 0; ///< of the outline, through the axis, m
  double deepest = 0;          ///< m
};
struct Craters {
  std::vector<double> angle;  ///< middles of the sectors of the whole circle, rad
  std::vector<double> radius; ///< middles of the rings, m
  Crater front, back;
};

/// All ranks must call it.
/// @param front,back z of the slab's faces at the start, m. @param slab_radius of the largest circle on them,
/// m
Craters measure_craters(const Solid& slab, const Fragments& fragments, double front, double back,
                        double slab_radius);

/// craters.csv: angle, front_radius, back_radius; crater_profiles.csv: radius, front_depth, back_depth; SI.
/// @param prefix of the files' names
void write_craters(const std::filesystem::path& directory, const std::string& prefix, const Craters& craters);

} // namespace spall
