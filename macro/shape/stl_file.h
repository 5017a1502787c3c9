#pragma once

#include "macro/shape/triangle_tree.h"

#include <filesystem>

namespace spall {

/// A surface that a file gave.
struct StlSurface {
  Triangles triangles;
  bool turned = false; ///< the file had its triangles inside out
};

/// Reads a closed surface from an STL file, text or binary. Corners with equal coordinates are one point. A
/// surface that is inside out is turned round.
/// @param unit length that the file's number 1 stands for, m
/// @throws InputError, one line with the file: it cannot be opened, is not STL or has no triangles, triangles
/// without area, an edge that other than two triangles share (an open surface), a surface that intersects
/// itself, parts inside each other that do not bound a volume
StlSurface read_stl(const std::filesystem::path& file, double unit);

} // namespace spall
