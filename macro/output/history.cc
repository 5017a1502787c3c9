#include "macro/output/history.h"

#include "macro/dynamics/body_motion.h"
#include "macro/scene/names.h"
#include "shared/error.h"
#include "shared/input/quantity.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace spall {

double centre_of_mass(const Points& points, const Ranks& ranks) {
  double mass = 0, moment = 0;
  for (std::size_t i = 0; i < points.owned; ++i) {
    mass += points.mass[i];
    moment += points.mass[i] * points.position.component[2][i];
  }
  ranks.reduce({.sums = {&mass, &moment}});
  return moment / mass;
}

namespace {

double kinetic_energy(const Points& points) {
  double energy = 0;
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 v = points.velocity[i];
    energy += 0.5 * points.mass[i] * dot(v, v);
  }
  return energy;
}

using Column = std::pair<std::string, double>;

/// Adds place and attitude of a body.
void add_motion(std::vector<Column>& columns, const std::string& name, const BodyMotion& motion) {
  const Vec3 rotation = rotation_vector(motion.attitude);
  for (int c = 0; c < 3; ++c) columns.emplace_back(key_of(name) + "_" + "xyz"[c], motion.place[c]);
  for (int c = 0; c < 3; ++c) columns.emplace_back(key_of(name) + "_rotation_" + "xyz"[c], rotation[c]);
}

/// Adds energies and state of the reinforcing bars of all bodies. Segments are those of the modelled part.
void add_bars(std::vector<Column>& columns, const Simulation& run, double copies) {
  const Energies& b = run.energies;
  double ruptured = 0, unbonded = 0, slip = 0;
  for (const Reinforcement& bars : run.bodies.reinforcements) {
    ruptured += static_cast<double>(bars.bars().ruptured());
    unbonded += static_cast<double>(bars.unbonded());
    slip = std::max(slip, bars.largest_slip());
  }
  const Column those[] = {{"bar_kinetic_energy", copies * b.bar_kinetic},
                          {"bar_work", copies * b.bar_work},
                          {"bond_work", copies * b.bond_work},
                          {"ruptured_segments", ruptured},
                          {"unbonded_nodes", unbonded},
                          {"largest_slip", slip}};
  columns.insert(columns.end(), std::begin(those), std::end(those));
}

/// Returns the columns of a line in the order of the file.
std::vector<Column> columns(const Simulation& run, const HistorySubject& subject) {
  const Solid& main = *run.bodies.solid(subject.main);
  const Energies& b = run.energies;
  const double copies = main.ghosts.symmetry().multiplicity();
  double position = 0, velocity = 0, moving_kinetic = 0;
  if (subject.moving == subject.main) {
    double mass = 0;
    for (std::size_t i = 0; i < main.points.owned; ++i) mass += main.points.mass[i];
    position = centre_of_mass(main.points, run.ranks());
    velocity = b.solid_momentum[run.bodies.index(subject.main)] / run.ranks().sum(mass);
  } else {
    const BodyMotion motion = motion_of(run.bodies, subject.moving);
    position = motion.front, velocity = motion.speed();
    if (const Solid* moving = run.bodies.solid(subject.moving))
      moving_kinetic = run.ranks().sum(kinetic_energy(moving->points));
  }
  const double kinetic = b.kinetic - moving_kinetic, projectile_kinetic = b.rigid_kinetic + moving_kinetic;
  const double force = run.step > 0 ? run.impulse_given_by(subject.main)[2] / run.step : 0;
  std::vector<Column> line = {
      {"time", run.time},
      {"projectile_position", position},
      {"projectile_velocity", velocity},
      {"contact_force", copies * force},
      {"kinetic_energy", copies * kinetic},
      {"internal_energy", copies * b.internal.total},
      {"stabilization_energy", copies * b.stabilization},
      {"friction_work", copies * b.friction},
      {"contact_work", copies * b.contact},
      {"damping_work", copies * b.damping},
      {"projectile_kinetic_energy", copies * projectile_kinetic},
      {"total_energy", copies * b.total()},
      {"energy_error", b.error()},
      {"momentum", copies * b.points_momentum},
      {"impulse", copies * b.impulse},
      {"support_force", run.step > 0 ? copies * run.exchange.reaction_of_step.impulse[2] / run.step : 0},
      {"support_impulse", copies * run.exchange.reaction_of_run.impulse[2]},
      {"time_step", run.step},
      {"shear_work", copies * b.internal.shear()},
      {"compression_work", copies * b.internal.compression},
      {"tension_work", copies * b.internal.tension},
      {"elastic_shear_energy", copies * b.stored.shear()},
      {"elastic_compression_energy", copies * b.stored.compression},
      {"elastic_tension_energy", copies * b.stored.tension}};
  if (!run.bodies.reinforcements.empty()) add_bars(line, run, copies);
  for (const auto& solid : run.bodies.solids) add_motion(line, solid->label, motion_of(*solid));
  for (const RigidBody& body : run.bodies.rigids)
    if (!body.held()) add_motion(line, body.name, motion_of(body));
  return line;
}

} // namespace

History::History(const std::filesystem::path& directory, HistorySubject subject_, bool go_on,
                 const Ranks& ranks_)
    : path(directory / "history.csv"), subject(std::move(subject_)), ranks(ranks_) {
  if (!go_on) ranks.on_first([this] { file.open(path, 0); });
}

void History::transfer(Archive& archive) {
  if (!archive.loading()) saved_bytes = file.is_open() ? file.size() : 0;
  archive("history_bytes", saved_bytes);
  archive("history_last_step", last_step);
  if (!archive.loading()) return;
  ranks.on_first([&] {
    std::error_code missing;
    const auto present = std::filesystem::file_size(path, missing);
    if (missing || present < saved_bytes)
      throw InputError(path.string() + " is shorter than it was then, or gone");
  });
}

void History::go_on() {
  ranks.on_first([this] { file.open(path, saved_bytes); });
}

void History::write(const Simulation& run) {
  if (run.steps == last_step) return;
  const std::vector<Column> line = columns(run, subject);
  const auto row_of = [&](const auto& text_of) {
    std::string row;
    for (const Column& column : line) row += (&column == &line.front() ? "" : ",") + text_of(column);
    return row + "\n";
  };
  run.ranks().on_first([&] {
    std::string text;
    if (last_step == none) text = row_of([](const Column& column) { return column.first; });
    file.append(text +
                row_of([](const Column& column) { return format_quantity(column.second, Dimension::none); }));
  });
  last_step = run.steps;
}

} // namespace spall
