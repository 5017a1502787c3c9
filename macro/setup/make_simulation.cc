#include "macro/setup/make_simulation.h"

#include "macro/points/neighbor_search.h"
#include "macro/points/parallel.h"
#include "shared/error.h"
#include "shared/input/quantity.h"

#include <algorithm>
#include <cmath>
#include <limits>
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
      if (body.reinforcement.present()) all.reinforcements.push_back(reinforcement(body, all));
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

  /// Returns the bars in the body that has been made last. @throws InputError if bars are closer to each
  /// other than the points of the body
  Reinforcement reinforcement(const BodyInputs& body, const Bodies& all) const {
    const ReinforcementInputs& inputs = body.reinforcement;
    const Points filled = points(body); // of the whole body, on every rank
    const Solid& host = *all.solids.back();
    const double support = numerics.approximation.support.normalized_size,
                 finest = *std::min_element(filled.spacing.begin(), filled.spacing.end());
    ReinforcementDesign design{
        .lines = inputs.lines(body.solid_shape(), scene.planes(), places.at(body.name).origin),
        .diameter = inputs.diameter,
        .node_spacing = finest,
        .steel = inputs.steel,
        .bond = inputs.bond};
    const std::vector<double> spacings = spacings_at(Reinforcement::places(design, scene.planes()), filled);
    const double coarsest = *std::max_element(spacings.begin(), spacings.end());
    if (inputs.spacing < coarsest)
      throw InputError("scene: key '" + body.name + "/Reinforcement/Spacing': found " +
                       format_quantity(inputs.spacing, Dimension::length) +
                       ", allowed: at least the spacing of the points around the bars, " +
                       format_quantity(coarsest, Dimension::length));
    if (std::isnan(design.bond.stiffness))
      design.bond.stiffness =
          BondLaw::elastic_stiffness(host.shear_modulus(), 0.5 * inputs.diameter, 0.5 * support * finest);
    std::vector<double> radius;
    for (const double spacing : spacings) radius.push_back(support * spacing);
    Reinforcement made(design, radius, numerics.approximation.profile, scene.planes(), numerics.ranks,
                       body.motion.velocity_vector());
    made.name = body.name + " bars";
    made.solid = all.solids.size() - 1;
    made.connect(host.points);
    return made;
  }

  /// Returns the spacing of the point that is nearest to each place, m.
  static std::vector<double> spacings_at(const VectorField& at, const Points& points) {
    const auto [fine, coarse] = std::minmax_element(points.spacing.begin(), points.spacing.end());
    NeighborSearch search;
    search.rebuild(points, *fine);
    std::vector<double> spacings(at.component[0].size(), *coarse);
    for_each_index(spacings.size(), [&](std::size_t k) {
      double nearest = std::numeric_limits<double>::infinity();
      search.for_each_in_box(at[k], {2 * *coarse, 2 * *coarse, 2 * *coarse},
                             [&](std::uint32_t i, double x, double y, double z) {
                               const double square = x * x + y * y + z * z;
                               if (square < nearest) nearest = square, spacings[k] = points.spacing[i];
                             });
    });
    return spacings;
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
