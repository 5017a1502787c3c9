#include "macro/contact/contact.h"

#include "macro/contact/contact_laws.h"
#include "shared/error.h"

#include <algorithm>

namespace spall {
namespace {

constexpr const char* bonded = "bonded";

/// Returns the number of the solid with that name. @throws InputError if there is none
std::size_t solid_named(const std::string& name, const std::vector<std::string>& solids,
                        const std::vector<std::string>& rigids) {
  const auto found = std::find(solids.begin(), solids.end(), name);
  if (found != solids.end()) return static_cast<std::size_t>(found - solids.begin());
  std::string known;
  for (const std::string& solid : solids) known += (known.empty() ? "" : ", ") + solid;
  const bool rigid = std::find(rigids.begin(), rigids.end(), name) != rigids.end();
  throw InputError("bonded bodies: '" + name + "' " + (rigid ? "is rigid" : "is not a body of the scene") +
                   ", allowed: the deformable bodies " + known);
}

/// Assigns the law "bonded" to the named pairs. @throws InputError if a name is unknown or repeated
void bond(std::vector<ContactPair>& pairs, const ContactInputs& inputs,
          const std::vector<std::string>& solids, const std::vector<std::string>& rigids) {
  for (const auto& [one, other] : inputs.bonded) {
    const std::size_t a = solid_named(one, solids, rigids), b = solid_named(other, solids, rigids);
    if (a == b) throw InputError("bonded bodies: '" + one + "' cannot be bonded to itself");
    for (ContactPair& pair : pairs)
      if (pair.secondary == std::min(a, b) && pair.primary == std::max(a, b)) pair.law = bonded;
  }
}

} // namespace

Contact::Contact(const ContactInputs& inputs_, const std::vector<ContactBody>& solids,
                 const std::vector<std::string>& solid_names, const std::vector<std::string>& rigid_names)
    : inputs(inputs_), solid_count(solids.size()) {
  for (std::size_t s = 0; s < solid_count; ++s)
    for (std::size_t r = 0; r < rigid_names.size(); ++r) list.push_back({s, solid_count + r, "points"});
  with_rigid = list.size();
  std::vector<ContactPair> between = all_pairs(solid_count, inputs.law);
  bond(between, inputs, solid_names, rigid_names);
  list.insert(list.end(), between.begin(), between.end());
  for (const auto& [word, make_law] : contact_laws()) {
    std::vector<ContactPair> own;
    for (const ContactPair& pair : between)
      if (pair.law == word) own.push_back(pair);
    if (!own.empty()) laws.push_back(make_law(inputs, own, solids));
  }
}

ContactStep Contact::apply_impulses(const std::vector<ContactBody>& solids,
                                    const std::vector<RigidBody>& rigids, double dt, double kick,
                                    const std::vector<BarNodes>& bars) {
  ContactStep step{.with_rigid = {}, .between_solids = SolidContactReport(solid_count)};
  for (std::size_t p = 0; p < with_rigid; ++p) {
    const ContactBody& solid = solids[list[p].secondary];
    const RigidBody& rigid = rigids[list[p].primary - solid_count];
    RigidContactReport report = push_points(*solid.points, rigid, inputs, dt, kick);
    for (const BarNodes& bar : bars) {
      if (bar.solid != list[p].secondary) continue;
      const RigidContactReport of_bar = push_points(*bar.nodes, rigid, inputs, dt, kick);
      // All ranks push all nodes; the sum over the ranks takes them once.
      if (solid.ghosts->processes().first()) report += of_bar;
    }
    step.with_rigid.push_back(report);
  }
  for (const auto& law : laws) step.between_solids += law->apply_impulses(solids, dt, kick);
  return step;
}

ContactReport Contact::push_rigid(const ContactStep& step, std::vector<RigidBody>& rigids) const {
  ContactReport all;
  for (std::size_t r = 0; r < rigids.size(); ++r) {
    RigidContactReport sum;
    for (std::size_t p = 0; p < with_rigid; ++p)
      if (list[p].primary == solid_count + r) sum += step.with_rigid[p];
    push_body(rigids[r], sum);
    all += sum;
  }
  return all;
}

SolidContactReport Contact::add_forces(const std::vector<ContactBody>& solids, double dt) {
  SolidContactReport sum(solid_count);
  for (const auto& law : laws) sum += law->add_forces(solids, dt);
  return sum;
}

void Contact::count(const ContactStep& step, ImpulseMatrix& exchange) const {
  exchange.add(step.between_solids.exchange);
  for (std::size_t p = 0; p < with_rigid; ++p) {
    const Vec3& on_rigid = step.with_rigid[p].impulse;
    exchange.given(list[p].secondary, list[p].primary) += on_rigid;
    exchange.given(list[p].primary, list[p].secondary) -= on_rigid;
  }
}

void Contact::transfer(Archive& archive) {
  for (const auto& law : laws) law->transfer(archive);
}

} // namespace spall
