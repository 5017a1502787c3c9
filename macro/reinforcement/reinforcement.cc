#include "macro/reinforcement/reinforcement.h"

#include <algorithm>
#include <cmath>

namespace spall {
namespace {

/// Part of the largest stable step that is used, as for the points (StepSize).
constexpr double critical_part = 0.9;

/// A vector across the bar stays across it, and as long, when the bar turns.
Vec3 turned_across(const Vec3& across, const Vec3& before, const Vec3& now) {
  const double size = norm(across);
  if (!(size > 0)) return {};
  // The smallest rotation that takes one direction to the other.
  const Vec3 axis = cross(before, now);
  const double cosine = dot(before, now);
  Vec3 turned = cosine > -0.5
                    ? cosine * across + cross(axis, across) + dot(axis, across) / (1 + cosine) * axis
                    : across;
  turned -= dot(turned, now) * now;
  const double left = norm(turned);
  return left > 0 ? size / left * turned : Vec3{};
}

double largest_speed(const VectorField& velocity, std::size_t count) {
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 v = velocity[i];
    largest = std::max(largest, dot(v, v));
  }
  return std::sqrt(largest);
}

} // namespace

Reinforcement::Reinforcement(const ReinforcementDesign& design, const std::vector<double>& radius,
                             Profile profile, const SymmetryPlanes& planes, const Ranks& ranks,
                             const Vec3& velocity)
    : chain(design.lines, design.diameter, design.node_spacing, design.steel, planes.normal),
      bond(design.bond), concrete(radius, profile, planes, ranks), states(chain.nodes.owned),
      bond_forces(chain.nodes.owned) {
  for (std::size_t i = 0; i < chain.nodes.owned; ++i) chain.nodes.velocity.set(i, velocity);
}

VectorField Reinforcement::places(const ReinforcementDesign& design, const SymmetryPlanes& planes) {
  return BarChain(design.lines, design.diameter, design.node_spacing, design.steel, planes.normal)
      .nodes.position;
}

void Reinforcement::connect(const Points& points) {
  concrete.forget();
  concrete.evaluate(chain.nodes.position, points);
  std::vector<double> stiffness;
  for (const double length : chain.lengths()) stiffness.push_back(bond.stiffness * length);
  bond_rows = concrete.stiffness_over_mass(stiffness, points.mass);
}

double Reinforcement::stable_step(double step) const {
  std::vector<double> rows(chain.nodes.owned);
  chain.add_stiffness(rows);
  double largest = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double bonded =
        concrete.held(i) ? 2 * bond.stiffness * chain.lengths()[i] / chain.nodes.mass[i] : 0;
    largest = std::max(largest, rows[i] + bonded);
  }
  const double of_bars = critical_part * 2 / std::sqrt(largest);
  const double of_points = step / std::sqrt(1 + 0.25 * step * step * 2 * bond_rows);
  return std::min(of_bars, of_points);
}

void Reinforcement::kick(double duration) {
  Points& nodes = chain.nodes;
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < nodes.owned; ++i)
      nodes.velocity.component[c][i] += duration / nodes.mass[i] * nodes.force.component[c][i];
}

void Reinforcement::drift(double dt) {
  Points& nodes = chain.nodes;
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < nodes.owned; ++i)
      nodes.position.component[c][i] += dt * nodes.velocity.component[c][i];
}

void Reinforcement::relative_to_concrete(const Points& points, double dt, std::vector<Vec3>& displacements) {
  concrete.interpolate(points.velocity, displacements);
  for (std::size_t i = 0; i < displacements.size(); ++i)
    displacements[i] = concrete.held(i) ? dt * (chain.nodes.velocity[i] - displacements[i]) : Vec3{};
}

double Reinforcement::power_of_bond(const std::vector<Vec3>& displacements) const {
  double sum = 0;
  for (std::size_t i = 0; i < bond_forces.size(); ++i) sum += dot(bond_forces[i], displacements[i]);
  return sum;
}

void Reinforcement::advance_bond(const std::vector<Vec3>& displacements,
                                 const std::vector<Vec3>& last_tangents) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    BondState& state = states[i];
    if (!concrete.held(i)) { // the concrete is gone, and with it the force
      state.along = 0, state.across = {}, bond_forces[i] = {};
      continue;
    }
    const Vec3 along = chain.tangents()[i];
    state.across = turned_across(state.across, last_tangents[i], along);
    const double slip = dot(along, displacements[i]);
    bond.advance(state, slip, displacements[i] - slip * along, chain.bar_diameter());
    bond_forces[i] = chain.lengths()[i] * (state.along * along + state.across);
  }
}

void Reinforcement::update(Points& points, double dt) {
  steel_done += steel_step.before + steel_step.after;
  bond_done += bond_step.before + bond_step.after;
  const std::vector<Vec3> last_tangents = chain.tangents();
  steel_step = chain.update();
  // The forces at the ends of the step do their work with the weights that they were given to the points by:
  // those of the start first, then those of the end. The displacement is the mean of both.
  std::vector<Vec3> first, second, mean(states.size());
  relative_to_concrete(points, dt, first);
  concrete.moved(2 * dt *
                 std::max(largest_speed(points.velocity, points.owned),
                          largest_speed(chain.nodes.velocity, chain.nodes.owned)));
  concrete.evaluate(chain.nodes.position, points);
  relative_to_concrete(points, dt, second);
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = 0.5 * (first[i] + second[i]);
  bond_step.before = -0.5 * power_of_bond(first);
  advance_bond(mean, last_tangents);
  bond_step.after = -0.5 * power_of_bond(second);

  std::vector<Vec3> on_points(bond_forces.size());
  for (std::size_t i = 0; i < bond_forces.size(); ++i) {
    on_points[i] = -bond_forces[i];
    chain.nodes.force.add(i, bond_forces[i]);
  }
  concrete.distribute(on_points, points.force);
  chain.hold_in_planes();
  std::vector<double> stiffness;
  for (const double length : chain.lengths()) stiffness.push_back(bond.stiffness * length);
  bond_rows = concrete.stiffness_over_mass(stiffness, points.mass);
}

double Reinforcement::kinetic_energy() const {
  double sum = 0;
  for (std::size_t i = 0; i < chain.nodes.owned; ++i) {
    const Vec3 v = chain.nodes.velocity[i];
    sum += 0.5 * chain.nodes.mass[i] * dot(v, v);
  }
  return sum;
}

double Reinforcement::momentum() const {
  double sum = 0;
  for (std::size_t i = 0; i < chain.nodes.owned; ++i)
    sum += chain.nodes.mass[i] * chain.nodes.velocity.component[2][i];
  return sum;
}

double Reinforcement::mass() const {
  double sum = 0;
  for (const double mass : chain.nodes.mass) sum += mass;
  return sum;
}

std::size_t Reinforcement::unbonded() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < states.size(); ++i) count += !concrete.held(i);
  return count;
}

double Reinforcement::largest_slip() const {
  double largest = 0;
  for (const BondState& state : states) largest = std::max(largest, state.largest_slip);
  return largest;
}

void Reinforcement::transfer(Archive& archive) {
  chain.transfer(archive);
  archive("bond_states", states);
  archive("bond_forces", bond_forces);
  for (double* part :
       {&steel_done, &bond_done, &steel_step.before, &steel_step.after, &bond_step.before, &bond_step.after})
    archive("bar_work", *part);
}

} // namespace spall
