#include "shared/input/text_file.h"

#include "shared/error.h"
#include "shared/input/words.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace spall {
namespace {

/// A file that is open for reading, or why it is not.
class Opened {
public:
  explicit Opened(const std::filesystem::path& file)
      // A pipe without a writer would let the program wait.
      : number(open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)) {
    if (number < 0)
      fault = errno == ENOENT ? "does not exist" : std::string("cannot be opened: ") + std::strerror(errno);
    else if (fstat(number, &status) != 0)
      fault = std::string("cannot be read: ") + std::strerror(errno);
    else if (S_ISDIR(status.st_mode))
      fault = "is a folder, a file is needed";
    else if (!S_ISREG(status.st_mode))
      fault = "is a pipe or a device, a file is needed";
  }
  ~Opened() {
    if (number >= 0) close(number);
  }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;

  int number;
  struct stat status {};
  std::string fault;
};

} // namespace

std::string fault_of_file(const std::filesystem::path& file) {
  if (file.empty()) return "has no name";
  return Opened(file).fault;
}

std::string read_text_file(const std::filesystem::path& file) {
  const auto refuse = [&](const std::string& why) { throw InputError(file.string() + ": " + why); };
  if (file.empty()) refuse("the name of a file is empty");
  const Opened opened(file);
  if (!opened.fault.empty()) refuse(opened.fault);
  std::string text;
  std::string buffer(1 << 16, '\0');
  for (;;) {
    const ssize_t count = read(opened.number, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuse(std::string("cannot be read to its end: ") + std::strerror(errno));
    if (count == 0) break;
    text.append(buffer, 0, static_cast<std::size_t>(count));
    if (text.size() > largest_text)
      refuse("is no input: it has more than " + std::to_string(largest_text >> 20) + " MiB");
  }
  if (const auto nul = text.find('\0'); nul != std::string::npos)
    throw InputError(
        file.string() + ":" +
        std::to_string(1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(nul), '\n')) +
        ": found a NUL byte, allowed: a text in UTF-8");
  if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
  return text;
}

bool Lines::next(std::string& line) {
  if (place >= text.size()) return false;
  const std::size_t end = std::min(text.find('\n', place), text.size());
  line = text.substr(place, end - place);
  place = end + 1;
  return true;
}

} // namespace spall
