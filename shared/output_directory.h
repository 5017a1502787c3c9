#pragma once

#include "shared/ranks.h"

#include <filesystem>
#include <functional>
#include <string>

namespace spall {

/// Creates a folder for results (and its parents) if it does not exist.
/// @throws InputError if it cannot be created or written.
void make_output_directory(const std::filesystem::path& directory);

/// Writes `text` to a temporary name beside `file`, then renames it over `file`: a reader, a crash or a full
/// disk never sees or leaves half a file.
/// @throws ComputationError if it cannot be written; an older `file` is then untouched.
void write_atomically(const std::filesystem::path& file, const std::string& text);

/// The same for a file that `writer` creates under the name it is given, on all ranks together: it must fail
/// on all of them or on none.
void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path& temporary)>& writer,
                      const Ranks& ranks = {});

/// Throws std::runtime_error unless `bytes` can be written to `file` now: for writers that do not survive a
/// full disk (HDF5 stumbles over what it could not write when the program ends). Empties the file.
void check_room(const std::filesystem::path& file, std::size_t bytes);

} // namespace spall
