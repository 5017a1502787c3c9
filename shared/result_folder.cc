#include "shared/result_folder.h"

#include "shared/error.h"
#include "shared/output_directory.h"

#include <fcntl.h>
#include <fnmatch.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
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

std::vector<fs::path> ResultFolder::results() const {
  std::vector<fs::path> all;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
    if (is_result(entry.path())) all.push_back(entry.path());
  std::sort(all.begin(), all.end());
  return all;
}

std::string ResultFolder::found() const {
  const std::vector<fs::path> all = results();
  return all.empty() ? "" : all.front().filename().string();
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
    for (const std::string& name : names)
      if (name.size() > NAME_MAX) throw InputError("the name of the output is too long: '" + name + "'");
    std::error_code fault;
    const fs::file_status there = fs::status(folder, fault);
    if (fault && there.type() != fs::file_type::not_found)
      throw InputError(where + " cannot be used: " + fault.message());
    if (existing == Existing::go_on && !fs::is_directory(there))
      throw InputError("--restart: " + where + " does not exist");
    if (!fs::exists(there)) return check_parent();
    if (!fs::is_directory(there)) throw InputError(where + " is a file");
    if (access(folder.c_str(), W_OK) != 0) throw InputError(where + " cannot be written");
    lock();
    if (existing == Existing::refuse)
      if (const std::string name = found(); !name.empty())
        throw InputError(
            where + " holds results (" + name +
            "), which are not replaced unasked: --force replaces them, --output DIR writes elsewhere");
    check_links();
    if (shared)
      for (const fs::path& file : results())
        if (fs::is_directory(file))
          throw InputError("the output '" + file.string() + "' is a folder, a file is needed");
    if (existing == Existing::replace)
      for (const fs::path& input : inputs) check_input(input);
  });
}

void ResultFolder::check_parent() const {
  fs::path parent = fs::absolute(folder);
  std::error_code fault;
  while (!fs::exists(parent, fault) && parent.has_relative_path()) {
    if (parent.filename().string().size() > NAME_MAX)
      throw InputError("output folder '" + folder.string() + "' cannot be created: its name is too long");
    parent = parent.parent_path();
  }
  if (!fs::is_directory(parent, fault))
    throw InputError("output folder '" + folder.string() + "' cannot be created: '" + parent.string() +
                     "' is no folder");
  if (access(parent.c_str(), W_OK | X_OK) != 0)
    throw InputError("output folder '" + folder.string() + "' cannot be created: '" + parent.string() +
                     "' cannot be written");
}

void ResultFolder::check_links() const {
  for (const fs::path& result : results())
    if (fs::is_symlink(fs::symlink_status(result)))
      throw InputError("output folder '" + folder.string() + "': its '" + result.filename().string() +
                       "' is a link, which is not followed: remove it, or give another --output");
}

void ResultFolder::check_input(const fs::path& input) const {
  std::error_code none;
  const fs::path parent = fs::absolute(input).parent_path();
  bool replaced = is_result(input) && fs::equivalent(parent, folder, none);
  for (const fs::path& result : results()) replaced |= fs::equivalent(input, result, none);
  if (replaced)
    throw InputError("the input '" + input.string() + "' is among the results that --force replaces in '" +
                     folder.string() + "': copy it elsewhere, or give another --output");
}

void ResultFolder::own() {
  ranks.on_first([&] {
    make_output_directory(folder);
    lock();
    if (existing == Existing::refuse && !found().empty()) // made by another run since check()
      throw InputError("output folder '" + folder.string() + "' holds results of another run (" + found() +
                       ")");
    if (shared) return;
    check_links();
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
      if (Temporary::is_one(entry.path())) fs::remove(entry.path());
    if (existing != Existing::replace) return;
    for (const fs::path& result : results()) {
      if (!fs::is_directory(result)) {
        fs::remove(result);
        continue;
      }
      for (const fs::directory_entry& entry : fs::directory_iterator(result))
        if (is_inside(entry.path()) || Temporary::is_one(entry.path())) fs::remove(entry.path());
    }
  });
}

bool ResultFolder::is_inside(const fs::path& file) const {
  const std::string name = (file.parent_path().filename() / file.filename()).string();
  return std::any_of(names.begin(), names.end(), [&](const std::string& pattern) {
    return fnmatch(pattern.c_str(), name.c_str(), FNM_PATHNAME) == 0;
  });
}

} // namespace spall
