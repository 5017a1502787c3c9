#include "shared/provenance.h"

#include "shared/version.h"

#include <sys/resource.h>

#include <array>
#include <ctime>

namespace spall {

Provenance make_provenance(const std::string& program, const std::string& input_file,
                           const std::string& input) {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return {program + " " + version, input_file, text.data(), input};
}

double peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss); // Linux counts in KiB
}

} // namespace spall
