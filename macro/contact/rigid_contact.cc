#include "macro/contact/rigid_contact.h"

#include "macro/points/parallel.h"

#include <vector>

namespace spall {
namespace {

constexpr std::size_t chunk_size = 1024;

/// The frame of a body without rotation, over one step.
struct SlidingFrame {
  Vec3 start, end, velocity;
  double inverse_mass;

  SlidingFrame(const RigidBody& body, double dt)
      : start(body.position), end(body.position + dt * body.velocity), velocity(body.velocity),
        inverse_mass(1 / body.mass) {}
  Vec3 seen_before(const Vec3& x) const { return x - start; }
  Vec3 seen_after(const Vec3& x) const { return x - end; }
  const Vec3& in_space(const Vec3& normal) const { return normal; }
  const Vec3& velocity_at(const Vec3&) const { return velocity; }
  double mobility(const Vec3&, const Vec3&) const { return inverse_mass; }
  Vec3 moment(const Vec3&, const Vec3&) const { return {}; }
};

/// The frame of a rotating body.
struct TurningFrame {
  RigidBody body, after;
  Mat3 axes, axes_after, inverse_inertia;
  Vec3 centre, turn;

  TurningFrame(const RigidBody& body_, double dt)
      : body(body_), after(body_), axes(matrix_of(body.orientation)), inverse_inertia(body.inverse_inertia()),
        centre(body.centre_of_mass()), turn(body.angular_velocity()) {
    after.move(dt);
    axes_after = matrix_of(after.orientation);
  }
  Vec3 seen_before(const Vec3& x) const { return times_transposed(axes, x - body.position); }
  Vec3 seen_after(const Vec3& x) const { return times_transposed(axes_after, x - after.position); }
  Vec3 in_space(const Vec3& normal) const { return times(axes_after, normal); }
  Vec3 velocity_at(const Vec3& x) const { return body.velocity + cross(turn, x - centre); }
  /// Returns the mobility at x: velocity along a unit vector per impulse along it, 1/kg.
  double mobility(const Vec3& x, const Vec3& direction) const {
    const Vec3 arm = cross(x - centre, direction);
    return 1 / body.mass + dot(arm, times(inverse_inertia, arm));
  }
  Vec3 moment(const Vec3& x, const Vec3& impulse) const { return cross(x - centre, impulse); }
};

/// Distance from a point to what touches of its cell, m.
double distance_to_face(const Points& points, const ContactInputs& inputs, std::size_t i, const Vec3& n) {
  const double face = points.distance_to_face(i, n);
  return inputs.touching == TouchingPart::solid ? face / std::max(1.0, determinant(points.deformation(i)))
                                                : face;
}

template<class Shape, class Frame>
RigidContactReport touch(const Shape& shape, const Frame& frame, Points& points, const ContactInputs& inputs,
                         double dt, double kick, std::size_t begin, std::size_t end) {
  RigidContactReport report;
  for (std::size_t i = begin; i < end; ++i) {
    const Vec3 x = points.position[i], v = points.velocity[i];
    const Vec3 later = frame.seen_after(x + dt * v);
    if (shape.lower_bound(later) > 0.5 * largest_cell_stretch * points.spacing[i]) continue;
    const SurfacePoint at = shape.surface(later);
    const Vec3 n = frame.in_space(at.normal);
    const double offset = distance_to_face(points, inputs, i, n);
    if (at.distance >= offset) continue;

    const double gap = shape.surface(frame.seen_before(x)).distance - offset;
    report.deepest = std::max(report.deepest, -gap);
    const Vec3 relative = v - frame.velocity_at(x);
    const double approach = dot(relative, n);
    // This velocity change puts the point on the surface at the end of the step, or removes part of an older
    // overlap.
    const double change = gap >= 0 ? (offset - at.distance) / dt : inputs.target_velocity(gap, dt) - approach;
    if (!(change > 0)) continue;
    const double mass = 1 / (1 / points.mass[i] + frame.mobility(x, n));
    const double normal_impulse = mass * change;

    const Vec3 slip = relative - approach * n;
    const double speed = norm(slip);
    Vec3 friction{};
    if (speed > 0) {
      const Vec3 along = 1 / speed * slip;
      const double stick = speed / (1 / points.mass[i] + frame.mobility(x, along));
      const double face_dt = inputs.friction.is_limited() ? dt * points.face_area(i, n) : 0;
      friction = -std::min(inputs.friction.largest_impulse(normal_impulse, speed, face_dt), stick) * along;
    }

    const Vec3 impulse = friction + normal_impulse * n;
    points.velocity.set(i, v + 1 / points.mass[i] * impulse);
    report.impulse -= impulse;
    report.angular_impulse -= frame.moment(x, impulse);
    // Work on the point: the impulse acts together with the internal force, so its work is the product with
    // the mean of the velocities before both and after both (a point at rest on the surface loses no energy).
    // The body's velocity at the start of the step is subtracted; its change is added below, once all
    // impulses are known.
    const Vec3 mean =
        relative + -0.5 * kick / points.mass[i] * points.force[i] + 0.5 / points.mass[i] * impulse;
    report.normal_loss -= normal_impulse * dot(n, mean);
    report.friction_loss -= dot(friction, mean);
    report.count_gap(gap);
  }
  return report;
}

} // namespace

RigidContactReport& RigidContactReport::operator+=(const RigidContactReport& other) {
  ContactReport::operator+=(other);
  impulse += other.impulse;
  angular_impulse += other.angular_impulse;
  return *this;
}

void RigidContactReport::list(Reduction& of_ranks) {
  ContactReport::list(of_ranks);
  for (Vec3* vector : {&impulse, &angular_impulse})
    for (double& a : *vector) of_ranks.sums.push_back(&a);
}

RigidContactReport push_points(Points& points, const RigidBody& body, const ContactInputs& inputs, double dt,
                               double kick) {
  if (std::holds_alternative<Nothing>(body.shape)) return {};
  std::vector<RigidContactReport> parts((points.owned + chunk_size - 1) / chunk_size);
  const auto touch_all = [&](const auto& shape, const auto& frame) {
    for_each_index(parts.size(), [&](std::size_t p) {
      parts[p] = touch(shape, frame, points, inputs, dt, kick, p * chunk_size,
                       std::min(points.owned, (p + 1) * chunk_size));
    });
  };
  std::visit(
      [&](const auto& shape) {
        if (body.can_turn())
          touch_all(shape, TurningFrame(body, dt));
        else
          touch_all(shape, SlidingFrame(body, dt));
      },
      body.shape);
  RigidContactReport sum;
  for (const RigidContactReport& part : parts) sum += part;
  return sum;
}

void push_body(RigidBody& body, RigidContactReport& sum) {
  // The impulses do work with the mean of the body's velocities before and after them.
  for (int c = 0; c < 3; ++c)
    if (body.free[c]) sum.normal_loss -= 0.5 * sum.impulse[c] * sum.impulse[c] / body.mass;
  sum.normal_loss -= 0.5 * dot(sum.angular_impulse, times(body.inverse_inertia(), sum.angular_impulse));
  body.receive(sum.impulse, sum.angular_impulse);
}

} // namespace spall
