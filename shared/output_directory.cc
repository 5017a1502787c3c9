#include "shared/output_directory.h"

#include "shared/error.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

namespace spall {
namespace fs = std::filesystem;

void make_output_directory(const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error || !fs::is_directory(directory))
    throw InputError("output folder '" + directory.string() + "' cannot be created: " + error.message());
  if (access(directory.c_str(), W_OK) != 0)
    throw InputError("output folder '" + directory.string() + "' cannot be written");
}

void write_atomically(const fs::path& file, const std::function<void(const fs::path&)>& writer,
                      const Ranks& ranks) {
  fs::path temporary = file;
  temporary += ".part";
  try {
    writer(temporary);
    ranks.on_first([&] { fs::rename(temporary, file); });
  } catch (const std::exception& error) {
    std::error_code ignored;
    if (ranks.first()) fs::remove(temporary, ignored);
    throw ComputationError("cannot write '" + file.string() + "': " + error.what());
  }
}

void check_room(const fs::path& file, std::size_t bytes) {
  const int handle = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (handle < 0) throw std::runtime_error(std::strerror(errno));
  // File systems that cannot reserve room say so; then the writer must try.
  const bool full = fallocate(handle, 0, 0, static_cast<off_t>(bytes)) != 0 && errno != EOPNOTSUPP;
  const std::string reason = std::strerror(errno);
  const bool emptied = ftruncate(handle, 0) == 0;
  close(handle);
  if (full || !emptied)
    throw std::runtime_error("no room for " + std::to_string(bytes >> 20) + " MiB: " + reason);
}

void write_atomically(const fs::path& file, const std::string& text) {
  write_atomically(file, [&text](const fs::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) throw std::runtime_error("disk full or not writable");
  });
}

} // namespace spall
