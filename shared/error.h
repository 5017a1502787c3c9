#pragma once

#include <stdexcept>
#include <string>

namespace spall {

/// Exit codes of all programs.
enum class ExitCode { done = 0, bad_input = 2, computation_failed = 3, interrupted = 130 };

/// The user's input cannot be used. The message is one line: file, line, key, found, allowed. It is thrown
/// before anything on the disk is changed.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The computation cannot go on. The message says when, where and why; results up to then are kept.
struct ComputationError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Something could not be written. The state that was to be written is as good as before.
struct OutputError : ComputationError {
  using ComputationError::ComputationError;
};

} // namespace spall
