#pragma once

#include "shared/error.h"

#include <functional>
#include <string>
#include <vector>

namespace spall {

/// Prints one line on standard error that a terminal only shows (visible()).
void print_error(const std::string& program, const std::string& message);

/// Prints what --check says of an input that it has found no fault in.
void print_sound(const std::string& input);

/// Prints a line for each warning on standard error, with the name of the program before it.
void print_warnings(const std::string& program, const std::vector<std::string>& warnings);

/// Opens /dev/null in place of standard input, output and error where they are closed, so that no file that
/// the program opens takes their numbers and gets words. The first call of a program.
/// @return whether standard output was closed
bool hold_standard_streams();

/// True once SIGINT, SIGTERM or SIGHUP has arrived. Long loops test it between steps, save and return
/// ExitCode::interrupted.
bool interrupted();

/// Whether a signal ends the program at once, with a line and ExitCode::interrupted: as long as nothing has
/// been computed that could be saved, such as during the setup of a large model. Not so at first.
void end_at_once_if_interrupted(bool at_once);

/// Runs `body` and returns its exit code; an exception becomes one line on standard error and the exit code
/// that belongs to it. What was written to standard output must have arrived: otherwise a line says so, and
/// success becomes ExitCode::computation_failed.
/// @param speaks false if another process prints the line
int run_program(const std::string& name, const std::function<ExitCode()>& body, bool speaks = true);

} // namespace spall
