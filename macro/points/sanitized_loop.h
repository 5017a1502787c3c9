#pragma once

// SPALL_THREAD_SANITIZER is defined where the compiler instruments the code for the thread sanitizer.
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define SPALL_THREAD_SANITIZER
#endif
#endif
#ifdef __SANITIZE_THREAD__
#define SPALL_THREAD_SANITIZER
#endif

#ifdef SPALL_THREAD_SANITIZER

#include <tbb/global_control.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace spall {

/// The parallel loop under the thread sanitizer: calls `body(i)` for every i in [0, count) on threads of its
/// own. TBB's library is not built with the sanitizer, which therefore does not see that a loop starts after
/// what was written before it and ends before what is read after it, and would report every loop. The start
/// and the end of these threads it does see. Two bodies are unordered, so a race between them is found,
/// whichever thread runs them. An exception of a body is thrown again once all threads have ended.
template<class Body> void for_each_index_sanitized(std::size_t count, const Body& body) {
  const std::size_t threads =
      std::min(count, tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  std::mutex failing;
  std::exception_ptr failure;
  const auto work = [&](std::size_t first) {
    try {
      // Every thread has its share, however late it starts, so that what is found does not depend on luck.
      for (std::size_t i = first; i < count; i += threads) body(i);
    } catch (...) {
      const std::lock_guard lock(failing);
      failure = std::current_exception();
    }
  };
  std::vector<std::thread> others;
  for (std::size_t t = 1; t < threads; ++t) others.emplace_back(work, t);
  work(0);
  for (std::thread& other : others) other.join();
  if (failure) std::rethrow_exception(failure);
}

} // namespace spall

#endif
