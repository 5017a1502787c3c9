#pragma once

#include "macro/contact/contact_law.h"
#include "macro/contact/impulses.h"

#include <compare>
#include <map>

namespace spall {

/// Two deformable bodies that stay joined, such as a layer of mortar on concrete: the law "bonded".
///
/// The points of the secondary body that face the primary one at the start, closer than a quarter of their
/// spacing to its surface, are tied to it for the whole run. A tied point stays at the same height above the
/// same place of the primary surface, which is a plane carried by the points that it was fitted through at
/// the start; weights and slopes of moving least squares are kept. In every step impulses take away the
/// velocity of the tied points relative to these places, in all three directions: no friction, no separation.
/// The plane turns with its points, so a rigid motion of both bodies needs no impulses, and linear and
/// angular momentum are kept. A drift from the place is taken back slowly, like an overlap.
class BondedContact final : public ContactLaw {
public:
  /// Finds the points to tie. @throws InputError if bodies to be bonded do not touch
  BondedContact(const ContactInputs& inputs_, const std::vector<ContactPair>& pairs,
                const std::vector<ContactBody>& bodies);

  SolidContactReport apply_impulses(const std::vector<ContactBody>& bodies, double dt, double kick) override;
  /// The impulses of the last step, where the next step's iteration starts.
  void transfer(Archive& archive) override { archive("bond_impulses", last); }

  std::size_t tied_points() const { return ties.size(); }

private:
  /// A point that some tie acts on.
  struct Node {
    std::uint64_t body, number; ///< body, and number of the point through all ranks
    auto operator<=>(const Node&) const = default;
  };
  /// The present motion of a node, as ties need it.
  struct Motion {
    std::uint64_t node; ///< place among the nodes
    Vec3 position, velocity, force;
    double mass;
  };
  /// A point of the primary surface, or an image of one.
  struct Part {
    std::uint32_t node;
    Mat3 image;              ///< maps vectors of the owner to those of the image
    double weight;           ///< weight at the foot of the tied point
    double slope_u, slope_v; ///< weights of the slopes along the two tangents, 1/m
  };
  struct Tie {
    std::size_t secondary_body, primary_body;
    std::uint32_t node; ///< the tied point
    double height;      ///< above the plane, m
    std::vector<Part> parts;
  };

  /// Ties the points of a pair. @param places of the nodes that there are
  void tie(const ContactPair& pair, const std::vector<ContactBody>& near,
           std::map<Node, std::uint32_t>& places);
  /// Position, velocity, force and mass of all nodes, from all ranks.
  std::vector<Motion> gather(const std::vector<ContactBody>& bodies) const;
  void give_back(const std::vector<Vec3>& velocities, const std::vector<ContactBody>& bodies) const;

  ContactInputs inputs;
  std::vector<Node> nodes;
  std::vector<Tie> ties;
  std::vector<Vec3> last; ///< impulse on the tied points in the last step, N s
};

} // namespace spall
