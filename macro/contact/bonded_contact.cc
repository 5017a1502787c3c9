#include "macro/contact/bonded_contact.h"

#include "macro/contact/contact_zone.h"
#include "macro/contact/facing_patch.h"
#include "macro/contact/plane_moments.h"
#include "macro/contact/surface_contact.h"
#include "shared/error.h"
#include "shared/traffic.h"

#include <algorithm>
#include <cmath>

namespace spall {
namespace {

/// Points that are closer than this many spacings to the primary surface at the start are tied to it.
constexpr double tied_gap = 0.25;

/// A patch is wide enough for a plane if the inverse second moments of its points, in spacings, add up to
/// less than this: 4 for a point and its four nearest neighbours on a lattice, 8 for a pair of pairs.
constexpr double largest_inverse_spread = 30;

/// A patch whose two tangents span less than this part of their first area has lost its plane: its points
/// have fallen into a line. It then holds the tied point without turning it.
constexpr double least_area = 1e-2;

/// A point of the primary surface in the tangent plane below a tied point.
struct Candidate {
  double u, v;     ///< coordinates in the plane, from the foot of the tied point, m
  double distance; ///< distance from the foot, in extents of the point's cell
  static constexpr double share = 1;
};

/// The plane that carries a tied point: its foot, unit normal and dual tangents (their products with the
/// tangents are those of a unit matrix).
struct CarriedPlane {
  Vec3 foot{}, normal{}, dual_u{}, dual_v{};
};

CarriedPlane carried_plane(const Vec3& foot, const Vec3& tangent_u, const Vec3& tangent_v) {
  CarriedPlane plane{.foot = foot};
  const Vec3 across = cross(tangent_u, tangent_v);
  const double area = norm(across);
  if (!(area > least_area)) return plane;
  plane.normal = across / area;
  plane.dual_u = cross(tangent_v, plane.normal) / area;
  plane.dual_v = cross(plane.normal, tangent_u) / area;
  return plane;
}

/// Returns the dyadic product a b^T.
Mat3 outer(const Vec3& a, const Vec3& b) {
  return {a[0] * b[0], a[0] * b[1], a[0] * b[2], a[1] * b[0], a[1] * b[1],
          a[1] * b[2], a[2] * b[0], a[2] * b[1], a[2] * b[2]};
}

} // namespace

BondedContact::BondedContact(const ContactInputs& inputs_, const std::vector<ContactPair>& pairs,
                             const std::vector<ContactBody>& bodies)
    : inputs(inputs_) {
  const TrafficOf use(MpiUse::setup);
  ContactZone zone;
  zone.gather_at_start(bodies, pairs, SurfaceContact::margin);
  std::map<Node, std::uint32_t> places;
  for (const ContactPair& pair : pairs) tie(pair, zone.bodies(), places);
  last.resize(ties.size());
}

void BondedContact::tie(const ContactPair& pair, const std::vector<ContactBody>& near,
                        std::map<Node, std::uint32_t>& places) {
  const auto node_of = [&](const Node& node) {
    const auto [entry, is_new] = places.try_emplace(node, static_cast<std::uint32_t>(nodes.size()));
    if (is_new) nodes.push_back(node);
    return entry->second;
  };
  const ContactBody &secondary = near[pair.secondary], &primary = near[pair.primary];
  const std::size_t before = ties.size();
  NearPoints near_secondary, near_primary;
  const Bounds everywhere{{-1e300, -1e300, -1e300}, {1e300, 1e300, 1e300}};
  near_secondary.rebuild(secondary, everywhere);
  near_primary.rebuild(primary, everywhere);
  if (near_secondary.empty() || near_primary.empty())
    throw InputError("bonded bodies " + std::to_string(pair.secondary) + " and " +
                     std::to_string(pair.primary) + " are apart at the start");
  SurfacePatch patch;
  for (std::uint32_t n = 0; n < near_secondary.indices().size(); ++n) {
    const std::uint32_t i = near_secondary.indices()[n];
    if (i >= secondary.points->owned) break;
    const double spacing = find_facing_patch(patch, *secondary.points, near_secondary, n, *primary.points,
                                             near_primary, tied_gap);
    if (!(spacing > 0) || std::abs(patch.gap) > tied_gap * spacing) continue;

    const Vec3 x = secondary.points->position[i];
    const auto [tu, tv] = tangents(patch.normal);
    std::vector<Candidate> candidates;
    for (const PatchPoint& p : patch.points) {
      const Vec3 d = primary.points->position[p.index] - x;
      const double u = dot(d, tu), v = dot(d, tv);
      const double h = primary.points->spacing[primary.ghosts->owner(*primary.points, p.index)];
      candidates.push_back({u, v, std::hypot(u, v) / h});
    }
    const PlaneMoments m(candidates);
    // Points on a line, or a single point beside the edge, do not define a plane.
    if (!(m.uu > 0) || !((m.uu + m.vv) * m.sum * spacing * spacing < largest_inverse_spread)) continue;

    Tie tied{.secondary_body = pair.secondary,
             .primary_body = pair.primary,
             .node = node_of({pair.secondary, secondary.number(i)}),
             .height = 0,
             .parts = {}};
    Vec3 foot{};
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      const std::uint32_t index = patch.points[k].index;
      const auto [slope_u, slope_v] = m.slopes(candidates[k]);
      const double weight =
          PlaneMoments::kernel(candidates[k]) / m.sum - (slope_u * m.mean_u + slope_v * m.mean_v);
      const std::uint32_t owner = primary.ghosts->owner(*primary.points, index);
      tied.parts.push_back({.node = node_of({pair.primary, primary.number(owner)}),
                            .image = primary.image_map(index),
                            .weight = weight,
                            .slope_u = slope_u,
                            .slope_v = slope_v});
      foot += weight * primary.points->position[index];
    }
    tied.height = dot(x - foot, patch.normal);
    ties.push_back(std::move(tied));
  }
  if (ties.size() == before)
    throw InputError("bonded bodies " + std::to_string(pair.secondary) + " and " +
                     std::to_string(pair.primary) +
                     ": no point of the former is within a quarter of a spacing of the latter's surface");
}

std::vector<BondedContact::Motion> BondedContact::gather(const std::vector<ContactBody>& bodies) const {
  const TrafficOf use(MpiUse::contact);
  std::vector<Motion> own;
  own.reserve(nodes.size());
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const ContactBody& body = bodies[nodes[k].body];
    const std::uint64_t first = body.ghosts->remote_points().first(), number = nodes[k].number;
    if (number < first || number >= first + body.points->owned) continue;
    const std::size_t i = number - first;
    const Points& points = *body.points;
    own.push_back({k, points.position[i], points.velocity[i], points.force[i], points.mass[i]});
  }
  std::vector<Motion> all(nodes.size());
  const std::vector<Motion> joined = bodies.front().ghosts->processes().join(own);
  for (const Motion& motion : joined) all[motion.node] = motion;
  return all;
}

void BondedContact::give_back(const std::vector<Vec3>& velocities,
                              const std::vector<ContactBody>& bodies) const {
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const ContactBody& body = bodies[nodes[k].body];
    const std::uint64_t first = body.ghosts->remote_points().first(), number = nodes[k].number;
    if (number >= first && number < first + body.points->owned)
      body.points->velocity.set(number - first, velocities[k]);
  }
}

SolidContactReport BondedContact::apply_impulses(const std::vector<ContactBody>& bodies, double dt,
                                                 double kick) {
  SolidContactReport report(bodies.size());
  const std::vector<Motion> motions = gather(bodies);
  ImpulseSystem system;
  std::vector<Vec3> kicks, velocities;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    system.nodes.push_back({static_cast<std::uint32_t>(nodes[k].body), static_cast<std::uint32_t>(k),
                            1 / motions[k].mass, motions[k].velocity});
    kicks.push_back(kick / motions[k].mass * motions[k].force);
  }

  std::vector<Hold> holds;
  for (std::size_t t = 0; t < ties.size(); ++t) {
    const Tie& tie = ties[t];
    Vec3 foot{}, tangent_u{}, tangent_v{};
    for (const Part& part : tie.parts) {
      const Vec3 x = times(part.image, motions[part.node].position);
      foot += part.weight * x, tangent_u += part.slope_u * x, tangent_v += part.slope_v * x;
    }
    const CarriedPlane plane = carried_plane(foot, tangent_u, tangent_v);
    // v_rel = v - sum w_p v_p - height d(normal)/dt, and d(normal)/dt = -sum g_p (normal . v_p)
    // with the gradients g_p of the weights over the plane.
    system.start.push_back(static_cast<std::uint32_t>(system.parts.size()));
    system.parts.push_back({tie.node, 1, identity3});
    for (const Part& part : tie.parts) {
      const Vec3 gradient = part.slope_u * plane.dual_u + part.slope_v * plane.dual_v;
      const Mat3 carries = part.weight * identity3 - tie.height * outer(gradient, plane.normal);
      system.parts.push_back({part.node, -1, multiply(carries, part.image)});
    }
    const Vec3 drift = motions[tie.node].position - plane.foot - tie.height * plane.normal;
    const double size = plane.normal == Vec3{} ? 0 : norm(drift);
    const double rate = size > 0 ? std::min(inputs.overlap_release / dt, inputs.release_speed / size) : 0;
    holds.push_back({.target = -rate * drift, .impulse = last[t]});
    report.largest_drift = std::max(report.largest_drift, size);
  }
  system.start.push_back(static_cast<std::uint32_t>(system.parts.size()));
  solve_holds(holds, system);

  for (std::size_t t = 0; t < ties.size(); ++t) {
    const Hold& hold = holds[t];
    // The work of an impulse is its product with the mean of the velocities before the internal force's
    // velocity change and after both velocity changes, as for touching points.
    const Vec3 mean = 0.5 * (hold.before - relative_of(system, t, kicks) + relative_velocity(system, t));
    report.normal_loss -= dot(hold.impulse, mean);
    report.exchange.given(ties[t].primary_body, ties[t].secondary_body) += hold.impulse;
    report.exchange.given(ties[t].secondary_body, ties[t].primary_body) -= hold.impulse;
    last[t] = hold.impulse;
  }
  for (const ImpulseSystem::Node& node : system.nodes) velocities.push_back(node.velocity);
  give_back(velocities, bodies);
  return report;
}

} // namespace spall
