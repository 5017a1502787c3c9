#pragma once

#include "macro/contact/contact_law.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace spall {

/// Makes the law for its pairs. The bodies are as they are at the start of the run, also when the run is then
/// loaded from a checkpoint. @throws InputError if the bodies do not allow it
using MakeContactLaw = std::function<std::unique_ptr<ContactLaw>(const ContactInputs& inputs,
                                                                 const std::vector<ContactPair>& pairs,
                                                                 const std::vector<ContactBody>& bodies)>;

/// Laws between deformable bodies by their words, in the order in which they act in a step. A new law is its
/// own file and one line here.
const std::vector<std::pair<std::string, MakeContactLaw>>& contact_laws();

/// Their words for the choice of an input.
std::vector<std::pair<std::string, std::string>> contact_law_words();

} // namespace spall
