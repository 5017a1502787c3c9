#include "macro/setup/scene_simulation.h"

namespace spall {
namespace {

/// The solid of a filled cylinder; conforming schemes get their cells.
std::unique_ptr<Solid> make_cylinder(const Material& material, Points points, const Cylinder& cylinder,
                                     const SymmetryPlanes& planes, SolidInputs numerics) {
  if (is_conforming(numerics.integration.scheme)) {
    const auto outline = cylinder_outline(cylinder.radius, cylinder.bottom, cylinder.height);
    numerics.cells = std::make_shared<const ConformingCells>(voronoi_cells(points, planes, outline));
    adopt_volumes(points, *numerics.cells);
  }
  return make_solid(material, std::move(points), planes, numerics);
}

std::unique_ptr<Solid> make_body(SceneInputs& scene, const SolidInputs& numerics) {
  const Cylinder cylinder = scene.cylinder(0);
  Points points = make_points(scene);
  Material material = scene.material.material();
  prepare(material, points.spacing);
  return make_cylinder(material, std::move(points), cylinder, scene.planes(), numerics);
}

std::unique_ptr<Solid> make_anvil(const SceneInputs& scene, const SolidInputs& numerics) {
  const AnvilInputs& anvil = scene.anvil;
  const Cylinder cylinder = anvil.cylinder(-scene.start_gap - anvil.height);
  return make_cylinder(anvil.j2, make_anvil_points(scene), cylinder, scene.planes(), numerics);
}

} // namespace

Simulation make_simulation(SceneInputs& scene, const RunInputs& inputs) {
  std::vector<std::unique_ptr<Solid>> solids;
  solids.push_back(make_body(scene, inputs.solid));
  if (scene.kind == SceneKind::taylor && scene.anvil.deformable) {
    solids.push_back(make_anvil(scene, inputs.solid));
    solids.back()->label = "anvil";
  }
  const bool slab = scene.kind == SceneKind::slab;
  if (slab && scene.witness.present) {
    const WitnessInputs& witness = scene.witness;
    solids.push_back(make_cylinder(witness.j2, witness.fill(scene.height, scene.planes()),
                                   witness.cylinder(scene.height), scene.planes(), inputs.solid));
    solids.back()->label = "witness";
    solids.back()->surface = witness.surface(scene.height, solids.back()->points);
  }
  if (slab && scene.projectile.is_deformable()) {
    const ProjectileInputs& projectile = scene.projectile;
    solids.push_back(make_solid(projectile.j2, projectile.fill(scene.planes(), scene.flight()),
                                scene.planes(), inputs.solid));
    solids.back()->label = "projectile";
    solids.back()->surface = projectile.surface(scene.planes(), scene.flight(), solids.back()->points);
  }
  Simulation run(std::move(solids), make_rigid_body(scene), scene.contact, inputs.time,
                 inputs.solid.integration);
  if (slab) run.exit.plane = scene.height;
  if (scene.culvert.present) run.culvert = make_culvert(scene, run.solids[0]->points, run.ranks());
  return run;
}

} // namespace spall
