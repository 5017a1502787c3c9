#pragma once

#include "macro/points/tensor.h"
#include "shared/input/parameters.h"

#include <filesystem>
#include <vector>

namespace spall {

/// One row of a strain path: total strains at a time, tension positive, tensor shear.
struct PathRow {
  double time; ///< s
  Sym3 strain;
};

/// Reads a `.csv` file (read_number_rows) with the columns time, exx, eyy, ezz, exy, eyz, exz. The path
/// starts unstrained: at the first row if that is unstrained, else at time 0. The returned rows begin with
/// that start, times strictly increase.
/// @throws InputError: file, line, column, found, allowed.
std::vector<PathRow> read_strain_path(const std::filesystem::path& file);

/// What happens to the normal strains across the x axis.
enum class Lateral {
  strain,     ///< eyy and ezz are those of the path
  stress_free ///< uniaxial stress: eyy = ezz of the path are ignored, those are found that keep syy = szz = 0
};

/// How a path is followed: the section "Path".
struct PathOptions {
  int substeps = 1;        ///< per row; at least, if there is a tolerance
  double tolerance = 1e-3; ///< of a row: relative to the largest stress and the work so far; 0: none
  Lateral lateral = Lateral::strain;
  double spacing = required; ///< m, for laws that soften; may stay unset if only a reference length needs it
  /// `spacing_needed`: whether the material must know the spacing of its points.
  void declare(Parameters& parameters, Needed spacing_needed);
};

} // namespace spall
