#include "macro/output/momentum_answer.h"

#include "macro/scene/names.h"

#include <algorithm>
#include <cstdio>

namespace spall {

MomentumAnswer::MomentumAnswer(const std::vector<std::string>& bodies, const SceneInputs& scene,
                               const FragmentInputs&, const std::string& file)
    : BodyAnswer(bodies[0]) {
  inputs_of_body(name, scene, file);
}

void MomentumAnswer::measure(const Simulation& run, Warnings&, bool) {
  const std::size_t place = run.bodies.index(body);
  const Solid& solid = *run.bodies.solids[place];
  const Points& points = solid.points;
  const double copies = solid.ghosts.symmetry().multiplicity();
  kinetic_energy = largest_deflection = largest_plastic_strain = 0;
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 v = points.velocity[i];
    kinetic_energy += 0.5 * copies * points.mass[i] * dot(v, v);
    largest_deflection = std::max(largest_deflection,
                                  points.position.component[2][i] - points.initial_position.component[2][i]);
  }
  for (const double strain : solid.field("plastic_strain"))
    largest_plastic_strain = std::max(largest_plastic_strain, strain);
  const Ranks& ranks = run.ranks();
  kinetic_energy = ranks.sum(kinetic_energy);
  largest_deflection = ranks.max(largest_deflection);
  largest_plastic_strain = ranks.max(largest_plastic_strain);
  momentum = copies * run.energies.solid_momentum[place];
  energy = kinetic_energy + copies * run.energies.solid_work[place];
  from.clear();
  for (std::size_t other = 0; other < run.bodies.count(); ++other)
    if (other != place)
      from.emplace_back(run.bodies.name(other), copies * run.exchange.of_run.given(other, place)[2]);
}

void MomentumAnswer::add_to(Summary& summary, const Simulation&, const std::string&) const {
  const auto set = [&](const std::string& key, double value) {
    summary.set(key_of(body) + "_" + key, value);
  };
  set("momentum", momentum);
  for (const auto& [other, given] : from) set("momentum_from_" + key_of(other), given);
  set("kinetic_energy", kinetic_energy);
  set("energy", energy);
  set("max_plastic_strain", largest_plastic_strain);
  set("max_deflection", largest_deflection);
}

std::string MomentumAnswer::in_words() const {
  char text[200];
  std::snprintf(text, sizeof text, "the %s has received %.2f N s along z", body.c_str(), momentum);
  std::string words = text;
  for (const auto& [other, given] : from) {
    std::snprintf(text, sizeof text, ", %.2f N s from the %s", given, other.c_str());
    words += text;
  }
  return words;
}

} // namespace spall
