#include "macro/output/body_answer.h"

#include "shared/error.h"

namespace spall {

const BodyInputs& BodyAnswer::inputs_of_body(const char* question, const SceneInputs& scene,
                                             const std::string& file) const {
  const BodyInputs* inputs = scene.find(body);
  if (inputs == nullptr || !inputs->is_deformable())
    throw InputError(file + ": key 'Answers/" + question + "': found '" + body +
                     "', allowed: the name of a deformable body of the scene");
  return *inputs;
}

} // namespace spall
