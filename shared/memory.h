#pragma once

#include <string>

namespace spall {

/// Memory that this process can still get, bytes: what the machine has left, within the limits that the
/// process has (RLIMIT_AS, the control group).
double available_memory();

/// Refuses what cannot fit before it is begun: the system would end the program in the middle of it.
/// @param bytes that it needs @param what "the 1e+09 points of the body 'slab'"
/// @throws InputError: what it needs, and what there is
void require_memory(double bytes, const std::string& what);

} // namespace spall
