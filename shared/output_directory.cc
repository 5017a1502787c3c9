#include "shared/output_directory.h"

#include "shared/error.h"

#include <fcntl.h>
#include <sys/random.h>
#include <unistd.h>

#include <cerrno>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <utility>
#include <vector>

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
  std::error_code ignored;
  if (error || !fs::is_directory(directory, ignored))
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

namespace {

const std::string begin_of_temporary = ".spall-", end_of_temporary = ".part";

std::string unpredictable() {
  std::uint64_t number = 0;
  if (getrandom(&number, sizeof number, 0) != sizeof number) fail_with_errno();
  char text[20];
  std::snprintf(text, sizeof text, "%016" PRIx64, number);
  return text;
}

} // namespace

bool Temporary::is_one(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.size() == begin_of_temporary.size() + 16 + end_of_temporary.size() &&
         name.starts_with(begin_of_temporary) && name.ends_with(end_of_temporary);
}

Temporary::Temporary(const fs::path& beside, const Ranks& ranks_) : ranks(ranks_) {
  std::vector<std::string> made; // by the first rank, for all
  ranks.on_first([&] {
    const fs::path name = beside.parent_path() / (begin_of_temporary + unpredictable() + end_of_temporary);
    Descriptor(name, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW).close_checked();
    made = {name.string()};
  });
  file = ranks.gather(made).at(0);
}

Temporary::~Temporary() {
  std::error_code ignored;
  if (ranks.first() && !file.empty()) fs::remove(file, ignored);
}

void Temporary::take_place_of(const fs::path& other) {
  ranks.on_first([&] {
    sync_file(file);
    fs::rename(file, other);
  });
  file.clear();
}

void write_atomically(const fs::path& file, const std::function<void(const fs::path&)>& writer,
                      const Ranks& ranks) {
  try {
    ranks.on_first([&] {
      std::error_code none;
      const fs::file_status there = fs::symlink_status(file, none);
      if (fs::exists(there) && !fs::is_regular_file(there) && !fs::is_symlink(there))
        throw std::runtime_error("is no regular file");
    });
    Temporary temporary(file, ranks);
    writer(temporary.path());
    temporary.take_place_of(file);
  } catch (const std::exception& error) {
    throw OutputError("cannot write '" + file.string() + "': " + error.what());
  }
}

void write_atomically(const fs::path& file, const std::string& text) {
  write_atomically(file, [&text](const fs::path& temporary) {
    Descriptor handle(temporary, O_WRONLY | O_NOFOLLOW);
    write_all(handle, text);
    handle.close_checked();
  });
}

void check_room(const fs::path& file, std::size_t bytes) {
  Descriptor handle(file, O_WRONLY | O_NOFOLLOW);
  // File systems that cannot reserve room say so; then the writer must try.
  const bool full = fallocate(handle, 0, 0, static_cast<off_t>(bytes)) != 0 && errno != EOPNOTSUPP;
  const std::string reason = std::strerror(errno);
  const bool emptied = ftruncate(handle, 0) == 0;
  if (full || !emptied)
    throw std::runtime_error("no room for " + std::to_string(bytes) + " bytes: " + reason);
}

} // namespace spall
