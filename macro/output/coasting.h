#pragma once

#include "macro/dynamics/body_motion.h"
#include "shared/archive.h"

namespace spall {

/// Watches whether a body that leaves a target still loses velocity, from the moment on at which its foremost
/// point passes the back. The body coasts if its velocity has changed so little over the last stretch of its
/// path that a loss at the same rate, until its tail has left, would not change the exit velocity.
class Coasting {
public:
  /// A stretch, in radii of the body: contact pauses and sets in again. The longest pause after which the
  /// velocity still changed by more than 0.1 % was 1.15 radii long, of the deformable projectile and behind
  /// 254 mm (then 0.2 and 0.3 %), and below 0.5 radii in the other scenes. Stretches of 2, 3 and 4 radii end
  /// the run of the 127 mm slab around the axis at 0.83, 0.96 and 1.05 ms, of the tail's 2.12 ms.
  static constexpr double stretch_radii = 3;
  /// The change that is left open, as part of the velocity. With 0.05, 0.1, 0.2 and 0.5 % that run ends at
  /// 0.96, 0.96, 0.94 and 0.94 ms, and no exit velocity of the shipped scenes differs by more than 0.04 %
  /// from that of the tail: most of them lose nothing then (data/studies/README.md).
  static constexpr double largest_change = 1e-3;

  /// @param back_ z of the target's back, m @param radius of the body, m
  explicit Coasting(double back_ = 0, double radius = 0) : back(back_), stretch(stretch_radii * radius) {}

  /// Must be called after every step until the body has left.
  void follow(const BodyMotion& motion);
  bool coasts() const { return begun && front - begin >= stretch; }
  /// Returns where the foremost point will be when the present stretch ends, m.
  double end_of_stretch() const { return (begun ? begin : back) + stretch; }

  void transfer(Archive& archive);

private:
  double back, stretch;
  bool begun = false;              ///< whether the foremost point has passed the back
  double front = 0, begin = 0;     ///< z of the foremost point now and at the begin of the stretch, m
  double slowest = 0, fastest = 0; ///< velocities since then, m/s
};

} // namespace spall
