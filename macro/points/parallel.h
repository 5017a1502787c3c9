#pragma once

#include "macro/points/sanitized_loop.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace spall {

/// The parallel loop of this program: calls `body(i)` for every i in [0, count), in any order, on all
/// threads. Bodies write only what belongs to their own i, and sums over i are taken afterwards in order of
/// i, so results do not depend on the number of threads.
template<class Body> void for_each_index(std::size_t count, const Body& body) {
#ifdef SPALL_THREAD_SANITIZER
  for_each_index_sanitized(count, body);
#else
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1),
                    [&body](const tbb::blocked_range<std::size_t>& r) {
                      for (std::size_t i = r.begin(); i != r.end(); ++i) body(i);
                    });
#endif
}

} // namespace spall
