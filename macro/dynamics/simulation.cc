#include "macro/dynamics/simulation.h"

#include "macro/points/parallel.h"
#include "shared/error.h"
#include "shared/traffic.h"

#include <cmath>
#include <numeric>

namespace spall {
namespace {

constexpr std::size_t chunk_size = 1024;

/// Part of the largest stable step that is used when the step factor asks for more: between two estimates the
/// stiffness grows by compression and by the stress, which the estimate leaves out.
constexpr double critical_part = 0.9;

/// Beyond these the run warns, once. Worst of the paper's aluminium bar with NSNI, SNNI, DNI: plastic strain
/// 0.014, 0.054, 0.089; mismatch of volumes 0.005, 0.15, 0.23 (1 % of volume is 220 MPa of pressure in
/// concrete). Energy: sound runs keep it to 0.3 %.
constexpr double rough_strain = 0.03, rough_volume = 0.02, rough_energy = 0.01;

/// Calls part(begin, end) for chunks of the points.
template<class Part> void for_each_chunk(std::size_t count, const Part& part) {
  for_each_index((count + chunk_size - 1) / chunk_size,
                 [&](std::size_t p) { part(p * chunk_size, std::min(count, (p + 1) * chunk_size)); });
}

/// Added up in order of the chunks, so that it does not depend on the number of threads.
Motion motion_of(const Points& points) {
  std::vector<Motion> parts((points.owned + chunk_size - 1) / chunk_size);
  for_each_chunk(points.owned, [&](std::size_t begin, std::size_t end) {
    Motion& part = parts[begin / chunk_size];
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 v = points.velocity[i];
      part.kinetic += 0.5 * points.mass[i] * dot(v, v);
      part.momentum += points.mass[i] * v[2];
    }
  });
  Motion sum;
  for (const Motion& part : parts) sum.kinetic += part.kinetic, sum.momentum += part.momentum;
  return sum;
}

/// Newmark with beta = 0 in velocities at half steps: w' = w + dt (a + (gamma - 1/2)(a - a_last)). Replaces
/// the forces f by f + extra (f - last). Returns the energy that the extra part takes away in a kick.
double add_memory(Points& points, VectorField& last, double extra, double kick) {
  std::vector<double> parts((points.owned + chunk_size - 1) / chunk_size);
  for_each_chunk(points.owned, [&](std::size_t begin, std::size_t end) {
    double work = 0;
    for (int c = 0; c < 3; ++c)
      for (std::size_t i = begin; i < end; ++i) {
        const double force = points.force.component[c][i];
        const double more = extra * (force - last.component[c][i]), all = force + more;
        last.component[c][i] = force;
        points.force.component[c][i] = all;
        work += kick * more * (points.velocity.component[c][i] + 0.5 * kick / points.mass[i] * all);
      }
    parts[begin / chunk_size] = work;
  });
  return -std::accumulate(parts.begin(), parts.end(), 0.0);
}

std::vector<ContactBody> seen_by_contact(const std::vector<std::unique_ptr<Solid>>& solids) {
  std::vector<ContactBody> bodies;
  for (const auto& solid : solids)
    bodies.push_back({&solid->points, &solid->ghosts, solid->bulk_modulus(), solid->shear_modulus(),
                      solid->surface ? &*solid->surface : nullptr});
  return bodies;
}

std::vector<std::unique_ptr<Solid>> list_of(std::unique_ptr<Solid> solid) {
  std::vector<std::unique_ptr<Solid>> list;
  list.push_back(std::move(solid));
  return list;
}

} // namespace

Simulation::Simulation(std::vector<std::unique_ptr<Solid>> solids_, RigidBody body_,
                       const ContactInputs& contact_, const TimeInputs& time_,
                       const IntegrationInputs& integration_)
    : solids(std::move(solids_)), body(body_), freshness(solids.size()), contact(contact_),
      body_contact(contact_), kernel_contact(contact_), inputs(time_), integration(integration_) {
  for (const auto& solid : solids) points_of_all += solid->points.owned;
  points_of_all = static_cast<std::size_t>(ranks().sum(static_cast<double>(points_of_all)));
  for (Freshness& f : freshness) f.since_refresh = integration.refresh_interval;
  const TrafficOf use(MpiUse::setup);
  std::vector<StepReport> reports(solids.size());
  for (std::size_t s = 0; s < solids.size(); ++s) reports[s].motion = motion_of(solids[s]->points);
  put_together(reports);
  book_motion(reports);
  budget.initial_energy = budget.total();
  budget.initial_momentum = budget.momentum;
  given_by_first.resize(solids.size());
  solid_work.resize(solids.size());
  initial_momenta = momenta_of(solids, body);
  if (const Solid* solid = find("projectile")) projectile = mean_motion(*solid);
}

Simulation::Simulation(std::unique_ptr<Solid> solid, RigidBody body_, const ContactInputs& contact_,
                       const TimeInputs& time_, const IntegrationInputs& integration_)
    : Simulation(list_of(std::move(solid)), body_, contact_, time_, integration_) {}

MomentumError Simulation::momentum_error() const {
  return compare(initial_momenta, momenta_of(solids, body), solids.front()->ghosts.symmetry());
}

const Solid* Simulation::find(const std::string& label) const {
  for (const auto& solid : solids)
    if (solid->label == label) return solid.get();
  return nullptr;
}

void Simulation::transfer(Archive& archive) {
  for (const auto& solid : solids) {
    solid->transfer(archive);
    if (archive.loading() && solid->surface) solid->surface->mark(solid->points);
  }
  transfer_record(archive);
  if (culvert && archive.loading()) culvert->find_rim(solids[0]->points);
  if (culvert) culvert->transfer(archive);
  std::uint64_t memories = last_force.size();
  archive("force_memories", memories);
  last_force.resize(memories);
  for (std::size_t s = 0; s < memories; ++s) {
    const std::size_t count = solids[s]->points.owned;
    last_force[s].resize(count);
    archive.pieces(solids[s]->label + "_last_force", (count + block_size - 1) / block_size,
                   [&](std::size_t b, Archive& piece) {
                     Slice part(piece, b * block_size, std::min(count, (b + 1) * block_size), count);
                     last_force[s].transfer(part, "last_force", count);
                   });
  }
}

void Simulation::transfer_record(Archive& archive) {
  body.transfer(archive);
  archive("projectile", projectile);
  archive("initial_momenta", initial_momenta);
  budget.transfer(archive);
  archive("phases", phases);
  archive("time", time);
  archive("step", step);
  for (std::size_t* count :
       {&steps, &refreshes, &refreshed_points, &most_regularized, &most_isolated, &step_reductions})
    archive("counts", *count);
  archive("roughness", roughness);
  for (double* extreme : {&smallest_step_margin, &smallest_moment_fraction, &largest_energy_error,
                          &deepest_overlap, &contact_gap_max, &gap_sum, &gap_count, &largest_factor})
    archive("extremes", *extreme);
  archive("warnings", warnings);
  archive("contact_impulse", contact_impulse);
  archive("given_by_first", given_by_first);
  archive("solid_work", solid_work);
  archive("exit", exit);
  archive("freshness", freshness);
  for (bool* said : {&said_strain, &said_volume, &said_energy, &said_step}) archive("said", *said);
  body_contact.transfer(archive);
  kernel_contact.transfer(archive);
  archive("internal_work", internal_work);
  for (double* work : {&stabilization_work, &late_contact, &late_friction}) archive("work", *work);
}

void Simulation::advance() {
  PhaseTimer timer;
  const double begin = processor_seconds() - seconds_in_mpi();
  double stable_step = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < solids.size(); ++s) {
    refresh_if_needed(*solids[s], freshness[s]);
    stable_step = std::min(stable_step, freshness[s].stable_step);
  }
  const double dt = next_step(stable_step);
  timer.split(phases.refresh);
  std::vector<StepReport> reports(solids.size());
  move(dt, reports, timer);
  for (std::size_t s = 0; s < solids.size(); ++s) reports[s].stresses = solids[s]->update(dt, time + dt);
  timer.split(phases.stresses);
  put_together(reports);
  move_body(dt, reports);
  book_motion(reports);
  book_stresses(reports);
  timer.split(phases.motion);
  if (solids.size() > 1 && contact.scheme == ContactScheme::kernel) add_kernel_forces(dt);
  timer.split(phases.contact);
  time += dt;
  step = dt;
  ++steps;
  follow_projectile();
  ++own_steps;
  computing += processor_seconds() - seconds_in_mpi() - begin;
}

void Simulation::follow_projectile() {
  if (const Solid* solid = find("projectile")) projectile = mean_motion(*solid);
  if (std::isinf(exit.plane) || exit.happened()) return;
  const ProjectileState state = projectile_of(*this);
  if (state.rear > exit.plane && state.speed() > 0) exit.time = time, exit.speed = state.speed();
}

double Simulation::next_step(double stable_step) {
  if (inputs.verify_every > 0 && steps % static_cast<std::size_t>(inputs.verify_every) == 0) {
    const TrafficOf use(MpiUse::looks);
    double critical = std::numeric_limits<double>::infinity();
    for (const auto& solid : solids) critical = std::min(critical, solid->critical_step());
    // In units of h / c, which follows the deformation until the next estimate.
    largest_factor = critical_part * critical / stable_step;
    smallest_step_margin = std::min(smallest_step_margin, critical / (inputs.step_factor * stable_step));
    step_reductions += inputs.step_factor > largest_factor;
    if (inputs.step_factor > largest_factor)
      warn(said_step, "Time/Step factor is too large for the stiffness; steps are shortened to " +
                          std::to_string(largest_factor) + " h / c");
    look_for_defects();
  }
  return std::min(inputs.step_factor, largest_factor) * stable_step / std::sqrt(2 * inputs.gamma);
}

void Simulation::look_for_defects() {
  if (steps == 0) return;
  const TrafficOf use(MpiUse::looks);
  const Roughness now = solids.front()->roughness();
  roughness.plastic_saw_tooth = std::max(roughness.plastic_saw_tooth, now.plastic_saw_tooth);
  roughness.position_saw_tooth = std::max(roughness.position_saw_tooth, now.position_saw_tooth);
  roughness.volume_alternation = std::max(roughness.volume_alternation, now.volume_alternation);
  if (std::abs(now.volume_mismatch) > std::abs(roughness.volume_mismatch))
    roughness.volume_mismatch = now.volume_mismatch;
  if (now.plastic_saw_tooth > rough_strain)
    warn(said_strain, "plastic strain alternates from point to point (rms " +
                          std::to_string(now.plastic_saw_tooth) +
                          "): the integration scheme is not stable enough here");
  if (std::abs(now.volume_mismatch) > rough_volume)
    warn(said_volume, "the volume between the points differs from the integrated one by " +
                          std::to_string(100 * now.volume_mismatch) + " % on average");
}

void Simulation::warn(bool& said, const std::string& text) {
  if (said) return;
  said = true;
  warnings.push_back("t = " + std::to_string(time * 1e6) + " us: " + text);
}

void Simulation::refresh_if_needed(Solid& solid, Freshness& f) {
  if (f.since_refresh < integration.refresh_interval && f.largest_change < integration.refresh_deformation) {
    ++f.since_refresh;
    return;
  }
  const TrafficOf use(MpiUse::refreshes);
  const RefreshReport report = solid.refresh({integration.least_deformation, integration.most_skipped});
  refreshed_points += report.rebuilt;
  most_regularized = std::max(most_regularized, report.regularized);
  most_isolated = std::max(most_isolated, report.isolated);
  smallest_moment_fraction = std::min(smallest_moment_fraction, report.smallest_fraction);
  if (!(report.stable_step > 0) || !std::isfinite(report.stable_step))
    throw ComputationError("t = " + std::to_string(time * 1e6) + " us: the stable time step is " +
                           std::to_string(report.stable_step) + " s");
  f = {.stable_step = report.stable_step, .largest_change = 0, .since_refresh = 1};
  ++refreshes;
}

void Simulation::StepReport::list(Reduction& of_ranks) {
  contact.list(of_ranks);
  stresses.list(of_ranks);
  for (double* sum : {&damping, &motion.kinetic, &motion.momentum}) of_ranks.sums.push_back(sum);
}

void Simulation::put_together(std::vector<StepReport>& reports) {
  std::vector<std::string> failures;
  for (const StepReport& report : reports)
    if (!report.stresses.failure.empty()) failures.push_back(report.stresses.failure);
  double failed = !failures.empty();
  const TrafficOf use(MpiUse::reductions);
  Reduction all{.largest = {&failed, &request}};
  for (StepReport& report : reports) report.list(all);
  ranks().reduce(all);
  if (failed > 0) throw ComputationError(ranks().gather(failures).front());
}

void Simulation::move(double dt, std::vector<StepReport>& reports, PhaseTimer& timer) {
  const double half = 0.5 * (step + dt); // from the middle of the last step to the middle of this one
  kick(half, reports);
  timer.split(phases.motion);
  touch(dt, half, reports);
  timer.split(phases.contact);
  for (std::size_t s = 0; s < solids.size(); ++s) {
    Points& points = solids[s]->points;
    for_each_chunk(points.owned, [&](std::size_t begin, std::size_t end) {
      for (int c = 0; c < 3; ++c)
        for (std::size_t i = begin; i < end; ++i)
          points.position.component[c][i] += dt * points.velocity.component[c][i];
    });
    reports[s].motion = motion_of(points);
  }
  if (culvert) culvert->move(dt);
  timer.split(phases.motion);
}

void Simulation::kick(double duration, std::vector<StepReport>& reports) {
  const double extra = inputs.gamma - 0.5;
  if (extra > 0 && last_force.empty())
    for (const auto& solid : solids) last_force.push_back(solid->points.force);
  for (std::size_t s = 0; s < solids.size(); ++s) {
    Points& points = solids[s]->points;
    if (extra > 0) reports[s].damping = add_memory(points, last_force[s], extra, duration);
    for_each_chunk(points.owned, [&](std::size_t begin, std::size_t end) {
      for (int c = 0; c < 3; ++c)
        for (std::size_t i = begin; i < end; ++i)
          points.velocity.component[c][i] += duration / points.mass[i] * points.force.component[c][i];
    });
  }
}

template<class Report> void Simulation::book_contact(const Report& report) {
  budget.friction += report.friction_loss;
  budget.contact += report.normal_loss;
  deepest_overlap = std::max(deepest_overlap, report.deepest);
  gap_sum += report.gap_sum;
  gap_count += static_cast<double>(report.touching);
  contact_gap_max = std::max(contact_gap_max, report.gap_max);
}

void Simulation::touch(double dt, double kick, std::vector<StepReport>& reports) {
  contact_impulse = {};
  if (culvert) budget.contact += culvert->apply(solids[0]->points, dt, kick);
  for (std::size_t s = 0; s < solids.size(); ++s) {
    reports[s].contact = push_points(solids[s]->points, body, contact, dt, kick);
  }
  if (solids.size() < 2 || contact.scheme != ContactScheme::surface) return;
  const std::vector<ContactBody> bodies = seen_by_contact(solids);
  {
    const TrafficOf use(MpiUse::contact);
    zone.gather(bodies, BodyContact::margin);
  }
  const BodyContactReport report = body_contact.apply(zone.bodies(), dt, kick);
  zone.give_back(bodies);
  book_contact(report);
  count_impulses(report);
}

void Simulation::move_body(double dt, const std::vector<StepReport>& reports) {
  ContactReport sum;
  for (const StepReport& report : reports) {
    sum += report.contact;
    budget.impulse -= report.contact.impulse[2];
  }
  push_body(body, sum);
  book_contact(sum);
  contact_impulse = add(contact_impulse, 1, reports.front().contact.impulse);
  body.move(dt);
}

void Simulation::count_impulses(const BodyContactReport& report) {
  contact_impulse = add(contact_impulse, -1, report.impulse[0]);
  for (std::size_t s = 0; s < solids.size(); ++s)
    given_by_first[s] = add(given_by_first[s], 1, report.from_first[s]);
}

void Simulation::add_kernel_forces(double dt) {
  const std::vector<ContactBody> bodies = seen_by_contact(solids);
  {
    const TrafficOf use(MpiUse::contact);
    zone.gather(bodies, KernelContact::margin);
  }
  const BodyContactReport report = kernel_contact.add_forces(zone.bodies(), dt);
  zone.give_back(bodies);
  count_impulses(report);
  // As with the stresses, half of the work belongs to the velocities of this step, half to the next ones.
  budget.contact += late_contact + 0.5 * report.normal_loss;
  budget.friction += late_friction + 0.5 * report.friction_loss;
  late_contact = 0.5 * report.normal_loss, late_friction = 0.5 * report.friction_loss;
  if (report.touching == 0) return;
  const BodyContactReport gap = body_contact.measure(zone.bodies());
  gap_sum += gap.gap_sum;
  gap_count += static_cast<double>(gap.touching);
  contact_gap_max = std::max(contact_gap_max, gap.gap_max);
  deepest_overlap = std::max(deepest_overlap, gap.deepest);
}

void Simulation::book_motion(const std::vector<StepReport>& reports) {
  budget.kinetic = budget.points_momentum = 0;
  budget.solid_momentum.clear();
  for (const StepReport& report : reports) {
    budget.damping += report.damping;
    budget.kinetic += report.motion.kinetic;
    budget.points_momentum += report.motion.momentum;
    budget.solid_momentum.push_back(report.motion.momentum);
  }
  budget.body_kinetic = body.kinetic_energy();
  if (culvert) budget.culvert = culvert->kinetic_energy() + culvert->work();
  budget.momentum = budget.points_momentum + (body.held() ? 0 : body.mass * body.velocity[2]);
}

void Simulation::book_stresses(const std::vector<StepReport>& reports) {
  SolidReport sum;
  for (std::size_t s = 0; s < solids.size(); ++s) {
    const SolidReport& report = reports[s].stresses;
    sum.work += report.work;
    solid_work[s] += report.work.total + report.stabilization_work;
    sum.stabilization_work += report.stabilization_work;
    freshness[s].largest_change = std::max(freshness[s].largest_change, report.largest_change);
  }
  // The kinetic energy is that of the middle of the step, where half of the step's work has been done.
  budget.internal = internal_work;
  budget.internal += 0.5 * sum.work;
  budget.stabilization = stabilization_work + 0.5 * sum.stabilization_work;
  internal_work += sum.work;
  stabilization_work += sum.stabilization_work;
  largest_energy_error = std::max(largest_energy_error, std::abs(budget.error()));
  if (largest_energy_error > rough_energy)
    warn(said_energy, "the energy error has grown to " + std::to_string(100 * budget.error()) + " %");
}

} // namespace spall
