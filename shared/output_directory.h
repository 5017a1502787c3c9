#pragma once

#include "shared/ranks.h"

#include <filesystem>
#include <functional>
#include <string>

namespace spall {

/// Creates a folder for results (and its parents) if it does not exist.
/// @throws InputError if it cannot be created or written.
void make_output_directory(const std::filesystem::path& directory);

/// A new, empty file beside another one, of a name that cannot be predicted and did not exist, so that nobody
/// can have put a link there. It is gone at the end of its scope unless it has taken the other one's place.
/// All ranks make the same calls.
class Temporary {
public:
  /// @throws std::runtime_error with the reason
  explicit Temporary(const std::filesystem::path& beside, const Ranks& ranks = {});
  ~Temporary();
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  const std::filesystem::path& path() const { return file; }
  /// Waits until the disk has it, then renames it. @throws std::runtime_error with the reason
  void take_place_of(const std::filesystem::path& other);

  /// Whether a file is one that a process has left which was killed.
  static bool is_one(const std::filesystem::path& file);

private:
  Ranks ranks;
  std::filesystem::path file;
};

/// Writes `text` into a temporary file, waits until the disk has it, then renames it to `file`. So a reader
/// never sees half a file, and a crash or a full disk never leaves one. A link of that name is replaced, not
/// followed.
/// @throws OutputError if it cannot be written, or if `file` is there and no regular file; an older `file` is
/// then untouched.
void write_atomically(const std::filesystem::path& file, const std::string& text);

/// The same for a file that `writer` fills, on all ranks together: it is there and empty.
/// The writer must close the file, check that, and fail on all ranks or on none.
void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path& temporary)>& writer,
                      const Ranks& ranks = {});

/// Waits until the disk has a file that is closed: only then is it known that it has been written, and a
/// machine that loses its power keeps it. @throws std::runtime_error with the reason
void sync_file(const std::filesystem::path& file);

/// Throws std::runtime_error unless `bytes` can be written to a file that is there now. Writers need it that
/// do not survive a full disk: HDF5 fails at the end of the program on data that it could not write. The file
/// is empty afterwards.
void check_room(const std::filesystem::path& file, std::size_t bytes);

/// Writes all of `text` to a file descriptor. @throws std::runtime_error with the reason
void write_all(int descriptor, const std::string& text);

} // namespace spall
