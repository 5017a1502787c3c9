#pragma once

#include "shared/archive.h"
#include "shared/provenance.h"
#include "shared/ranks.h"

#include <filesystem>
#include <functional>
#include <string>

namespace spall {

/// The newest two checkpoints of a run, `checkpoint.h5` and `checkpoint_previous.h5` in its folder: the whole
/// state, from which the run goes on bit for bit as if it had not been stopped, on as many ranks. Ranks write
/// their parts into the file in turn.
///
/// Rows of gradients are saved as they are (about 1.5 kB of the 2 kB per point): each block's rows belong to
/// the positions, of its points and of their neighbours, at its own last refresh, which are gone; a refresh
/// after loading would give the rows of the present positions, and another run.
class Checkpoints {
public:
  /// @param provenance of the run: its input decides which checkpoints belong to it
  /// @param ranks of the run: all call what follows together, and each saves and loads its own part
  Checkpoints(std::filesystem::path directory, Provenance provenance, const Ranks& ranks = {});

  /// Writes the newest one beside the older two, then lets it take its place: whatever happens, a whole
  /// checkpoint is left. `transfer` is called twice, first to count.
  /// @throws ComputationError if it cannot be written; the older ones are untouched.
  void write(const std::function<void(Archive&)>& transfer) const;

  /// Finds the newest one that is whole, of this format and of this input, and says on standard error what is
  /// wrong with those it refuses. @return false if there is none at all.
  /// @throws InputError if there are some, but none can be used.
  bool find();
  /// Loads the one found. @throws InputError if its contents are not what this program wants.
  void load(const std::function<void(Archive&)>& transfer) const;
  const std::filesystem::path& found() const { return chosen; }

  /// Removes all: a new run begins.
  void remove() const;

private:
  /// What is wrong with a checkpoint, empty if nothing.
  std::string fault(const std::filesystem::path& file) const;
  /// The file with its description; the states of the ranks are still to come.
  void begin(const std::filesystem::path& part, double bytes) const;
  /// Lets the whole file take its place.
  void finish(const std::filesystem::path& part) const;
  bool find_on_first();

  std::filesystem::path newest, previous, chosen;
  Provenance provenance;
  Ranks ranks;
};

/// The part of a resolved input that decides the state of a run at a given time: all but the sections Output
/// and Run, and the end time.
std::string deciding_input(const std::string& resolved);

} // namespace spall
