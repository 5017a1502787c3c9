#include "shared/output_directory.h"

#include "shared/error.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace spall {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail_with_errno() { throw std::runtime_error(std::strerror(errno)); }

/// A file descriptor that is closed however its scope ends.
class Descriptor {
public:
  Descriptor(const fs::path& file, int flags) : number(open(file.c_str(), flags | O_CLOEXEC, 0666)) {
    if (number < 0) fail_with_errno();
  }
  ~Descriptor() {
    if (number >= 0) close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return number; }
  /// Some file systems say only now that the disk is full.
  void close_checked() {
    if (close(std::exchange(number, -1)) != 0) fail_with_errno();
  }

private:
  int number;
};

void sync_descriptor(int descriptor) {
  // What cannot be synchronised (a pipe, /dev/null) says so.
  if (fsync(descriptor) != 0 && errno != EINVAL && errno != EROFS) fail_with_errno();
}

} // namespace

void make_output_directory(const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error || !fs::is_directory(directory))
    throw InputError("output folder '" + directory.string() +
                     "' cannot be created: " + (error ? error.message() : "there is a file of that name"));
  if (access(directory.c_str(), W_OK) != 0)
    throw InputError("output folder '" + directory.string() + "' cannot be written");
}

void write_all(int descriptor, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = write(descriptor, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_with_errno();
    done += static_cast<std::size_t>(written);
  }
}

void sync_file(const fs::path& file) {
  Descriptor handle(file, O_RDONLY);
  sync_descriptor(handle);
  handle.close_checked();
}

void write_atomically(const fs::path& file, const std::function<void(const fs::path&)>& writer,
                      const Ranks& ranks) {
  fs::path temporary = file;
  temporary += ".part";
  try {
    ranks.on_first([&] {
      if (fs::exists(file) && !fs::is_regular_file(file)) throw std::runtime_error("is no regular file");
    });
    writer(temporary);
    ranks.on_first([&] {
      sync_file(temporary);
      fs::rename(temporary, file);
    });
  } catch (const std::exception& error) {
    std::error_code ignored;
    if (ranks.first()) fs::remove(temporary, ignored);
    throw OutputError("cannot write '" + file.string() + "': " + error.what());
  }
}

void write_atomically(const fs::path& file, const std::string& text) {
  write_atomically(file, [&text](const fs::path& temporary) {
    Descriptor handle(temporary, O_WRONLY | O_CREAT | O_TRUNC);
    write_all(handle, text);
    handle.close_checked();
  });
}

void check_room(const fs::path& file, std::size_t bytes) {
  Descriptor handle(file, O_WRONLY | O_CREAT | O_TRUNC);
  // File systems that cannot reserve room say so; then the writer must try.
  const bool full = fallocate(handle, 0, 0, static_cast<off_t>(bytes)) != 0 && errno != EOPNOTSUPP;
  const std::string reason = std::strerror(errno);
  const bool emptied = ftruncate(handle, 0) == 0;
  if (full || !emptied)
    throw std::runtime_error("no room for " + std::to_string(bytes >> 20) + " MiB: " + reason);
}

} // namespace spall
