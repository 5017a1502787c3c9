#pragma once

#include "macro/points/fork_join.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace spall {

/// The parallel loop of this program: calls `body(i)` for every i in [0, count), in any order, on all
/// threads. Bodies write only what belongs to their own i, and sums over i are taken afterwards in order of
/// i, so results do not depend on the number of threads.
template<class Body> void for_each_index(std::size_t count, const Body& body) {
  ForkJoin order;
  order.before_loop();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1),
                    [&body, &order](const tbb::blocked_range<std::size_t>& r) {
                      order.before_bodies();
                      for (std::size_t i = r.begin(); i != r.end(); ++i) body(i);
                      order.after_bodies();
                    });
  order.after_loop();
}

} // namespace spall
