#pragma once

#include "macro/output/fragments.h"

#include <filesystem>
#include <vector>

namespace spall {

/// What is missing at the faces of a slab. A metal that is dented or bent has moved, too, but nothing is
/// missing.
enum class Missing { fragments_and_moved, fragments };

/// A crater: the part of a slab that is missing at one of its faces. Every place of the undeformed slab
/// belongs to the point that was nearest to it, for any layout of the points. It is missing if that point
/// belongs to a fragment or, unless `Missing` excludes it, if it has moved relative to the slab by more than
/// half its spacing, or if it is loose: cracks between it and what is left of the slab behind it have opened
/// by more than FragmentInputs::loose.
struct Crater {
  /// For each angle the radius of the sector with the area that is missing at the face, m.
  std::vector<double> outline;
  /// For each radius the depth of the first place that is not missing, mean over the angles, m.
  std::vector<double> depth;
  double mean_diameter = 0;    ///< diameter of the disc with the area that is missing at the face, m
  double largest_diameter = 0; ///< largest diameter of the outline through the axis, m
  double deepest = 0;          ///< largest depth, m
};
struct Craters {
  std::vector<double> angle;  ///< middles of the sectors of the whole circle, rad
  std::vector<double> radius; ///< middles of the rings, m
  Crater front, back;
};

/// Standard deviations of crater diameters over spacings and layouts of the points, as parts of the diameter:
/// the 127 mm slab with points 25, 14 and 8 mm apart, regular and jittered, and spheres around the axis, with
/// regular, jittered and finer rings (data/studies/README.md).
constexpr double front_scatter = 0.19, back_scatter = 0.11;

/// Measures the craters of a slab. All ranks must call it.
/// @param front,back z of the slab's faces at the start, m @param slab_radius radius of the largest circle
/// on them, m @param loose opening, m
Craters measure_craters(const Solid& slab, const Fragments& fragments, double front, double back,
                        double slab_radius, double loose, Missing missing = Missing::fragments_and_moved);

/// craters.csv: angle, front_radius, back_radius; crater_profiles.csv: radius, front_depth, back_depth; SI.
/// @param prefix prefix of the files' names
void write_craters(const std::filesystem::path& directory, const std::string& prefix, const Craters& craters);

} // namespace spall
