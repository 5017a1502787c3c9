#include "macro/output/evaluation.h"

#include "shared/error.h"

namespace spall {

bool evaluate(const std::string& what, const std::function<void()>& evaluation, Warnings& warnings,
              const Ranks& ranks) {
  try {
    evaluation();
    return true;
  } catch (const InputError& error) {
    warnings.push_back(what + ": " + error.what());
  } catch (const ComputationError& error) {
    warnings.push_back(what + ": " + error.what());
  } catch (const std::exception& error) {
    if (ranks.several()) throw;
    warnings.push_back(what + ": " + error.what());
  }
  return false;
}

} // namespace spall
