#pragma once

#include "macro/contact/near_points.h"
#include "macro/contact/surface_patch.h"

namespace spall {

/// One point of a body (the slave) against the surface of another (the master).
struct Touch {
  std::size_t slave_body = 0, master_body = 0;
  std::uint32_t slave = 0;
  std::uint64_t number = 0; ///< of the slave
  SurfacePatch patch{};
  double target = 0; ///< least normal velocity of the slave relative to the patch after the step, m/s
  Vec3 impulse{};    ///< on the slave, N s; the start of the iteration, then its result
  Vec3 before{};     ///< relative velocity without any impulse, m/s
  double normal_mobility = 0; ///< relative velocity per impulse along the normal, 1/kg
  double tangent_mobility = 0;

  /// What the next step's iteration starts from.
  void transfer(Archive& archive) {
    archive("touch_slave_body", slave_body);
    archive("touch_master_body", master_body);
    archive("touch_number", number);
    archive("touch_impulse", impulse);
  }
};

/// The least iterations and accuracy of the impulses: the change of velocity in the last sweep, relative to
/// the largest one that the contact has to stop. What is left shows as overlap and is taken back in the next
/// step; momentum is exact in any case.
inline constexpr int most_sweeps = 50;
inline constexpr double sweep_tolerance = 1e-4;

/// The touches with the points they act on, apart from the bodies: gathered, solved, applied.
struct ImpulseSystem {
  /// A point that some touch acts on.
  struct Node {
    std::uint32_t body, index; ///< owned by the body
    double inverse_mass;       ///< 1/kg
    Vec3 velocity;             ///< m/s
  };
  /// The part a node has in a touch: weight 1 for the slave, minus the weights of the patch; an image's
  /// velocity is that of the node, mapped.
  struct Part {
    std::uint32_t node;
    double weight;
    Mat3 map;
  };
  std::vector<Node> nodes;
  std::vector<Part> parts;
  std::vector<std::uint32_t> start; ///< of the parts of each touch; the slave is the first
};

/// Points of all touches, each once, with their velocities.
ImpulseSystem gather_system(const std::vector<Touch>& touches, const std::vector<ContactBody>& bodies);

/// Finds the smallest impulses with which no touch is slower than its target and friction obeys Coulomb's law
/// (paper Eqs. 13-16 integrated over the step), and adds them to the velocities of the nodes. Projected
/// Gauss-Seidel in the order of the list, by one thread: the list is short and the result does not depend on
/// the number of threads.
void solve_impulses(std::vector<Touch>& touches, ImpulseSystem& system, double friction);

/// Gives the bodies the velocities of the nodes.
void apply_system(const ImpulseSystem& system, const std::vector<ContactBody>& bodies);

/// Velocity of the slave relative to its patch, for any field of vectors over the owned points.
template<class Field> // Field: (body, owned point) -> Vec3
Vec3 relative(const Touch& touch, const std::vector<ContactBody>& bodies, const Field& field) {
  Vec3 v = field(touch.slave_body, touch.slave);
  const ContactBody& master = bodies[touch.master_body];
  for (const PatchPoint& p : touch.patch.points) {
    const Vec3 u = master.ghosts->mirror(
        *master.points, p.index, field(touch.master_body, master.ghosts->owner(*master.points, p.index)));
    for (int c = 0; c < 3; ++c) v[c] -= p.weight * u[c];
  }
  return v;
}

} // namespace spall
