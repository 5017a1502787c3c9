#pragma once

#include "shared/ranks.h"

#include <filesystem>
#include <functional>
#include <string>

namespace spall {

/// Creates a folder for results (and its parents) if it does not exist.
/// @throws InputError if it cannot be created or written.
void make_output_directory(const std::filesystem::path& directory);

/// Writes `text` under a temporary name beside `file`, then renames it to `file`. So a reader never sees half
/// a file, and a crash or a full disk never leaves one.
/// @throws ComputationError if it cannot be written; an older `file` is then untouched.
void write_atomically(const std::filesystem::path& file, const std::string& text);

/// The same for a file that `writer` creates, on all ranks together, under the temporary name it is given.
/// The writer must fail on all ranks or on none.
void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path& temporary)>& writer,
                      const Ranks& ranks = {});

/// Throws std::runtime_error unless `bytes` can be written to `file` now. Writers need it that do not survive
/// a full disk: HDF5 fails at the end of the program on data that it could not write. The file is empty
/// afterwards.
void check_room(const std::filesystem::path& file, std::size_t bytes);

} // namespace spall
