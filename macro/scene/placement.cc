#include "macro/scene/placement.h"

#include "macro/shape/sizes.h"
#include "shared/error.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace spall {
namespace {

/// Places bodies one after the other, those first that others refer to.
class Placer {
public:
  Placer(const SceneInputs& scene_, const std::string& file_) : scene(scene_), file(file_) {}

  const Placed& place(const BodyInputs& body) {
    if (const auto found = places.find(body.name); found != places.end()) return found->second;
    if (!waiting.insert(body.name).second)
      throw InputError(file + ": key '" + body.name +
                       "/Behind' or 'Before': the body stands behind or before itself");
    Placed placed = at_origin(body);
    const PlaceInputs& p = body.place;
    double shift = p.lowest - placed.lowest;
    if (!p.behind.empty()) shift = neighbour(body, "Behind", p.behind).highest + p.gap - placed.lowest;
    if (!p.before.empty()) shift = neighbour(body, "Before", p.before).lowest - p.gap - placed.highest;
    placed.origin = {p.offset_x, p.offset_y, shift};
    placed.lowest += shift, placed.highest += shift;
    if (!std::isfinite(shift))
      throw InputError(file + ": key '" + body.name +
                       "/Before': the place has no end on that side, allowed: Before for a half space");
    waiting.erase(body.name);
    return places[body.name] = placed;
  }

  std::map<std::string, Placed> places;

private:
  static Placed at_origin(const BodyInputs& body) {
    const Shape shape = body.solid_shape();
    const Mat3 axes = matrix_of(body.motion.orientation());
    return {.origin = {},
            .lowest = -extent(shape, times_transposed(axes, {0, 0, -1})),
            .highest = extent(shape, times_transposed(axes, {0, 0, 1}))};
  }
  const Placed& neighbour(const BodyInputs& body, const char* key, const std::string& name) {
    const BodyInputs* other = scene.find(name);
    if (other == nullptr || !other->has_shape())
      throw InputError(file + ": key '" + body.name + "/" + key + "': found '" + name +
                       "', allowed: the name of a deformable or rigid body of the scene");
    return place(*other);
  }

  const SceneInputs& scene;
  const std::string& file;
  std::set<std::string> waiting;
};

/// Depth from which points count as inside another body, as a part of the body's size: above the round-off of
/// places.
constexpr double overlap_tolerance = 1e-9;

/// Samples along a body at most: of a body that is much larger than the other one some are left out.
constexpr double most_samples_along = 2000;

/// A point of the surface of one body inside the other: its depth, m; 0 if there is none.
double deepest(const BodyInputs& a, const Placed& at, const BodyInputs& b, const Placed& there) {
  const Shape one = a.solid_shape(), other = b.solid_shape();
  const Mat3 turned = matrix_of(a.motion.orientation()), axes = matrix_of(b.motion.orientation());
  double depth = 0;
  const double size = std::min(smallest_size(one), smallest_size(other));
  for (const Vec3& x : samples_for(one, size, most_samples_along)) {
    const Vec3 seen = times_transposed(axes, at.origin + times(turned, x) - there.origin);
    if (lower_bound(other, seen) < 0) depth = std::max(depth, -surface(other, seen).distance);
  }
  return depth;
}

/// The ball around a body, in space.
BoundingBall ball_around(const BodyInputs& body, const Placed& at) {
  const BoundingBall ball = bounding_ball(body.solid_shape());
  return {at.origin + times(matrix_of(body.motion.orientation()), ball.centre), ball.radius};
}

} // namespace

std::map<std::string, Placed> place_bodies(const SceneInputs& scene, const std::string& file) {
  Placer placer(scene, file);
  for (const BodyInputs& body : scene.bodies)
    if (body.has_shape()) placer.place(body);
  return std::move(placer.places);
}

void check_overlaps(const SceneInputs& scene, const std::map<std::string, Placed>& places,
                    const std::string& file) {
  std::vector<const BodyInputs*> list;
  std::vector<BoundingBall> balls;
  for (const BodyInputs& body : scene.bodies)
    if (body.has_shape()) list.push_back(&body), balls.push_back(ball_around(body, places.at(body.name)));
  for (std::size_t a = 0; a < list.size(); ++a)
    for (std::size_t b = a + 1; b < list.size(); ++b) {
      const Placed &one = places.at(list[a]->name), &other = places.at(list[b]->name);
      if (norm(balls[a].centre - balls[b].centre) > balls[a].radius + balls[b].radius) continue;
      const double depth =
          std::max(deepest(*list[a], one, *list[b], other), deepest(*list[b], other, *list[a], one));
      const double size = std::min(one.thickness(), other.thickness());
      if (depth > overlap_tolerance * size)
        throw InputError(file + ": the bodies '" + list[a]->name + "' and '" + list[b]->name +
                         "' overlap by " + format_quantity(depth, Dimension::length) + " at the start");
    }
}

} // namespace spall
