#include "shared/row_file.h"

#include "shared/error.h"
#include "shared/output_directory.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace spall {

void RowFile::open(const std::filesystem::path& file, std::uint64_t size) {
  close();
  path = file;
  descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (descriptor < 0 || ftruncate(descriptor, static_cast<off_t>(size)) != 0)
    throw OutputError("cannot write '" + file.string() + "': " + std::strerror(errno));
  bytes = size;
}

void RowFile::append(const std::string& text) {
  try {
    write_all(descriptor, text);
  } catch (const std::runtime_error& error) {
    // Cutting needs no room. Should it fail too, the next row would make it worse: there is none.
    if (ftruncate(descriptor, static_cast<off_t>(bytes)) != 0) close();
    throw OutputError("cannot write '" + path.string() + "': " + error.what());
  }
  bytes += text.size();
}

void RowFile::close() {
  if (descriptor >= 0) ::close(std::exchange(descriptor, -1));
}

} // namespace spall
