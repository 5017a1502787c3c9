#pragma once

#include "macro/points/quaternion.h"
#include "macro/shape/shape.h"
#include "shared/archive.h"

#include <limits>
#include <string>

namespace spall {

/// A rigid body with up to six degrees of freedom. Its frame is that of its shape. Masses and moments are
/// those of the modelled part: symmetry planes halve them and take away the motions that would leave the
/// planes.
struct RigidBody {
  std::string name = "rigid"; ///< name in files and messages
  Shape shape;
  double mass = std::numeric_limits<double>::infinity(); ///< kg; infinite: held
  Vec3 position{};                              ///< position of the frame's origin, m (a projectile's tip)
  Vec3 velocity{};                              ///< velocity of the centre of mass, m/s
  std::array<bool, 3> free{false, false, true}; ///< directions it may move in
  std::array<bool, 3> turns{};                  ///< axes of space it may turn about
  Vec3 centre{};                                ///< centre of mass in the frame, m
  Vec3 moments{};                               ///< principal moments about the centre of mass, kg m^2
  Quaternion principal{};                       ///< turns the frame's axes into those of inertia
  Quaternion orientation{};                     ///< turns the frame's axes into those of space
  Vec3 angular_momentum{}; ///< angular momentum about the centre of mass, in space, kg m^2/s

  bool can_turn() const { return turns[0] || turns[1] || turns[2]; }
  Mat3 inertia_axes() const { return matrix_of(orientation * principal); } ///< columns: of inertia, in space
  bool held() const { return std::isinf(mass); }
  Vec3 centre_of_mass() const { return in_space(centre); }
  /// Turns a place of the frame into one of space, m.
  Vec3 in_space(const Vec3& x) const { return add(position, 1, times(matrix_of(orientation), x)); }
  /// Velocity of the body at a place in space, m/s.
  Vec3 velocity_at(const Vec3& x) const { return velocity + cross(angular_velocity(), x - centre_of_mass()); }
  Vec3 angular_velocity() const { return times(inverse_inertia(), angular_momentum); } ///< rad/s
  double kinetic_energy() const;                                                       ///< J
  /// Maps angular momentum to angular velocity, in space; zero for axes it may not turn about.
  Mat3 inverse_inertia() const;

  /// Changes the velocities. @param angular about the centre of mass, N m s
  void receive(const Vec3& impulse, const Vec3& angular);
  /// Free motion over dt. The angular momentum is a vector of space that stays as it is; the turn is composed
  /// of five exact ones about principal axes (Dullweber, Leimkuhler & McLachlan 1997): second order,
  /// reversible in time, and without drift of the energy.
  void move(double dt);

  /// Largest and smallest z of the body, m.
  double front() const;
  double rear() const;

  /// Transfers the state that changes in a run: position, attitude and velocities.
  void transfer(Archive& archive) {
    for (Vec3* state : {&position, &velocity, &angular_momentum}) archive("rigid_body", *state);
    archive("rigid_body", orientation);
  }
};

} // namespace spall
