#pragma once

#include "macro/dynamics/simulation.h"
#include "macro/output/evaluation.h"
#include "macro/output/fragments.h"
#include "macro/output/numerical_error.h"
#include "macro/output/settlement.h"
#include "macro/output/until.h"
#include "macro/scene/scene_inputs.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace spall {

/// Base class of the answers about one deformable body, `BODY`: they have no second body, no fragments, and
/// no state that is collected from step to step. Their numerical error is not measured unless they say so.
class BodyAnswer {
public:
  static constexpr const char* separator = "";

  void follow(const Simulation&) {}
  void write_tables(const std::filesystem::path&, const std::string&) const {}
  void transfer(Archive&) {}

  const std::string& moving() const { return body; }
  const std::string& main() const { return body; }
  bool has_fragments() const { return false; }
  std::optional<NumericalError> numerical_error(const Simulation&) const { return std::nullopt; }

protected:
  explicit BodyAnswer(const std::string& body_) : body(body_) {}

  /// Returns the body's inputs. @param question key of the section Answers
  /// @throws InputError if the scene has no deformable body of that name
  const BodyInputs& inputs_of_body(const char* question, const SceneInputs& scene,
                                   const std::string& file) const;

  std::string body;
};

} // namespace spall
