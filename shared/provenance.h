#pragma once

#include <string>

namespace spall {

/// Origin of a result: program, version, time and the full resolved input.
struct Provenance {
  std::string program;    ///< "microcell 0.1.0"
  std::string input_file; ///< as given on the command line
  std::string created;    ///< UTC, ISO 8601
  std::string input;      ///< every key with its resolved value
};

Provenance make_provenance(const std::string& program, const std::string& input_file,
                           const std::string& input);

/// Largest resident memory of this process so far, bytes.
double peak_memory_bytes();

} // namespace spall
