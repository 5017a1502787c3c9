#pragma once

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define SPALL_THREAD_SANITIZER
#endif
#endif
#if defined(__SANITIZE_THREAD__)
#define SPALL_THREAD_SANITIZER
#endif

#ifdef SPALL_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace spall {

/// Tells the thread sanitizer that a parallel loop starts after what was written before it and ends before
/// what is read after it. The loop's library guarantees both, but it is not built with the sanitizer, which
/// would report every loop without these marks. Two bodies of the same loop stay unordered, so a race between
/// them is still found. Without the sanitizer the four functions are empty.
class ForkJoin {
public:
#ifdef SPALL_THREAD_SANITIZER
  void before_loop() { __tsan_release(&start); }
  void before_bodies() { __tsan_acquire(&start); }
  void after_bodies() { __tsan_release(&end); }
  void after_loop() { __tsan_acquire(&end); }

private:
  char start = 0, end = 0; ///< only their addresses count
#else
  void before_loop() {}
  void before_bodies() {}
  void after_bodies() {}
  void after_loop() {}
#endif
};

} // namespace spall
