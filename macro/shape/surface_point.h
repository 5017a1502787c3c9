#pragma once

#include "macro/points/tensor.h"

namespace spall {

/// Signed distance to a surface (negative inside the body) and its outward normal, in the body's frame.
struct SurfacePoint {
  double distance; ///< m
  Vec3 normal;
};

} // namespace spall
