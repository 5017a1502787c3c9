#include "shared/result_folder.h"

#include "shared/error.h"
#include "shared/output_directory.h"

#include <fcntl.h>
#include <fnmatch.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace spall {
namespace fs = std::filesystem;

struct ResultFolder::Lock {
  int descriptor;
  ~Lock() { close(descriptor); }
};

ResultFolder::ResultFolder(fs::path path_, std::vector<std::string> names_, Existing existing_,
                           const Ranks& ranks_, bool shared_)
    : folder(std::move(path_)), names(std::move(names_)), existing(existing_), ranks(ranks_),
      shared(shared_) {}

ResultFolder::~ResultFolder() = default;

bool ResultFolder::is_result(const fs::path& file) const {
  const std::string name = file.filename().string();
  return std::any_of(names.begin(), names.end(), [&](const std::string& pattern) {
    return name == pattern || fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
  });
}

std::string ResultFolder::found() const {
  if (!fs::exists(folder)) return "";
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (is_result(entry.path())) return entry.path().filename().string();
  return "";
}

void ResultFolder::lock() {
  if (held) return;
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0)
    throw InputError("output folder '" + folder.string() + "' cannot be opened: " + std::strerror(errno));
  held.reset(new Lock{descriptor});
  if (flock(descriptor, (shared ? LOCK_SH : LOCK_EX) | LOCK_NB) == 0) return;
  if (errno == EWOULDBLOCK)
    throw InputError("output folder '" + folder.string() +
                     "' belongs to another run that has not ended; --output DIR writes elsewhere");
  // Some network file systems have no locks on folders.
  std::fprintf(stderr, "warning: output folder '%s' cannot be locked (%s): no other run must write into it\n",
               folder.c_str(), std::strerror(errno));
}

void ResultFolder::check(const std::vector<fs::path>& inputs) {
  ranks.on_first([&] {
    const std::string where = "output folder '" + folder.string() + "'";
    if (existing == Existing::go_on && !fs::is_directory(folder))
      throw InputError("--restart: " + where + " does not exist");
    if (!fs::exists(folder)) return;
    if (!fs::is_directory(folder)) throw InputError(where + " is a file");
    if (access(folder.c_str(), W_OK) != 0) throw InputError(where + " cannot be written");
    lock();
    if (existing == Existing::refuse)
      if (const std::string name = found(); !name.empty())
        throw InputError(
            where + " holds results (" + name +
            "), which are not replaced unasked: --force replaces them, --output DIR writes elsewhere");
    if (existing == Existing::replace)
      for (const fs::path& input : inputs) {
        const fs::path parent = fs::absolute(input).parent_path();
        if (is_result(input) && fs::exists(parent) && fs::equivalent(parent, folder))
          throw InputError("the input '" + input.string() +
                           "' is among the results that --force replaces in '" + folder.string() +
                           "': copy it elsewhere, or give another --output");
      }
  });
}

void ResultFolder::own(bool clear) {
  ranks.on_first([&] {
    make_output_directory(folder);
    lock();
    if (existing == Existing::refuse && !found().empty()) // made by another run since check()
      throw InputError("output folder '" + folder.string() + "' holds results of another run (" + found() +
                       ")");
    if (existing != Existing::replace || !clear) return;
    std::vector<fs::path> old;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
      if (is_result(entry.path()) && entry.is_regular_file()) old.push_back(entry.path());
    for (const fs::path& file : old) fs::remove(file);
  });
}

} // namespace spall
