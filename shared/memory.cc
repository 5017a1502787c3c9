#include "shared/memory.h"

#include "shared/error.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>

namespace spall {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The first number of a file of the system; `otherwise` if there is none.
double number_in(const char* file, double otherwise) {
  double number = 0;
  return std::ifstream(file) >> number ? number : otherwise;
}

/// What the machine can give without taking it from other programs.
double left_on_machine() {
  std::ifstream file("/proc/meminfo");
  for (std::string line; std::getline(file, line);)
    if (double kilobytes = 0;
        line.starts_with("MemAvailable:") && std::istringstream(line.substr(13)) >> kilobytes)
      return 1024 * kilobytes;
  return unlimited;
}

double left_of_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  const double pages = number_in("/proc/self/statm", 0);
  return static_cast<double>(limit.rlim_cur) - pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double left_of_group() {
  return number_in("/sys/fs/cgroup/memory.max", unlimited) - number_in("/sys/fs/cgroup/memory.current", 0);
}

} // namespace

double available_memory() {
  return std::max(0.0, std::min({left_on_machine(), left_of_limit(), left_of_group()}));
}

void require_memory(double bytes, const std::string& what) {
  const double available = available_memory();
  if (!(bytes > available)) return;
  char text[100];
  std::snprintf(text, sizeof text, " need about %.3g GB of memory, allowed: what is left here, %.3g GB",
                1e-9 * bytes, 1e-9 * available);
  throw InputError(what + text);
}

} // namespace spall
