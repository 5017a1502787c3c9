#include "macro/contact/contact_laws.h"

#include "macro/contact/bonded_contact.h"
#include "macro/contact/kernel_contact.h"
#include "macro/contact/surface_contact.h"

namespace spall {
namespace {

template<class Law>
std::unique_ptr<ContactLaw> make(const ContactInputs& inputs, const std::vector<ContactPair>& pairs,
                                 const std::vector<ContactBody>& bodies) {
  return std::make_unique<Law>(inputs, pairs, bodies);
}

} // namespace

const std::vector<std::pair<std::string, MakeContactLaw>>& contact_laws() {
  // The bonding law acts last, so that bonded points have exactly equal velocities at the end of the step.
  static const std::vector<std::pair<std::string, MakeContactLaw>> laws = {
      {"surface", make<SurfaceContact>}, {"kernel", make<KernelContact>}, {"bonded", make<BondedContact>}};
  return laws;
}

std::vector<std::pair<std::string, std::string>> contact_law_words() {
  std::vector<std::pair<std::string, std::string>> words;
  for (const auto& [word, make_law] : contact_laws()) words.emplace_back(word, word);
  return words;
}

} // namespace spall
