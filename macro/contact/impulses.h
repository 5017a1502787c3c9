#pragma once

#include "macro/contact/friction.h"
#include "macro/contact/near_points.h"
#include "macro/contact/surface_patch.h"

namespace spall {

/// One point of a body (the secondary one) against the surface of another (the primary one).
struct Touch {
  std::size_t secondary_body = 0, primary_body = 0;
  std::uint32_t secondary = 0; ///< the point
  std::uint64_t number = 0;    ///< number that identifies the point in every step
  SurfacePatch patch{};
  double target = 0;  ///< least normal velocity of the point relative to the patch after the step, m/s
  double face_dt = 0; ///< area of the face of the point's cell times the step, m^2 s, if friction needs it
  Vec3 impulse{};     ///< impulse on the point, N s; the start of the iteration, then its result
  Vec3 before{};      ///< relative velocity without any impulse, m/s
  double normal_mobility = 0; ///< relative velocity per impulse along the normal, 1/kg
  double tangent_mobility = 0;

  /// Transfers the state that the next step's iteration starts from.
  void transfer(Archive& archive) {
    archive("touch_secondary_body", secondary_body);
    archive("touch_primary_body", primary_body);
    archive("touch_number", number);
    archive("touch_impulse", impulse);
  }
};

/// Most sweeps of the iteration, and its accuracy: the change of velocity in the last sweep, relative to the
/// largest one that the contact has to stop. The remaining error leads to an overlap, which is removed in the
/// next step; momentum is exact in any case.
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
  /// The part a node has in a touch: weight 1 for the secondary point, minus the weights of the patch; an
  /// image's velocity is that of the node, mapped.
  struct Part {
    std::uint32_t node;
    double weight;
    Mat3 map;
  };
  std::vector<Node> nodes;
  std::vector<Part> parts;
  /// First part of each touch, and the number of all parts; the secondary point is the first part.
  std::vector<std::uint32_t> start;
};

/// Points of all touches, each once, with their velocities.
ImpulseSystem gather_system(const std::vector<Touch>& touches, const std::vector<ContactBody>& bodies);

/// Finds the smallest impulses with which no touch is slower than its target and friction obeys its
/// law (paper Eqs. 13-16 integrated over the step), and adds them to the velocities of the nodes. Projected
/// Gauss-Seidel in the order of the list, by one thread: the list is short and the result does not depend on
/// the number of threads.
void solve_impulses(std::vector<Touch>& touches, ImpulseSystem& system, const Friction& friction);

/// A point that is held in its place on the surface of another body, with an impulse in any direction.
struct Hold {
  Vec3 target{};  ///< velocity relative to the place after the step, m/s
  Vec3 impulse{}; ///< impulse on the point, N s; the start of the iteration, then its result
  Vec3 before{};  ///< relative velocity without any impulse, m/s
};

/// Finds the impulses that give every held point its target velocity, and adds them to the velocities of the
/// nodes: the same Gauss-Seidel iteration with all three components at once and without projection. The parts
/// of a hold are those of a touch.
void solve_holds(std::vector<Hold>& holds, ImpulseSystem& system);

/// Relative velocity of the n-th touch or hold, m/s: sum of weight * map * velocity over its parts.
Vec3 relative_velocity(const ImpulseSystem& system, std::size_t n);
/// The same weighted sum for any vectors of the nodes.
Vec3 relative_of(const ImpulseSystem& system, std::size_t n, const std::vector<Vec3>& of_nodes);

/// Gives the bodies the velocities of the nodes.
void apply_system(const ImpulseSystem& system, const std::vector<ContactBody>& bodies);

/// Velocity of the secondary point relative to its patch, for any field of vectors over the owned points.
template<class Field> // Field: (body, owned point) -> Vec3
Vec3 relative(const Touch& touch, const std::vector<ContactBody>& bodies, const Field& field) {
  Vec3 v = field(touch.secondary_body, touch.secondary);
  const ContactBody& primary = bodies[touch.primary_body];
  for (const PatchPoint& p : touch.patch.points)
    v -= p.weight *
         primary.ghosts->mirror(*primary.points, p.index,
                                field(touch.primary_body, primary.ghosts->owner(*primary.points, p.index)));
  return v;
}

} // namespace spall
