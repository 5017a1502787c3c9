#pragma once

#include "macro/shape/contour.h"

#include <filesystem>

namespace spall {

/// Reads the contour of a body of revolution: a CSV file (read_number_rows) with the columns z and r, one
/// corner of the contour per row, in m, joined by straight lines. z goes from one end to the other, up or
/// down, and may repeat for steps; r is zero in the first and the last row only. The body is moved along its
/// axis so that its largest z, the tip, is at zero.
/// @throws InputError with file and line
Contour read_contour(const std::filesystem::path& file);

} // namespace spall
