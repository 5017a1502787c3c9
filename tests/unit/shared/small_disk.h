#pragma once

#include <sys/resource.h>

#include <csignal>
#include <cstddef>

namespace spall::test {

/// No file may be larger while this is there, as if the disk were full.
class SmallDisk {
public:
  explicit SmallDisk(std::size_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{bytes, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    handler = std::signal(SIGXFSZ, SIG_IGN);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

private:
  rlimit before{};
  void (*handler)(int);
};

} // namespace spall::test
