#pragma once

#include "tests/unit/shared/scratch_folder.h"
#include "tests/verification/macro/scheme_cases.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace spall::test {

extern Ranks ranks; ///< the ranks that mpirun has started; set in main

/// A folder that all ranks share, empty at first.
class SharedFolder {
public:
  SharedFolder() {
    if (ranks.first()) own.emplace();
    path =
        ranks.gather(own ? std::vector<std::string>{own->path.string()} : std::vector<std::string>{}).front();
  }
  ~SharedFolder() { ranks.any(false); } // waits until all ranks have finished with it

  std::filesystem::path path;

private:
  std::optional<ScratchFolder> own;
};

/// Makes the slab of the cases, distributed over all processes.
inline Simulation spread_slab() { return start(slab("slab", false, 0), ranks); }

} // namespace spall::test
