#pragma once

#include "macro/contact/surface_patch.h"

namespace spall {

/// The patch of a primary body's surface in front of a point of a secondary body, fitted through the
/// outermost points of the primary body. The gap counts from the surface of the secondary body.
/// @param n the point among near_secondary
/// @param watched gaps up to so many spacings are of interest
/// @return the spacing that the gap is measured by, m: the point's own, or that of the nearest point in front
/// if it is larger; 0 if there is no surface in front, or a point of the secondary body in between
double find_facing_patch(SurfacePatch& patch, const Points& secondary, const NearPoints& near_secondary,
                         std::uint32_t n, const Points& primary, const NearPoints& near_primary,
                         double watched);

} // namespace spall
