#pragma once

#include "shared/archive.h"
#include "shared/provenance.h"
#include "shared/ranks.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace spall {

class Hdf5File;

/// The newest two checkpoints of a run, `checkpoint.h5` and `checkpoint_previous.h5` in its folder: the whole
/// state, from which the run goes on as if it had not been stopped: bit for bit on as many ranks, within
/// round-off on more or fewer. All ranks write into the file together.
///
/// Rows of gradients are saved as they are (about 1.5 kB of the 2 kB per point): each block's rows belong to
/// the positions, of its points and of their neighbours, at its own last refresh, which are gone; a refresh
/// after loading would give the rows of the present positions, and another run. Blocks are the same however
/// many ranks share them, and name the points that they touch by numbers through all ranks.
class Checkpoints {
public:
  /// @param provenance of the run: its input decides which checkpoints belong to it
  /// @param inputs files beside the scene that the run has read, such as a damage table: so does their
  /// content
  /// @param ranks of the run: all call what follows together, and each saves and loads its own points
  Checkpoints(std::filesystem::path directory, Provenance provenance,
              const std::vector<std::filesystem::path>& inputs = {}, const Ranks& ranks = {});

  /// Writes the newest one beside the older two, then lets it take its place: whatever happens, a whole
  /// checkpoint is left. `transfer` is called twice, first to count.
  /// @throws OutputError if it cannot be written; the older ones are untouched.
  void write(const std::function<void(Archive&)>& transfer) const;

  /// Finds the newest one that is whole, of this format and of this input, and says on standard error what is
  /// wrong with those it refuses. @return false if there is none at all.
  /// @throws InputError if there are some, but none can be used.
  bool find();
  /// Loads the one found. @throws InputError if its contents are not what this program wants.
  void load(const std::function<void(Archive&)>& transfer) const;
  const std::filesystem::path& found() const { return chosen; }

private:
  /// In what a checkpoint is not one of this run, empty if in nothing.
  std::string foreign(const std::filesystem::path& file) const;
  void describe(Hdf5File& file) const;
  /// Lets the newest one take the place of the one before.
  void keep_previous() const;

  std::filesystem::path newest, previous, chosen;
  Provenance provenance;
  std::string files; ///< what the run has read, with checksums
  Ranks ranks;
};

/// The part of a resolved input that decides the state of a run at a given time: all but the sections Output
/// and Run, and the end time.
std::string deciding_input(const std::string& resolved);

} // namespace spall
