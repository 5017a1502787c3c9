#pragma once

#include "tests/unit/shared/scratch_folder.h"
#include "tests/verification/macro/scheme_cases.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace spall::test {

extern Ranks ranks; ///< that mpirun has started; set in main

/// A folder for all ranks, empty at first.
class SharedFolder {
public:
  SharedFolder() {
    if (ranks.first()) own.emplace();
    path =
        ranks.gather(own ? std::vector<std::string>{own->path.string()} : std::vector<std::string>{}).front();
  }
  ~SharedFolder() { ranks.any(false); } // not before all have done with it

  std::filesystem::path path;

private:
  std::optional<ScratchFolder> own;
};

/// The slab of the cases, over all processes.
inline Simulation spread_slab() { return start(slab("slab", false, 0), ranks); }

} // namespace spall::test
