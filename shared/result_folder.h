#pragma once

#include "shared/ranks.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace spall {

/// What a run does with results that its folder holds already.
enum class Existing {
  refuse,  ///< it does not run
  replace, ///< --force: it takes their place
  go_on    ///< --restart: it goes on from them
};

/// The folder that a run writes its results into. It has one owner at a time: the first rank holds a lock on
/// the folder itself (flock), which ends with the process, however that ends, and leaves nothing behind.
/// Results in it are never replaced unless that is asked for. All ranks make the same calls.
class ResultFolder {
public:
  /// @param names of the files and folders that the program writes, and as "folder/name" of the files in
  /// these;
  /// `*` and `?` stand for other characters
  /// @param shared whether other runs that share it may own it too: those that write single files
  ResultFolder(std::filesystem::path path, std::vector<std::string> names, Existing existing,
               const Ranks& ranks = {}, bool shared = false);
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  /// Locks the folder if it is there, and changes nothing. Call it as soon as the input is read.
  /// @param inputs files that the run reads, which it must not replace
  /// @throws InputError: another run owns it, it is no folder, it cannot be written, it holds results that
  /// must not be replaced or are links, or it cannot be made; or an input is among those to be replaced.
  void check(const std::vector<std::filesystem::path>& inputs);
  /// Makes the folder if it is not there, locks it, and removes the files that are to be replaced (of a
  /// shared folder they stay until there are others): what this run does not write must not stand beside what
  /// it does. Call it when nothing else can be wrong with the input. @throws InputError as above
  void own();

  const std::filesystem::path& path() const { return folder; }

private:
  struct Lock;
  bool is_result(const std::filesystem::path& file) const;
  bool is_inside(const std::filesystem::path& file) const;
  std::vector<std::filesystem::path> results() const;
  /// A result that is there; empty if there is none.
  std::string found() const;
  /// Refuses a folder that cannot be made.
  void check_parent() const;
  /// Refuses results that are links: writing would follow them.
  void check_links() const;
  /// Refuses an input that is, under this name or another one, a result that is to be replaced.
  void check_input(const std::filesystem::path& input) const;
  void lock();

  std::filesystem::path folder;
  std::vector<std::string> names;
  Existing existing;
  Ranks ranks;
  bool shared;
  std::unique_ptr<Lock> held;
};

} // namespace spall
