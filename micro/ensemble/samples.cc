#include "micro/ensemble/samples.h"

#include "micro/cell_problem.h"
#include "shared/error.h"
#include "shared/input/text_file.h"
#include "shared/program.h"
#include "shared/progress.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <mutex>
#include <sstream>
#include <thread>

namespace spall {
namespace fs = std::filesystem;
namespace {

/// Computes the damage table of one random cell at all its sizes. @throws ComputationError,
/// std::invalid_argument
template<int dim> DamageTable compute_sample(const MicrocellInputs& inputs, const Provenance& provenance) {
  Solid<dim> solid = make_solid<dim>(inputs, inputs.sizes.front());
  SteppingSettings stepping = inputs.stepping;
  stepping.every_eigenvalue = false; // the samples' files do not hold them
  DamageTable table = describe_table(inputs, provenance);
  for (const double size : inputs.sizes) {
    if (inputs.aggregates.present() && size != inputs.sizes.front()) solid = make_solid<dim>(inputs, size);
    const CellProblem<dim> cell(inputs, solid, size);
    const CurveTrace<dim> trace = cell.trace(stepping, [](const DamageCurve&) { return !interrupted(); });
    if (!trace.complete()) throw ComputationError(trace.failure);
    table.curves.push_back(envelope(trace.curve));
  }
  return table;
}

/// Returns all recorded inputs that determine a sample's results: program, input and seed, without the keys
/// that only concern the number of samples, threads and outputs.
std::string signature(const Provenance& provenance) {
  std::istringstream lines(provenance.input);
  std::string text = provenance.program + "\n";
  for (std::string line; std::getline(lines, line);) {
    const bool irrelevant =
        line.find("set Samples") != std::string::npos || line.find("set Threads") != std::string::npos ||
        line.find("set Band") != std::string::npos || line.find("set Field states") != std::string::npos;
    if (!irrelevant) text += line + "\n";
  }
  return text;
}

/// The provenance of sample i.
Provenance of_sample(const MicrocellInputs& inputs, Provenance provenance, int i) {
  provenance.input += "\n# Cracks/Seed of this sample: " + std::to_string(inputs.ensemble.seed + i) + "\n";
  return provenance;
}

/// Whether a file is a whole sample of this origin. One that is damaged is none: it is computed again.
bool is_sample(const fs::path& file, const Provenance& origin) {
  try {
    return fs::exists(file) && signature(read_damage_table(file).provenance) == signature(origin);
  } catch (const InputError&) {
    return false;
  }
}

} // namespace

bool has_samples(const MicrocellInputs& inputs, const Provenance& provenance, const fs::path& folder) {
  for (int i = 0; i < inputs.ensemble.samples; ++i) {
    if (is_sample(sample_file(folder, i), of_sample(inputs, provenance, i))) return true;
  }
  return false;
}

namespace {

/// The text of a file, empty if it cannot be read.
std::string text_of(const fs::path& file) {
  try {
    return read_text_file(file);
  } catch (const InputError&) {
    return "";
  }
}

} // namespace

bool holds_input(const Provenance& provenance, const fs::path& output) {
  return text_of(output / "resolved.prm") == provenance.input;
}

bool is_finished(const MicrocellInputs& inputs, const Provenance& provenance, const fs::path& output) {
  for (int i = 0; i < inputs.ensemble.samples; ++i)
    if (!is_sample(sample_file(output / "samples", i), of_sample(inputs, provenance, i))) return false;
  return holds_input(provenance, output) && fs::exists(output / "damage_table.h5") &&
         text_of(output / "summary.json").find("\"complete\": true") != std::string::npos;
}

fs::path sample_file(const fs::path& folder, int sample) {
  char name[40];
  std::snprintf(name, sizeof name, "sample_%06d.h5", sample);
  return folder / name;
}

DamageTable describe_table(const MicrocellInputs& inputs, const Provenance& provenance) {
  DamageTable table;
  table.youngs_modulus = inputs.youngs_modulus;
  table.poisson_ratio = inputs.poisson_ratio;
  table.tensile_strength = inputs.strength;
  table.fracture_energy = inputs.fracture_energy;
  for (const auto& [word, softening] : softening_words())
    if (softening == inputs.softening) table.softening = word;
  table.crack_set = inputs.describe_cracks();
  for (const auto& [word, boundary] : boundary_words())
    if (boundary == inputs.boundary) table.boundary = word;
  table.loading = inputs.describe_loading();
  table.provenance = provenance;
  return table;
}

SampleReport compute_samples(const MicrocellInputs& inputs, const Ranks& ranks, int threads,
                             const Provenance& provenance, const fs::path& folder, bool reuse) {
  SampleReport report;
  const int samples = inputs.ensemble.samples, mine = (samples - ranks.rank() - 1) / ranks.count() + 1;
  std::atomic<int> next = ranks.rank();
  std::mutex files; // HDF5 and the report are not thread-safe
  Progress progress;
  const auto next_sample = [&] { return next.fetch_add(ranks.count()); };
  const auto work = [&] {
    for (int i = next_sample(); i < samples && !interrupted(); i = next_sample()) {
      MicrocellInputs sample = inputs;
      sample.geometry.random.seed = inputs.ensemble.seed + i;
      const fs::path file = sample_file(folder, i);
      const Provenance origin = of_sample(inputs, provenance, i);
      try {
        if (const std::lock_guard lock(files); reuse && is_sample(file, origin)) {
          ++report.reused;
          continue;
        }
        const DamageTable table =
            sample.dimension == 3 ? compute_sample<3>(sample, origin) : compute_sample<2>(sample, origin);
        const std::lock_guard lock(files);
        write_damage_table(table, file);
        ++report.computed;
        if (ranks.first() && progress.due()) {
          std::string text =
              std::to_string(report.computed + report.reused) + " of " + std::to_string(mine) + " samples";
          if (ranks.count() > 1) text += " of this rank, the first of " + std::to_string(ranks.count());
          progress.show(text);
        }
      } catch (const std::exception& error) {
        if (interrupted()) break;
        const std::lock_guard lock(files);
        std::error_code ignored;
        fs::remove(file, ignored); // a file of an earlier run would be out of date
        report.failures.push_back("seed " + std::to_string(sample.geometry.random.seed) + ": " +
                                  error.what());
      }
    }
  };
  std::vector<std::thread> workers;
  for (int t = 1; t < std::min(threads, mine); ++t) workers.emplace_back(work);
  work();
  for (std::thread& worker : workers) worker.join();
  report.computed = static_cast<int>(ranks.sum(report.computed));
  report.reused = static_cast<int>(ranks.sum(report.reused));
  report.failures = ranks.gather(report.failures);
  std::sort(report.failures.begin(), report.failures.end());
  report.interrupted = ranks.any(interrupted());
  return report;
}

} // namespace spall
