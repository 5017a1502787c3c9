#pragma once

#include "shared/error.h"

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace spall::test {

/// The bytes of a fuzzer as a file of this process, in memory where there is a file system for it.
inline std::filesystem::path as_file(const std::uint8_t* data, std::size_t size, const std::string& ending) {
  static const std::filesystem::path folder = [] {
    const std::filesystem::path memory = "/dev/shm";
    const auto place = (access(memory.c_str(), W_OK) == 0 ? memory : std::filesystem::temp_directory_path()) /
                       ("spall_fuzz_" + std::to_string(getpid()));
    std::filesystem::create_directory(place);
    std::atexit([] { std::filesystem::remove_all("/dev/shm/spall_fuzz_" + std::to_string(getpid())); });
    return place;
  }();
  const std::filesystem::path file = folder / ("input" + ending);
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return file;
}

/// Runs what reads hostile bytes. It may refuse them; what else it throws ends the fuzzer.
template<class Read> int only_refuses(const Read& read) {
  try {
    read();
  } catch (const InputError&) { // the contract
  }
  return 0;
}

} // namespace spall::test
