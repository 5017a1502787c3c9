#include "macro/scene_simulation.h"

namespace spall {
namespace {

std::unique_ptr<Solid> make_body(SceneInputs& scene, const SolidInputs& numerics) {
  Points points = make_points(scene);
  if (scene.law == Law::J2) return make_solid(scene.j2, std::move(points), scene.planes(), numerics);
  scene.afc.load(points.spacing.front());
  return make_solid(scene.afc, std::move(points), scene.planes(), numerics);
}

} // namespace

Simulation make_simulation(SceneInputs& scene, const RunInputs& inputs) {
  std::vector<std::unique_ptr<Solid>> solids;
  solids.push_back(make_body(scene, inputs.solid));
  if (scene.kind == SceneKind::taylor && scene.anvil.deformable) {
    solids.push_back(make_solid(scene.anvil.j2, make_anvil_points(scene), scene.planes(), inputs.solid));
    solids.back()->label = "anvil";
  }
  return {std::move(solids), make_rigid_body(scene), scene.contact, inputs.time, inputs.solid.integration};
}

} // namespace spall
