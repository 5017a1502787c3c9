#pragma once

#include <string>
#include <vector>

namespace spall {

/// An array of an HDF5 file: single-precision numbers, or 64-bit integers if it holds cells.
struct XdmfArray {
  std::string name;
  std::string unit;
  std::string place; ///< FILE.h5:/path
  std::size_t rows = 0, columns = 1;
};

/// A body in one frame: its points, the cells between them, and fields at the points.
struct XdmfGrid {
  std::string name;
  const char* cell = ""; ///< topology type: Polyvertex, Triangle
  XdmfArray cells, points;
  std::vector<XdmfArray> fields;
};

struct XdmfFrame {
  double time = 0; ///< s
  std::vector<XdmfGrid> grids;
};

/// Returns the text of an .xdmf file with these frames, one block per grid, as the readers of Xdmf 2 and of
/// Xdmf 3 take it: the cells are always listed, because the reader of Xdmf 3 makes none from their number
/// alone. The unit of a field is its Information element `unit`.
std::string xdmf_of(const std::vector<XdmfFrame>& frames);

} // namespace spall
