#include "macro/contact/contact_zone.h"

#include "macro/contact/contact_normal.h"
#include "macro/contact/plane_moments.h"

#include <algorithm>
#include <cmath>

namespace spall {
namespace {

/// How far a patch and what hides it, or a support of overlapping kernels, reaches from a point, in extents
/// of its cell. Images farther behind a plane than that have no part in contact.
constexpr double image_reach = patch_radius + facing_radius;
static_assert(image_reach > contact_support);

/// Moves the values of one point between the arrays of its body and a message of numbers.
template<class Move> void transfer_point(Points& points, std::size_t i, Move& move) {
  for (VectorField* field : {&points.position, &points.velocity, &points.force, &points.initial_position})
    for (auto& component : field->component) move(component[i]);
  for (std::vector<double>* values : {&points.mass, &points.volume, &points.spacing}) move((*values)[i]);
}
constexpr std::size_t point_values = 15;
constexpr std::size_t record_size = 2 + point_values + 9; ///< with number, flag and deformation gradient

struct Writer {
  double* next;
  void operator()(const double& value) { *next++ = value; }
};
struct Reader {
  const double* next;
  void operator()(double& value) { value = *next++; }
};

} // namespace

void ContactZone::gather(const std::vector<ContactBody>& bodies, double margin) {
  if (parts.empty()) {
    for (const ContactBody& body : bodies) parts.push_back({.ghosts = Ghosts(body.ghosts->symmetry())});
    for (std::size_t b = 0; b < bodies.size(); ++b)
      if (bodies[b].surface) parts[b].surface = *bodies[b].surface;
  }
  choose(bodies, margin);
  join(bodies);
  add_images();
  views.clear();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    Part& part = parts[b];
    views.push_back({&part.points, &part.ghosts, bodies[b].bulk, bodies[b].shear,
                     part.surface ? &*part.surface : nullptr, &part.numbers});
  }
}

void ContactZone::choose(const std::vector<ContactBody>& bodies, double margin) {
  // Largest coordinates and, negative, smallest ones, and largest spacing of every body.
  std::vector<double> largest(7 * bodies.size(), -1e300);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Points& points = *bodies[b].points;
    double* of = &largest[7 * b];
    for (int c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < points.owned; ++i) {
        const double x = points.position.component[c][i];
        of[c] = std::max(of[c], x), of[3 + c] = std::max(of[3 + c], -x);
      }
    for (const double h : points.spacing) of[6] = std::max(of[6], h);
  }
  bodies.front().ghosts->processes().max(largest);

  for (std::size_t b = 0; b < bodies.size(); ++b) {
    std::vector<Bounds> boxes;
    for (std::size_t other = 0; other < bodies.size(); ++other) {
      if (other == b) continue;
      const double* of = &largest[7 * other];
      const double more = margin * std::max(of[6], largest[7 * b + 6]);
      boxes.push_back(
          {{-of[3] - more, -of[4] - more, -of[5] - more}, {of[0] + more, of[1] + more, of[2] + more}});
    }
    const Points& points = *bodies[b].points;
    parts[b].chosen.clear();
    for (std::size_t i = 0; i < points.owned; ++i) {
      const Vec3 x = points.position[i];
      if (std::any_of(boxes.begin(), boxes.end(), [&x](const Bounds& box) { return box.holds(x); }))
        parts[b].chosen.push_back(static_cast<std::uint32_t>(i));
    }
  }
}

void ContactZone::join(const std::vector<ContactBody>& bodies) {
  const Ranks& ranks = bodies.front().ghosts->processes();
  const auto count = static_cast<std::size_t>(ranks.count()), mine = static_cast<std::size_t>(ranks.rank());
  // Body by body and, in each, rank by rank: in the order of the numbers.
  std::vector<double> counts(bodies.size() * count);
  for (std::size_t b = 0; b < bodies.size(); ++b)
    counts[b * count + mine] = static_cast<double>(parts[b].chosen.size());
  ranks.sum(counts);
  std::size_t all = 0;
  std::vector<std::size_t> start;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (k % count == 0) start.push_back(all);
    if (k % count == mine) parts[k / count].first = all - start.back();
    all += static_cast<std::size_t>(counts[k]);
  }
  start.push_back(all);

  // Every rank fills its own part; the sum of all is the whole.
  std::vector<double> records(all * record_size);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    Points& points = *bodies[b].points;
    const Part& part = parts[b];
    Writer write{records.data() + (start[b] + part.first) * record_size};
    for (const std::uint32_t i : part.chosen) {
      write(static_cast<double>(bodies[b].ghosts->remote_points().first() + i));
      write(bodies[b].surface && bodies[b].surface->outermost[i]);
      transfer_point(points, i, write);
      for (const double f : points.deformation(i)) write(f);
    }
  }
  if (!records.empty()) ranks.sum(records);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    Part& part = parts[b];
    const std::size_t size = start[b + 1] - start[b];
    part.points.resize(size);
    part.points.surface_offset = bodies[b].points->surface_offset;
    part.numbers.resize(size);
    if (part.surface) part.surface->outermost.resize(size);
    Reader read{records.data() + start[b] * record_size};
    for (std::size_t i = 0; i < size; ++i) {
      double number = 0, outermost = 0;
      read(number), read(outermost);
      part.numbers[i] = static_cast<std::uint64_t>(number);
      if (part.surface) part.surface->outermost[i] = outermost > 0;
      transfer_point(part.points, i, read);
      for (double& f : part.points.reference[i]) read(f);
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
    for (std::size_t k = 0; k < part.chosen.size(); ++k) {
      bodies[b].points->velocity.set(part.chosen[k], part.points.velocity[part.first + k]);
      bodies[b].points->force.set(part.chosen[k], part.points.force[part.first + k]);
    }
  }
}

} // namespace spall
