#include "macro/output/run_summary.h"

#include "macro/output/rank_report.h"
#include "shared/progress.h"
#include "shared/version.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace spall {
namespace {

double point_steps(const Simulation& run) { return static_cast<double>(run.point_count() * run.steps); }

double bytes_per_point(const Simulation& run, const RunRecord& record) {
  return record.model_bytes / static_cast<double>(run.point_count());
}

void add_identity(Summary& s, const Simulation& run, const SceneInputs& scene, const RunRecord& record,
                  const Answers& answers) {
  s.set("program", "penetrate");
  s.set("version", version);
  s.set("input_file", record.provenance.input_file);
  s.set("created", record.provenance.created);
  s.set("ended", record.ended);
  std::string names;
  for (const BodyInputs& body : scene.bodies)
    if (scene.find(body.name)) names += (names.empty() ? "" : ", ") + body.name;
  s.set("bodies", names);
  s.set("main_body", answers.main_body());
  const MaterialInputs& material = scene.find(answers.main_body())->material;
  s.set("material", material.law());
  for (const auto& [key, value] : material.describe()) s.set(key, value);
  s.set("scheme", record.scheme);
  if (run.bodies.solids.size() > 1) s.set("contact_scheme", scene.contact.law);
  s.set("points", run.point_count());
  s.set("points_whole_body", static_cast<double>(run.point_count()) * scene.planes().multiplicity());
  const auto [finest, coarsest] = spacings_of(*run.bodies.solid(answers.main_body()));
  s.set("spacing", finest);
  s.set("largest_spacing", coarsest);
}

void add_cost(Summary& s, const Simulation& run, const RunRecord& record) {
  s.set("steps", run.steps);
  s.set("refreshes", run.health.refreshes);
  s.set("refreshed_points", run.health.refreshed_points);
  s.set("simulated_time", run.time);
  s.set("wall_seconds", record.wall);
  s.set("cpu_seconds", record.processor);
  s.set("points_steps_per_second", record.wall > 0 ? point_steps(run) / record.wall : 0.0);
  s.set("seconds_setup", record.setup);
  s.set("seconds_refresh", run.phases.refresh);
  s.set("seconds_stresses", run.phases.stresses);
  s.set("seconds_contact", run.phases.contact);
  s.set("seconds_motion", run.phases.motion);
  s.set("seconds_output", record.output);
  s.set("restarts", record.restarts);
  s.set("peak_memory_bytes", peak_memory_bytes());
  s.set("model_memory_bytes", record.model_bytes);
  s.set("bytes_per_point", bytes_per_point(run, record));
  s.set("ranks", record.ranks);
  s.set("load_imbalance", record.imbalance);
  s.set("rebalances", record.rebalances);
  RankReport(run).add_to(s);
  s.set("threads",
        static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)));
}

void add_balances(Summary& s, const Simulation& run) {
  const Energies& b = run.energies;
  s.set("energy_balance_error", std::abs(b.error()));
  const double change = b.momentum - b.initial_momentum - run.exchange.reaction_of_run.impulse[2];
  // A fixed wall absorbs momentum without bound; then the change of momentum is compared with the impulse.
  const auto& rigids = run.bodies.rigids;
  const bool held =
      std::all_of(rigids.begin(), rigids.end(), [](const RigidBody& body) { return body.held(); });
  const double unbalanced = held ? change - b.impulse : change;
  s.set("momentum_balance_error",
        std::abs(unbalanced / (std::abs(b.impulse) > 0 ? b.impulse : b.initial_momentum)));
  const auto part = [&b](double energy) { return b.initial > 0 ? energy / b.initial : 0.0; };
  s.set("stabilization_work_fraction", part(b.stabilization));
  s.set("friction_loss_fraction", part(b.friction));
  s.set("contact_loss_fraction", part(b.contact));
  s.set("damping_loss_fraction", part(b.damping));
  s.set("largest_energy_error", run.health.largest_energy_error);
  s.set("energy_created_fraction", run.health.energy_created);
}

/// Warnings of the run, then those of its evaluation.
Warnings all_warnings(const Simulation& run, const RunRecord& record) {
  Warnings all = run.health.warnings;
  all.insert(all.end(), record.warnings.begin(), record.warnings.end());
  return all;
}

/// The reinforcing bars of all bodies: how much steel there is in the whole bodies, and what has become of
/// the modelled part.
void add_bars(Summary& s, const Simulation& run, const SceneInputs& scene) {
  if (run.bodies.reinforcements.empty()) return;
  double mass = 0, slip = 0, strain = 0;
  std::size_t segments = 0, ruptured = 0, unbonded = 0;
  for (const Reinforcement& bars : run.bodies.reinforcements) {
    mass += bars.mass();
    segments += bars.bars().segments().size();
    ruptured += bars.bars().ruptured();
    unbonded += bars.unbonded();
    slip = std::max(slip, bars.largest_slip());
    for (const auto& segment : bars.bars().segments()) strain = std::max(strain, segment.steel.accumulated);
  }
  const auto part = [&run](double energy) {
    return run.energies.initial > 0 ? energy / run.energies.initial : 0.0;
  };
  s.set("bar_mass", mass * scene.planes().multiplicity());
  s.set("bar_segments", segments);
  s.set("bar_segments_ruptured", ruptured);
  s.set("bar_nodes_unbonded", unbonded);
  s.set("bar_largest_plastic_strain", strain);
  s.set("bar_largest_slip", slip);
  s.set("bar_work_fraction", part(run.energies.bar_work));
  s.set("bond_work_fraction", part(run.energies.bond_work));
}

void add_health(Summary& s, const Simulation& run, const RunRecord& record, const std::string& main_body) {
  const HourglassIndicators& hourglass = run.health.hourglass[run.bodies.index(main_body)];
  s.set("smallest_step_margin", run.health.smallest_step_margin);
  s.set("step_reductions", run.health.step_reductions);
  s.set("plastic_strain_saw_tooth", hourglass.plastic_saw_tooth);
  s.set("position_saw_tooth", hourglass.position_saw_tooth);
  s.set("volume_mismatch", hourglass.volume_mismatch);
  s.set("volume_alternation", hourglass.volume_alternation);
  s.set("smallest_moment_fraction", run.health.smallest_moment_fraction);
  std::string warnings;
  for (const std::string& warning : all_warnings(run, record))
    warnings += (warnings.empty() ? "" : "; ") + warning;
  s.set("warnings", warnings);
  s.set("most_regularized_points", run.health.most_regularized);
  s.set("most_isolated_points", run.health.most_isolated);
  s.set("deepest_overlap", run.exchange.deepest_overlap);
  s.set("contact_gap_mean", run.exchange.mean_gap());
  s.set("contact_gap_max", run.exchange.gap_max);
}

} // namespace

Summary summarize(const Simulation& run, const SceneInputs& scene, const RunRecord& record,
                  const Answers& answers, bool answered) {
  Summary s;
  add_identity(s, run, scene, record, answers);
  add_cost(s, run, record);
  add_balances(s, run);
  add_bars(s, run, scene);
  add_health(s, run, record, answers.main_body());
  if (answered) answers.add_to(s, run);
  return s;
}

void print_result(const Simulation& run, const RunRecord& record, const Answers& answers) {
  for (const std::string& warning : all_warnings(run, record)) std::printf("warning: %s\n", warning.c_str());
  if (!answers.empty()) std::printf("%s\n", answers.in_words().c_str());
  std::printf("%zu steps to t = %.1f us in %s, %.2f M point-steps/s, energy error %.2e\n", run.steps,
              run.time * 1e6, format_duration(record.wall).c_str(),
              1e-6 * point_steps(run) / std::max(record.wall, 1e-9), run.energies.error());
  const PhaseTimes& p = run.phases;
  std::printf("setup %.2f s, refresh %.2f s, stresses %.2f s, contact %.2f s, motion %.2f s, output %.2f s; "
              "%.0f bytes per point\n",
              record.setup, p.refresh, p.stresses, p.contact, p.motion, record.output,
              bytes_per_point(run, record));
}

} // namespace spall
