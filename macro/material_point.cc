// material_point: drives one material point along a strain path.

#include "macro/material/follow_row.h"
#include "macro/material/material_inputs.h"
#include "shared/command_line.h"
#include "shared/output_directory.h"
#include "shared/program.h"
#include "shared/provenance.h"
#include "shared/result_folder.h"
#include "shared/version.h"

#include <cstdio>

namespace {

using namespace spall;

const char* const usage =
    "material_point MATERIAL.prm PATH.csv [--output FILE.csv [--force]] [--check] [Section/Key=value ...]\n"
    "material_point --help [SECTION | KEY]\n"
    "material_point --version\n"
    "Drives one material point along a strain path with the columns time,exx,eyy,ezz,exy,eyz,exz (s; "
    "tension\n"
    "positive, tensor shear; increments between rows are small-strain increments). The output adds sxx..sxz\n"
    "and pressure (Pa), the history variables of the law and energy (work of the stress, J/m3). Without\n"
    "--output it goes to standard output; with it, FILE.csv.prm keeps the inputs of the run. Files that are\n"
    "there are not replaced, unless --force is given; inputs never are.\n"
    "--check reads material and path and says what is wrong with them; it computes and writes nothing.\n"
    "Exit codes: 0 done, 2 bad input and nothing on the disk was changed, 3 computation failed or something\n"
    "could not be written, 130 interrupted: rows so far are kept.\n";

/// One line of the output.
template<MaterialLaw Law> std::string line(double time, const SinglePoint<Law>& point) {
  std::string text = format_quantity(time, Dimension::none);
  const auto add = [&](double value) { text += "," + format_quantity(value, Dimension::none); };
  for (const double value : point.strain) add(value);
  for (const double value : point.stress) add(value);
  add(0 - trace(point.stress) / 3);
  for (const auto& field : Law::fields) add(point.state.*field.value);
  add(point.work);
  return text + "\n";
}

/// Follows the path, appending to `text`, which keeps what was computed if a step fails or the program is
/// interrupted. @return the time of the last row
template<MaterialLaw Law>
double drive(const Law& law, const std::vector<PathRow>& path, const PathOptions& options,
             std::string& text) {
  text = "time,exx,eyy,ezz,exy,eyz,exz,sxx,syy,szz,sxy,syz,sxz,pressure";
  for (const auto& field : Law::fields) text += std::string(",") + field.name;
  text += ",energy\n";
  SinglePoint<Law> point(law, options.spacing > 0 ? options.spacing : 0);
  text += line(path.front().time, point);
  std::size_t row = 1;
  for (; row < path.size() && !interrupted(); ++row) {
    const PathRow step{path[row].time - path[row - 1].time, path[row].strain - path[row - 1].strain};
    try {
      point = follow_row(point, step, options);
    } catch (const ComputationError& error) {
      throw ComputationError("up to time " + format_quantity(path[row].time, Dimension::time) + ": " +
                             error.what());
    }
    text += line(path[row].time, point);
  }
  return path[row - 1].time;
}

ExitCode run(int argc, char** argv, bool stdout_closed) {
  const CommandLine command = parse_command_line(argc, argv, {.force = true});
  const bool to_file = !command.output.empty();

  MaterialInputs inputs;
  PathOptions options;
  Parameters parameters;
  inputs.declare(parameters);
  options.declare(parameters, {[&] { return inputs.needs_spacing(); }, "the law has a damage table"});

  if (command.version) {
    std::printf("material_point %s\n", version);
    return ExitCode::done;
  }
  if (command.help) {
    const std::string keys = parameters.help(command.topic);
    std::printf("%s%s", command.topic.empty() ? usage : "", keys.c_str());
    return ExitCode::done;
  }
  if (command.input.empty() || command.more.size() != 1)
    throw InputError("command line: expected MATERIAL.prm and PATH.csv, see --help");
  if (command.force && !to_file)
    throw InputError("command line: --force replaces the file of --output, which is not given");
  if (!to_file && stdout_closed)
    throw InputError("command line: standard output is closed, the result needs --output FILE.csv");

  parameters.read(command.input, command.overrides);
  inputs.validate(command.input);
  Material material = inputs.material();
  prepare(material, {options.spacing});
  const std::vector<PathRow> path = read_strain_path(command.more.front());
  if (options.lateral == Lateral::stress_free)
    for (const PathRow& row : path)
      if (row.strain[3] != 0 || row.strain[4] != 0 || row.strain[5] != 0)
        throw InputError(command.more.front() + ": found a shear strain at time " +
                         format_quantity(row.time, Dimension::time) +
                         ", allowed: none with Path/Lateral = stress free");
  if (command.check) {
    print_warnings("material_point", parameters.warnings());
    print_sound(command.input);
    return ExitCode::done;
  }
  const std::filesystem::path output = command.output;
  if (to_file && (!output.has_filename() || output.filename() == "." || output.filename() == ".."))
    throw InputError("command line: --output: found '" + command.output + "', allowed: the name of a file");
  ResultFolder folder(output.has_parent_path() ? output.parent_path() : ".",
                      {output.filename(), output.filename().string() + ".prm"},
                      command.force ? Existing::replace : Existing::refuse, {}, true);
  if (to_file) {
    std::vector<std::filesystem::path> files = parameters.files();
    files.emplace_back(command.more.front());
    folder.check(files);
    folder.own();
  }

  print_warnings("material_point", parameters.warnings());

  std::string text;
  const auto write = [&] {
    if (!to_file) {
      std::fputs(text.c_str(), stdout);
      return;
    }
    write_atomically(output, text);
    const Provenance origin = make_provenance("material_point", command.input, parameters.resolved());
    write_atomically(output.string() + ".prm", "# " + origin.program + ", " + origin.created + ": " +
                                                   origin.input_file + " along " + command.more.front() +
                                                   "; results are in SI units\n" + origin.input);
  };
  double end = 0;
  try {
    end = std::visit([&](const auto& law) { return drive(law, path, options, text); }, material);
  } catch (const ComputationError&) {
    write();
    throw;
  }
  write();
  if (end == path.back().time) return ExitCode::done;
  print_error("material_point",
              "interrupted: rows up to time " + format_quantity(end, Dimension::time) + " are kept");
  return ExitCode::interrupted;
}

} // namespace

int main(int argc, char** argv) {
  const bool stdout_closed = spall::hold_standard_streams();
  return spall::run_program("material_point", [&] { return run(argc, argv, stdout_closed); });
}
