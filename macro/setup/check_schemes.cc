#include "macro/setup/check_schemes.h"

#include "shared/error.h"

namespace spall {

void check_schemes(const SceneInputs& scene, const RunInputs& inputs, const std::string& file) {
  const Scheme scheme = inputs.solid.integration.scheme;
  if (scheme == Scheme::subpoint || inputs.accept_unverified_scheme) return;
  for (const BodyInputs& body : scene.bodies)
    if (body.is_deformable() && body.material.softens())
      throw InputError(
          file + ": key 'Integration/Scheme': found '" + name_of(scheme) + "', but the body '" + body.name +
          "' softens; allowed: " + name_of(Scheme::subpoint) +
          ". The other schemes miss converged finite elements there or do not converge "
          "(data/studies/README.md); to compare them, set Integration/Unverified scheme = accept");
}

} // namespace spall
