#include "macro/contact/contact_zone.h"

#include "macro/contact/contact_normal.h"
#include "macro/contact/plane_moments.h"
#include "shared/traffic.h"

#include <algorithm>
#include <cmath>

namespace spall {
namespace {

/// Reach of contact from a point, in extents of its cell: that of a patch with the points that may hide it,
/// or of the support of overlapping kernels. Images farther behind a symmetry plane do not take part in
/// contact.
constexpr double image_reach = patch_radius + facing_radius;
static_assert(image_reach > contact_support);

/// The data of a point that contact needs.
struct Record {
  std::uint64_t body, number, outermost;
  Vec3 position, velocity, force, initial_position;
  double mass, volume, spacing;
  Mat3 deformation;
};

Record record_of(const ContactBody& body, std::size_t b, std::size_t i, std::uint64_t first_number) {
  const Points& p = *body.points;
  return {.body = b,
          .number = first_number + i,
          .outermost = body.surface && body.surface->outermost[i],
          .position = p.position[i],
          .velocity = p.velocity[i],
          .force = p.force[i],
          .initial_position = p.initial_position[i],
          .mass = p.mass[i],
          .volume = p.volume[i],
          .spacing = p.spacing[i],
          .deformation = p.deformation(i)};
}

void set_point(Points& points, std::size_t i, const Record& record) {
  points.position.set(i, record.position);
  points.velocity.set(i, record.velocity);
  points.force.set(i, record.force);
  points.initial_position.set(i, record.initial_position);
  points.mass[i] = record.mass;
  points.volume[i] = record.volume;
  points.spacing[i] = record.spacing;
  points.reference[i] = record.deformation;
}

bool are_pair(std::size_t a, std::size_t b, const std::vector<ContactPair>& pairs) {
  return std::any_of(pairs.begin(), pairs.end(), [&](const ContactPair& pair) {
    return (pair.secondary == a && pair.primary == b) || (pair.secondary == b && pair.primary == a);
  });
}

/// Chooses the points of the bodies that lie inside the boxes around the other bodies of their pairs.
std::vector<Record> choose(const std::vector<ContactBody>& bodies, const std::vector<ContactPair>& pairs,
                           double margin, const std::vector<std::uint64_t>& first_numbers) {
  // For each body: its largest coordinates, its smallest coordinates with the opposite sign, and its largest
  // spacing.
  std::vector<double> largest(7 * bodies.size(), -1e300);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Points& points = *bodies[b].points;
    double* of = &largest[7 * b];
    for (int c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < points.owned; ++i) {
        const double x = points.position.component[c][i];
        of[c] = std::max(of[c], x), of[3 + c] = std::max(of[3 + c], -x);
      }
    of[6] = largest_spacing(points);
  }
  bodies.front().ghosts->processes().max(largest);

  std::vector<Record> chosen;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    std::vector<Bounds> boxes;
    for (std::size_t other = 0; other < bodies.size(); ++other) {
      if (!are_pair(b, other, pairs)) continue;
      const double* of = &largest[7 * other];
      const double more = margin * std::max(of[6], largest[7 * b + 6]);
      boxes.push_back(
          {{-of[3] - more, -of[4] - more, -of[5] - more}, {of[0] + more, of[1] + more, of[2] + more}});
    }
    const Points& points = *bodies[b].points;
    for (std::size_t i = 0; i < points.owned; ++i) {
      const Vec3 x = points.position[i];
      if (std::any_of(boxes.begin(), boxes.end(), [&x](const Bounds& box) { return box.holds(x); }))
        chosen.push_back(record_of(bodies[b], b, i, first_numbers[b]));
    }
  }
  return chosen;
}

} // namespace

void ContactZone::gather(const std::vector<ContactBody>& bodies, const std::vector<ContactPair>& pairs,
                         double margin) {
  std::vector<std::uint64_t> first_numbers;
  for (const ContactBody& body : bodies) first_numbers.push_back(body.ghosts->remote_points().first());
  gather(bodies, pairs, margin, first_numbers);
}

void ContactZone::gather_at_start(const std::vector<ContactBody>& bodies,
                                  const std::vector<ContactPair>& pairs, double margin) {
  std::vector<std::uint64_t> first_numbers;
  for (const ContactBody& body : bodies)
    first_numbers.push_back(body.ghosts->processes().share(body.points->owned).first);
  gather(bodies, pairs, margin, first_numbers);
}

void ContactZone::gather(const std::vector<ContactBody>& bodies, const std::vector<ContactPair>& pairs,
                         double margin, const std::vector<std::uint64_t>& first_numbers) {
  const TrafficOf use(MpiUse::contact);
  if (parts.empty()) {
    for (const ContactBody& body : bodies) parts.push_back({.ghosts = Ghosts(body.ghosts->symmetry())});
    for (std::size_t b = 0; b < bodies.size(); ++b)
      if (bodies[b].surface) parts[b].surface = *bodies[b].surface;
  }
  fill(bodies, pairs, margin, first_numbers);
  add_images();
  views.clear();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    Part& part = parts[b];
    views.push_back({&part.points, &part.ghosts, bodies[b].bulk, bodies[b].shear,
                     part.surface ? &*part.surface : nullptr, &part.numbers});
  }
}

void ContactZone::fill(const std::vector<ContactBody>& bodies, const std::vector<ContactPair>& pairs,
                       double margin, const std::vector<std::uint64_t>& first_numbers) {
  const std::vector<Record> records =
      bodies.front().ghosts->processes().join(choose(bodies, pairs, margin, first_numbers));
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    Part& part = parts[b];
    // The numbers of a rank are ascending, and so are those of consecutive ranks.
    part.numbers.clear();
    for (const Record& record : records)
      if (record.body == b) part.numbers.push_back(record.number);
    part.points.resize(part.numbers.size());
    part.points.surface_offset = bodies[b].points->surface_offset;
    if (part.surface) part.surface->outermost.resize(part.numbers.size());
    std::size_t i = 0;
    for (const Record& record : records) {
      if (record.body != b) continue;
      set_point(part.points, i, record);
      if (part.surface) part.surface->outermost[i] = record.outermost;
      ++i;
    }
  }
}

void ContactZone::add_images() {
  double extent = 0;
  for (const Part& part : parts)
    for (std::size_t i = 0; i < part.points.owned; ++i)
      extent = std::max(
          extent, part.points.spacing[i] *
                      std::min(largest_cell_stretch,
                               std::sqrt(largest_eigenvalue(times_transpose(part.points.reference[i])))));
  const double reach = image_reach * extent;
  for (Part& part : parts) part.ghosts.rebuild(part.points, {reach, reach, reach});
}

void ContactZone::give_back(const std::vector<ContactBody>& bodies) const {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Part& part = parts[b];
    Points& points = *bodies[b].points;
    const std::uint64_t first = bodies[b].ghosts->remote_points().first();
    const auto place = [&](std::uint64_t number) {
      return std::lower_bound(part.numbers.begin(), part.numbers.end(), number) - part.numbers.begin();
    };
    const auto end = static_cast<std::size_t>(place(first + points.owned));
    for (auto k = static_cast<std::size_t>(place(first)); k < end; ++k) {
      points.velocity.set(part.numbers[k] - first, part.points.velocity[k]);
      points.force.set(part.numbers[k] - first, part.points.force[k]);
    }
  }
}

} // namespace spall
