#include "macro/setup/make_simulation.h"

#include "shared/error.h"

#include <numbers>

namespace spall {
namespace {

/// Makes the bodies of a simulation from those of a scene.
class Builder {
public:
  Builder(const SceneInputs& scene_, const RunInputs& inputs_)
      : scene(scene_), numerics(inputs_.solid), places(place_bodies(scene, "scene")) {}

  Bodies bodies() const {
    Bodies all;
    for (const std::string& name : scene.contact_order()) {
      const BodyInputs& body = *scene.find(name);
      all.solids.push_back(solid(body));
      if (body.support.kind == BodySupportKind::none) continue;
      all.supports.emplace_back(body.support, places.at(name).origin, all.solids.back()->points,
                                numerics.ranks, name);
      all.supports.back().solid = all.solids.size() - 1;
    }
    for (const BodyInputs& body : scene.bodies) {
      if (body.is_rigid()) {
        all.rigids.push_back(body.rigid_body(scene.planes(), places.at(body.name).origin));
        all.rigids.back().name = body.name;
      }
      if (body.model == BodyModel::ring) all.rings.push_back(ring(body, all));
    }
    return all;
  }

  Points points(const BodyInputs& body) const {
    return body.points(scene.planes(), places.at(body.name).origin);
  }

private:
  std::unique_ptr<Solid> solid(const BodyInputs& body) const {
    Points filled = points(body);
    SolidInputs inputs = numerics;
    if (is_conforming(inputs.integration.scheme)) {
      const Placed& place = places.at(body.name);
      inputs.cells = std::make_shared<const ConformingCells>(
          voronoi_cells(filled, scene.planes(), outline_of(body, place)));
      adopt_volumes(filled, *inputs.cells);
    }
    Material material = body.material.material();
    prepare(material, filled.spacing);
    std::optional<KnownSurface> surface;
    if (body.known_surface)
      surface = known_surface(body.solid_shape(), matrix_of(body.motion.orientation()),
                              places.at(body.name).origin, filled);
    std::unique_ptr<Solid> made = make_solid(material, std::move(filled), scene.planes(), inputs);
    made->label = body.name;
    if (surface) {
      made->surface = surface;
      made->surface->mark(made->points); // marks this rank's points on the surface
    }
    return made;
  }

  /// Returns half spaces whose intersection is the body. @throws InputError for a shape that is no such
  /// intersection
  static std::vector<HalfSpace> outline_of(const BodyInputs& body, const Placed& place) {
    const Shape shape = body.solid_shape();
    if (const Cylinder* cylinder = std::get_if<Cylinder>(&shape); cylinder && cylinder->hole == 0)
      return cylinder_outline(cylinder->radius, place.lowest, cylinder->height);
    throw InputError("scene: key '" + body.name + "/Shape': SCNI and M-SCNI need a cylinder without a hole");
  }

  ElasticRing ring(const BodyInputs& body, const Bodies& all) const {
    const BodyInputs& inside = *scene.find(body.around);
    const Placed& place = places.at(body.around);
    const double radius = extent(inside.solid_shape(), {1, 0, 0});
    const double area = 2 * std::numbers::pi * radius * place.thickness() / scene.planes().multiplicity();
    const std::size_t around = all.index(body.around);
    ElasticRing made(body.ring, all.solids[around]->points, radius, area, numerics.ranks);
    made.name = body.name;
    made.solid = around;
    return made;
  }

  const SceneInputs& scene;
  const SolidInputs& numerics;
  std::map<std::string, Placed> places;
};

} // namespace

Points make_points(const SceneInputs& scene, const std::string& name) {
  return Builder(scene, {}).points(*scene.find(name));
}

Simulation make_simulation(const SceneInputs& scene, const RunInputs& inputs) {
  ContactInputs contact = scene.contact;
  for (const BodyInputs& body : scene.bodies)
    if (body.is_deformable() && !body.bonded_to.empty())
      contact.bonded.emplace_back(body.name, body.bonded_to);
  return {Builder(scene, inputs).bodies(), contact, inputs.time, inputs.solid.integration};
}

} // namespace spall
