#pragma once

#include "macro/contact/elastic_ring.h"
#include "macro/contact/held_points.h"
#include "macro/contact/rigid_body.h"
#include "macro/reinforcement/reinforcement.h"
#include "macro/solid/solid.h"

#include <memory>
#include <string>
#include <vector>

namespace spall {

/// Everything that moves. Names are unique: Solid::label, RigidBody::name, ElasticRing::name.
struct Bodies {
  std::vector<std::unique_ptr<Solid>> solids;     ///< deformable, in the order of contact, softest first
  std::vector<RigidBody> rigids = {};             ///< held ones (walls, foundations) and free ones
  std::vector<ElasticRing> rings = {};            ///< each around one of the solids
  std::vector<HeldPoints> supports = {};          ///< each of one of the solids
  std::vector<Reinforcement> reinforcements = {}; ///< each in one of the solids

  /// The body of that name; none if there is no such body of the kind.
  const Solid* solid(const std::string& name) const;
  const RigidBody* rigid(const std::string& name) const;
  /// Number of a body among all: solids first, then rigid bodies. @throws std::out_of_range
  std::size_t index(const std::string& name) const;
  std::size_t count() const { return solids.size() + rigids.size(); }

  /// Name of the body with that number.
  const std::string& name(std::size_t index) const {
    return index < solids.size() ? solids[index]->label : rigids[index - solids.size()].name;
  }

  std::vector<std::string> solid_names() const;
  std::vector<std::string> rigid_names() const;
  /// @throws InputError if there is no solid, two bodies have one name, or a ring surrounds no solid
  void validate() const;

  /// Over which the points of the solids are spread. All must make the same calls.
  const Ranks& ranks() const { return solids.front()->ghosts.processes(); }
  const SymmetryPlanes& symmetry() const { return solids.front()->ghosts.symmetry(); }

  void transfer(Archive& archive);
};

} // namespace spall
