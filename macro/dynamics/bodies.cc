#include "macro/dynamics/bodies.h"

#include "shared/error.h"

#include <set>
#include <stdexcept>

namespace spall {

const Solid* Bodies::solid(const std::string& name) const {
  for (const auto& solid : solids)
    if (solid->label == name) return solid.get();
  return nullptr;
}

const RigidBody* Bodies::rigid(const std::string& name) const {
  for (const RigidBody& body : rigids)
    if (body.name == name) return &body;
  return nullptr;
}

std::size_t Bodies::index(const std::string& name) const {
  for (std::size_t s = 0; s < solids.size(); ++s)
    if (solids[s]->label == name) return s;
  for (std::size_t r = 0; r < rigids.size(); ++r)
    if (rigids[r].name == name) return solids.size() + r;
  throw std::out_of_range("there is no body '" + name + "'");
}

std::vector<std::string> Bodies::solid_names() const {
  std::vector<std::string> names;
  for (const auto& solid : solids) names.push_back(solid->label);
  return names;
}

std::vector<std::string> Bodies::rigid_names() const {
  std::vector<std::string> names;
  for (const RigidBody& body : rigids) names.push_back(body.name);
  return names;
}

void Bodies::validate() const {
  if (solids.empty()) throw InputError("a run needs a deformable body");
  std::set<std::string> names;
  const auto add = [&names](const std::string& name) {
    if (!names.insert(name).second) throw InputError("two bodies have the name '" + name + "'");
  };
  for (const std::string& name : solid_names()) add(name);
  for (const std::string& name : rigid_names()) add(name);
  for (const Reinforcement& bars : reinforcements) add(bars.name);
  for (const ElasticRing& ring : rings) {
    add(ring.name);
    if (ring.solid >= solids.size())
      throw InputError("ring '" + ring.name + "' surrounds no deformable body");
  }
}

void Bodies::transfer(Archive& archive) {
  for (const auto& solid : solids) {
    solid->transfer(archive);
    if (archive.loading() && solid->surface) solid->surface->mark(solid->points);
  }
  for (RigidBody& body : rigids) body.transfer(archive);
  if (archive.loading())
    for (HeldPoints& support : supports) support.find(solids[support.solid]->points);
  for (ElasticRing& ring : rings) {
    if (archive.loading()) ring.find_rim(solids[ring.solid]->points);
    ring.transfer(archive);
  }
  for (Reinforcement& bars : reinforcements) {
    bars.transfer(archive);
    if (archive.loading()) bars.connect(solids[bars.solid]->points);
  }
}

} // namespace spall
