#include "micro/ensemble/ensemble.h"

#include "micro/ensemble/band.h"
#include "micro/ensemble/samples.h"
#include "micro/output/curve_file.h"
#include "micro/output/energy_report.h"
#include "shared/output_directory.h"
#include "shared/progress.h"
#include "shared/summary.h"
#include "shared/version.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace spall {
namespace fs = std::filesystem;
namespace {

/// Share of failed samples above which no band is computed, because leaving out the failed samples would bias
/// it.
constexpr double tolerated_failures = 0.1;

double peak(const DamageCurve& curve) { return *std::max_element(curve.stress.begin(), curve.stress.end()); }

/// Returns the coefficient of variation: standard deviation over mean.
double variation(const std::vector<double>& values) {
  double mean = 0, square = 0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  for (const double value : values) square += (value - mean) * (value - mean);
  return values.size() > 1 ? std::sqrt(square / static_cast<double>(values.size() - 1)) / mean : 0;
}

/// Writes the tables of the mean and of the band from the samples' tables, and summarises the reference size.
void write_tables(const std::vector<DamageTable>& samples, const MicrocellInputs& inputs,
                  const Provenance& provenance, const fs::path& output, Summary& summary) {
  DamageTable mean = describe_table(inputs, provenance), weak = mean, strong = mean;
  // The modulus of the loading is the same in all samples: energy of the uncracked cell per strain squared.
  const DamageCurve& any = samples.front().curves.front();
  const double modulus = 2 * any.psi_undamaged.back() / (any.strain.back() * any.strain.back());
  EnergyChecks checks;
  for (std::size_t size = 0; size < inputs.sizes.size(); ++size) {
    std::vector<const DamageCurve*> curves;
    std::vector<double> peaks;
    for (const DamageTable& sample : samples) {
      curves.push_back(&sample.curves[size]);
      peaks.push_back(peak(sample.curves[size]));
      checks.include(sample.curves[size]);
    }
    Band band =
        make_band(curves, modulus, inputs.ensemble.band, inputs.stepping.growth, inputs.strength / modulus);
    std::printf("  cells of %8.5g mm: peak %.3f MPa (band %.3f to %.3f, single cells scatter by %.1f %%), "
                "initial damage %.3f (%.3f to %.3f)\n",
                inputs.sizes[size] * 1e3, peak(band.mean) / 1e6, peak(band.weak) / 1e6,
                peak(band.strong) / 1e6, 100 * variation(peaks), band.mean.damage[0], band.strong.damage[0],
                band.weak.damage[0]);
    if (inputs.sizes[size] == inputs.reference_size) {
      write_curve(band.mean, "", output / "curve.csv");
      summary.set("cell_size", inputs.reference_size);
      summary.set("initial_damage", band.mean.damage[0]);
      summary.set("peak_stress", peak(band.mean));
      summary.set("peak_stress_weak", peak(band.weak));
      summary.set("peak_stress_strong", peak(band.strong));
      summary.set("peak_stress_variation", variation(peaks));
    }
    mean.curves.push_back(std::move(band.mean));
    weak.curves.push_back(std::move(band.weak));
    strong.curves.push_back(std::move(band.strong));
  }
  report_energies(checks, inputs.mode.friction > 0, summary);
  char text[60];
  std::snprintf(text, sizeof text, ", quantile %g of the stress", inputs.ensemble.band);
  mean.crack_set += ", mean of " + std::to_string(samples.size()) + " samples";
  weak.crack_set += text;
  std::snprintf(text, sizeof text, ", quantile %g of the stress", 1 - inputs.ensemble.band);
  strong.crack_set += text;
  write_damage_table(weak, output / "damage_table_weak.h5");
  write_damage_table(strong, output / "damage_table_strong.h5");
  write_damage_table(mean, output / "damage_table.h5");
  write_damage_csv(mean, output / "damage_table.csv");
}

} // namespace

ExitCode run_ensemble(const MicrocellInputs& inputs, const Ranks& ranks, const Provenance& provenance,
                      const fs::path& output, bool restart) {
  const Stopwatch stopwatch;
  const fs::path folder = output / "samples";
  ranks.on_first([&] { make_output_directory(folder); });
  ranks.on_first([&] { write_atomically(output / "resolved.prm", provenance.input); });
  const int threads = inputs.ensemble.threads > 0 ? inputs.ensemble.threads : ranks.threads();
  if (ranks.first())
    std::printf("%s: %s, %d samples on %d rank(s) of %d thread(s)\n", provenance.program.c_str(),
                provenance.input_file.c_str(), inputs.ensemble.samples, ranks.count(), threads);
  const SampleReport report = compute_samples(inputs, ranks, threads, provenance, folder, restart);
  const double cpu_seconds = ranks.sum(stopwatch.cpu_seconds()), memory = ranks.sum(peak_memory_bytes());
  if (!ranks.first()) return report.interrupted ? ExitCode::interrupted : ExitCode::done;

  std::vector<DamageTable> samples;
  for (int i = 0; i < inputs.ensemble.samples; ++i)
    if (const fs::path file = sample_file(folder, i); fs::exists(file) && !report.interrupted)
      samples.push_back(read_damage_table(file));

  Summary summary;
  summary.set("program", "microcell");
  summary.set("version", version);
  summary.set("input_file", provenance.input_file);
  summary.set("samples", inputs.ensemble.samples);
  summary.set("samples_computed", report.computed);
  summary.set("samples_reused", report.reused);
  summary.set("samples_failed", report.failures.size());
  summary.set("wall_seconds", stopwatch.seconds());
  summary.set("cpu_seconds", cpu_seconds);
  summary.set("seconds_per_sample", stopwatch.seconds() / std::max(1, report.computed));
  summary.set("peak_memory_bytes", memory);
  summary.set("ranks", ranks.count());
  summary.set("threads", threads);
  for (const std::string& failure : report.failures) std::printf("  failed: %s\n", failure.c_str());
  if (report.interrupted) {
    summary.set("complete", false);
    summary.set("reason", "interrupted");
    summary.write(output / "summary.json");
    std::printf("  interrupted; %d samples are kept, --restart computes the others\n",
                report.computed + report.reused);
    return ExitCode::interrupted;
  }
  if (static_cast<double>(report.failures.size()) > tolerated_failures * inputs.ensemble.samples) {
    summary.set("complete", false);
    summary.set("reason", report.failures.front());
    summary.write(output / "summary.json");
    throw ComputationError(std::to_string(report.failures.size()) + " of " +
                           std::to_string(inputs.ensemble.samples) + " samples failed, first " +
                           report.failures.front());
  }
  write_tables(samples, inputs, provenance, output, summary);
  summary.set("complete", true);
  summary.write(output / "summary.json");
  std::printf("  %d computed, %d reused; results in %s (damage_table.h5, damage_table_weak.h5, "
              "damage_table_strong.h5), %s\n",
              report.computed, report.reused, output.string().c_str(),
              format_duration(stopwatch.seconds()).c_str());
  return ExitCode::done;
}

} // namespace spall
