#include "macro/contact/rigid_contact.h"

#include "macro/points/parallel.h"

#include <vector>

namespace spall {
namespace {

constexpr std::size_t chunk_size = 1024;

/// Velocity a + s b.
Vec3 add(const Vec3& a, double s, const Vec3& b) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}

template<class Shape>
ContactReport touch(const Shape& shape, Points& points, const RigidBody& body, const ContactInputs& inputs,
                    double dt, double kick, std::size_t begin, std::size_t end) {
  ContactReport report;
  const Vec3 body_end = add(body.position, dt, body.velocity);
  for (std::size_t i = begin; i < end; ++i) {
    const double offset = inputs.stand_off * points.spacing[i];
    const Vec3 x = points.position[i], v = points.velocity[i];
    const Vec3 later = add(add(x, dt, v), -1, body_end);
    if (shape.lower_bound(later) > offset) continue;
    const SurfacePoint at = shape.surface(later);
    if (at.distance >= offset) continue;
    const Vec3& n = at.normal;

    const double gap = shape.surface(add(x, -1, body.position)).distance - offset;
    report.deepest = std::max(report.deepest, -gap);
    const Vec3 relative = add(v, -1, body.velocity);
    const double approach = dot(relative, n);
    // Velocity change that ends the step on the surface, or takes back part of an older overlap.
    const double change =
        gap >= 0 ? (offset - at.distance) / dt : -approach - inputs.overlap_release * gap / dt;
    if (!(change > 0)) continue;
    const double mass = 1 / (1 / points.mass[i] + 1 / body.mass);
    const double normal_impulse = mass * change;

    const Vec3 slip = add(relative, -approach, n);
    const double speed = std::sqrt(dot(slip, slip));
    const double tangential = std::min(inputs.friction * normal_impulse, mass * speed);
    const Vec3 friction = speed > 0 ? add({}, -tangential / speed, slip) : Vec3{};

    const Vec3 impulse = add(friction, normal_impulse, n);
    points.velocity.set(i, add(v, 1 / points.mass[i], impulse));
    for (int c = 0; c < 3; ++c) report.impulse[c] -= impulse[c];
    // Work on the point: the impulse acts together with the internal force, so its velocity is the mean of
    // those before both and after both (a point resting on the surface loses nothing). The body's velocity at
    // the start of the step is taken off; its own change is added below, once all impulses are known.
    const Vec3 mean =
        add(add(relative, -0.5 * kick / points.mass[i], points.force[i]), 0.5 / points.mass[i], impulse);
    report.normal_loss -= normal_impulse * dot(n, mean);
    report.friction_loss -= dot(friction, mean);
    ++report.touching;
    report.gap_sum += std::abs(gap);
    report.gap_max = std::max(report.gap_max, std::abs(gap));
  }
  return report;
}

} // namespace

ContactReport apply_contact(Points& points, RigidBody& body, const ContactInputs& inputs, double dt,
                            double kick) {
  std::vector<ContactReport> parts((points.owned + chunk_size - 1) / chunk_size);
  std::visit(
      [&](const auto& shape) {
        for_each_index(parts.size(), [&](std::size_t p) {
          parts[p] = touch(shape, points, body, inputs, dt, kick, p * chunk_size,
                           std::min(points.owned, (p + 1) * chunk_size));
        });
      },
      body.shape);
  ContactReport sum;
  for (const ContactReport& part : parts) {
    for (int c = 0; c < 3; ++c) sum.impulse[c] += part.impulse[c];
    sum.normal_loss += part.normal_loss;
    sum.friction_loss += part.friction_loss;
    sum.deepest = std::max(sum.deepest, part.deepest);
    sum.touching += part.touching;
    sum.gap_sum += part.gap_sum;
    sum.gap_max = std::max(sum.gap_max, part.gap_max);
  }
  for (int c = 0; c < 3; ++c) {
    if (!body.free[c]) continue;
    body.velocity[c] += sum.impulse[c] / body.mass;
    sum.normal_loss -= 0.5 * sum.impulse[c] * sum.impulse[c] / body.mass;
  }
  return sum;
}

} // namespace spall
