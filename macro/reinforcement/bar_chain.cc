#include "macro/reinforcement/bar_chain.h"

#include <cmath>
#include <numbers>

namespace spall {
namespace {

/// Sine of an angle below which a hinge is straight: the plane in which it is bent is not known, and its
/// elastic moment is nothing.
constexpr double straight = 1e-12;

Vec3 mirrored(Vec3 x, int plane) {
  x[plane] = -x[plane];
  return x;
}

/// How the angle between two segments changes with the places of the first and the last of their three
/// nodes; that of the middle one takes up the sum.
struct Bend {
  double angle = 0;
  Vec3 first{}, last{};
};

Bend bend_of(const Vec3& a, const Vec3& middle, const Vec3& c) {
  const Vec3 e1 = middle - a, e2 = c - middle;
  const double l1 = norm(e1), l2 = norm(e2);
  if (!(l1 > 0) || !(l2 > 0)) return {};
  const Vec3 t1 = e1 / l1, t2 = e2 / l2, across = cross(t1, t2);
  const double sine = norm(across);
  Bend bend{.angle = std::atan2(sine, dot(t1, t2))};
  if (!(sine > straight)) return bend;
  const Vec3 normal = across / sine;
  bend.first = cross(normal, t1) / l1;
  bend.last = cross(normal, t2) / l2;
  return bend;
}

} // namespace

BarChain::BarChain(const std::vector<BarLine>& lines, double diameter_, double spacing,
                   const BarSteel& steel_, const std::array<bool, 3>& planes)
    : diameter(diameter_), steel(steel_) {
  for (const BarLine& line : lines) add_line(line, spacing, planes);
  directions.resize(nodes.owned);
  find_directions();
}

void BarChain::add_line(const BarLine& line, double spacing, const std::array<bool, 3>& planes) {
  const double all = norm(line.to - line.from);
  const auto in_planes = [&planes](const Vec3& x) {
    return std::array<bool, 3>{planes[0] && x[0] == 0, planes[1] && x[1] == 0, planes[2] && x[2] == 0};
  };
  bool begins_in_plane = false; // which it crosses
  for (int c = 0; c < 3; ++c) begins_in_plane |= in_planes(line.from)[c] && line.to[c] != 0;
  // The middle of a whole bar is a node, as that of a bar of which a plane of symmetry leaves half.
  const double halves = begins_in_plane ? 1 : 2;
  const auto count =
      static_cast<std::uint32_t>(halves * std::max(1.0, std::ceil(all / halves / spacing - 1e-9)));
  const double length = all / count, whole = 0.25 * std::numbers::pi * diameter * diameter;
  const auto first = static_cast<std::uint32_t>(nodes.owned);
  nodes.resize(first + count + 1);
  for (std::uint32_t k = 0; k <= count; ++k) {
    const bool end = k == 0 || k == count;
    const std::uint32_t i = first + k;
    const Vec3 at = line.from + (static_cast<double>(k) / count) * (line.to - line.from);
    nodes.position.set(i, at), nodes.initial_position.set(i, at);
    tributary.push_back((end ? 0.5 : 1) * length * line.share);
    nodes.volume[i] = whole * tributary.back();
    nodes.mass[i] = steel.density * nodes.volume[i];
    nodes.spacing[i] = diameter;
    in_plane.push_back(in_planes(at));
    if (k > 0) links.push_back({i - 1, i, length, whole * line.share});
    if (!end) joints.push_back({i - 1, i, i + 1, length, line.share, -1});
  }
  for (int c = 0; c < 3; ++c)
    if (in_plane[first][c] && line.to[c] != 0)
      joints.push_back({first + 1, first, first + 1, length, 0.5 * line.share, c});
}

void BarChain::find_directions() {
  std::vector<Vec3> sum(directions.size());
  for (const Segment& link : links) {
    if (ruptured(link)) continue;
    const Vec3 along = nodes.position[link.b] - nodes.position[link.a];
    sum[link.a] += along, sum[link.b] += along;
  }
  for (std::size_t i = 0; i < sum.size(); ++i) {
    // At a plane of symmetry the bar goes on along its normal.
    for (int c = 0; c < 3; ++c)
      if (in_plane[i][c] && std::abs(directions[i][c]) > 0.5) sum[i] = directions[i];
    if (const double length = norm(sum[i]); length > 0) directions[i] = sum[i] / length;
  }
}

BarChain::Work BarChain::advance(Segment& link) {
  if (ruptured(link)) return {};
  const Vec3 along = nodes.position[link.b] - nodes.position[link.a];
  const double now = norm(along), strain = now / link.length - 1;
  // The strain at the last positions is that of the last stress.
  const double before = link.steel.stress,
               last = link.steel.stress / steel.youngs_modulus + link.steel.plastic_strain;
  steel.advance(link.steel, strain);
  const double half = 0.5 * link.area * link.length * (strain - last);
  if (ruptured(link) || !(now > 0)) return {half * before, 0};
  const Vec3 force = link.area * link.steel.stress / now * along;
  nodes.force.add(link.a, force);
  nodes.force.add(link.b, -force);
  return {half * before, half * link.steel.stress};
}

BarChain::Work BarChain::advance(Hinge& joint, bool cut) {
  const Vec3 c = nodes.position[joint.c],
             a = joint.plane < 0 ? nodes.position[joint.a] : mirrored(c, joint.plane);
  const Bend bend = bend_of(a, nodes.position[joint.middle], c);
  const double inertia = std::numbers::pi / 64 * std::pow(diameter, 4),
               stiffness = joint.share * steel.youngs_modulus * inertia / joint.length,
               most = joint.share * steel.yield_stress * std::pow(diameter, 3) / 6;
  HingeState& state = joint.state;
  const double before = state.moment, half = 0.5 * (bend.angle - state.angle);
  const double trial = stiffness * (bend.angle - state.plastic);
  state.angle = bend.angle;
  state.moment = cut ? 0 : std::clamp(trial, -most, most);
  if (cut) return {half * before, 0};
  state.plastic += (trial - state.moment) / stiffness;
  // The share of a hinge in a plane is half: its end node has the other half from the image.
  const double of_end = joint.plane < 0 ? 1 : 2;
  nodes.force.add(joint.c, -state.moment * of_end * bend.last);
  if (joint.plane < 0) nodes.force.add(joint.a, -state.moment * bend.first);
  nodes.force.add(joint.middle, state.moment * (bend.first + bend.last));
  return {half * before, half * state.moment};
}

BarChain::Work BarChain::update() {
  for (auto& component : nodes.force.component) std::fill(component.begin(), component.end(), 0.0);
  Work sum;
  for (Segment& link : links) {
    const Work work = advance(link);
    sum.before += work.before, sum.after += work.after;
  }
  const std::vector<std::uint8_t> cut = cut_nodes();
  for (Hinge& joint : joints) {
    const Work work = advance(joint, cut[joint.middle] != 0);
    sum.before += work.before, sum.after += work.after;
  }
  find_directions();
  return sum;
}

std::vector<std::uint8_t> BarChain::cut_nodes() const {
  std::vector<std::uint8_t> cut(nodes.owned);
  for (const Segment& link : links)
    if (ruptured(link)) cut[link.a] = cut[link.b] = 1;
  return cut;
}

void BarChain::hold_in_planes() {
  for (std::size_t i = 0; i < in_plane.size(); ++i)
    for (int c = 0; c < 3; ++c)
      if (in_plane[i][c]) nodes.force.component[c][i] = 0;
}

void BarChain::add_stiffness(std::vector<double>& over_mass) const {
  std::vector<double> sums(nodes.owned);
  for (const Segment& link : links) {
    if (ruptured(link)) continue;
    const double k = 2 * steel.youngs_modulus * link.area / link.length;
    sums[link.a] += k, sums[link.b] += k;
  }
  const double bending = steel.youngs_modulus * std::numbers::pi / 64 * std::pow(diameter, 4);
  const std::vector<std::uint8_t> cut = cut_nodes();
  for (const Hinge& joint : joints) {
    if (cut[joint.middle]) continue;
    const Vec3 middle = nodes.position[joint.middle], c = nodes.position[joint.c],
               a = joint.plane < 0 ? nodes.position[joint.a] : mirrored(c, joint.plane);
    const double g1 = 1 / norm(middle - a), g2 = 1 / norm(c - middle);
    // Of the modelled half of a hinge in a plane the end node has both ends.
    const double k = (joint.plane < 0 ? 1 : 2) * joint.share * bending / joint.length * 2 * (g1 + g2);
    sums[joint.a] += k * g1, sums[joint.middle] += k * (g1 + g2), sums[joint.c] += k * g2;
  }
  for (std::size_t i = 0; i < sums.size(); ++i) over_mass[i] += sums[i] / nodes.mass[i];
}

std::size_t BarChain::ruptured() const {
  return static_cast<std::size_t>(
      std::count_if(links.begin(), links.end(), [this](const Segment& link) { return ruptured(link); }));
}

void BarChain::transfer(Archive& archive) {
  nodes.position.transfer(archive, "bar_position", nodes.owned);
  nodes.velocity.transfer(archive, "bar_velocity", nodes.owned);
  nodes.force.transfer(archive, "bar_force", nodes.owned);
  for (Segment& link : links) archive("bar_steel", link.steel);
  for (Hinge& joint : joints) archive("bar_hinge", joint.state);
  archive("bar_directions", directions);
}

} // namespace spall
