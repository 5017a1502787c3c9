#include "macro/scene/scene_inputs.h"

#include "macro/contact/contact_laws.h"
#include "macro/scene/fragment_cloud.h"
#include "macro/scene/placement.h"
#include "shared/error.h"
#include "shared/input/words.h"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace spall {
namespace {

void declare_friction(Parameters& parameters, Friction& friction) {
  auto section = parameters.section("Contact");
  section.number("Friction", friction.at_rest, {0, 10},
                 "Coulomb coefficient between bodies, rigid or deformable");
  auto never = parameters.section("Contact", Needed::never());
  never.number(
      "Sliding friction", friction.sliding, {0, 10},
      "coefficient at large slip velocities; from Friction it falls to this one exponentially. Unset: "
      "Friction at any velocity");
  auto falling = parameters.section(
      "Contact", Needed{[&] { return friction.depends_on_velocity(); }, "Sliding friction is set"});
  falling.quantity("Friction decay velocity", friction.decay_velocity, Dimension::velocity, {1e-3, 1e5},
                   "slip velocity over which the difference falls to 1 / e");
  never.quantity(
      "Largest friction stress", friction.largest_stress, Dimension::stress, {0, 1e12},
      "largest tangential stress of friction: shear strength of the softer face, or of what melts or "
      "is ground to powder there. Unset: none");
}

void declare_contact(Parameters& parameters, ContactInputs& contact) {
  auto section = parameters.section("Contact");
  section.choice(
      "Scheme", contact.law, contact_law_words(),
      "between deformable bodies. surface: impulses between the points of the secondary body and the surface "
      "of the primary one; kernel: forces where kernels overlap (paper, section 2.3)");
  section.choice("Normal", contact.normal, contact_normal_names,
                 "of the kernel scheme. level set: gradient of the joint approximation (paper Eqs. 17-19); "
                 "pair direction: between "
                 "the points of a pair. The surface scheme uses the normal of the surface");
  section.choice(
      "Touching part", contact.touching, touching_part_names,
      "of a cell, with a rigid body. cell: its present extent; solid: that over J where it has opened, for "
      "projectiles that go deep into a target");
  declare_friction(parameters, contact.friction);
  section.number("Overlap release", contact.overlap_release, {0, 1},
                 "part of an existing overlap that is taken back per step");
  section.quantity("Release speed", contact.release_speed, Dimension::velocity, {0, 1e4},
                   "largest velocity at which it is taken back: points pushed out keep it");
}

template<class List, class Value> bool holds(const List& list, const Value& value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

} // namespace

const std::vector<std::string>& SceneInputs::own_sections() {
  static const std::vector<std::string> names = {"Scene",   "Approximation", "Integration", "Contact",
                                                 "Answers", "Time",          "Output",      "Run"};
  return names;
}

void SceneInputs::find_bodies(const InputText& text, const std::vector<std::string>& overrides) {
  std::map<std::string, InputText::Opening> first; // by name in small letters
  const auto add = [&](const InputText::Opening& opening) {
    const std::string path = opening.path, name = path.substr(0, path.find('/'));
    if (path == name + "/Material")
      for (BodyInputs& body : bodies) body.has_material |= body.name == name;
    if (path != name || holds(own_sections(), name)) return;
    const std::string where = opening.file.string() + ":" + std::to_string(opening.line);
    const auto [known, is_new] = first.try_emplace(lower_case(name), opening);
    if (is_new) {
      bodies.emplace_back(name);
    } else if (known->second.path != name) {
      throw InputError(where + ": the body '" + name + "' differs from '" + known->second.path +
                       "' only by capitals");
    } else if (known->second.file == opening.file && known->second.line != opening.line) {
      throw InputError(where + ": the body '" + name + "' is named a second time; it stands in line " +
                       std::to_string(known->second.line) + " already");
    }
    known->second = opening; // a file may change the bodies of those that it includes
  };
  for (const InputText::Opening& opening : text.openings) add(opening);
  for (BodyInputs& body : bodies) {
    for (const InputText::Setting& setting : text.settings)
      body.has_material |= setting.section == body.name + "/Material";
    for (const std::string& word : overrides) body.has_material |= word.starts_with(body.name + "/Material/");
  }
}

void SceneInputs::declare(Parameters& parameters) {
  auto scene = parameters.section("Scene");
  scene.words(
      "Symmetry planes", symmetry, {"none", "x", "y", "axis"},
      "planes through the z axis of which only the positive side is modelled: none, x, y or x, y; axis: "
      "rotational symmetry, one half plane of points that stand for rings");
  for (BodyInputs& body : bodies) body.declare(parameters);

  auto touch = parameters.section("Contact");
  touch.text(
      "Order", order,
      "names of the deformable bodies, separated by commas: of two bodies the earlier one touches with its "
      "points (secondary surface), the later one with its surface (primary surface). What breaks comes "
      "first, "
      "what stays whole last; empty: the order of the file");
  declare_contact(parameters, contact);
}

void SceneInputs::add_fragments(const std::string& file) {
  std::vector<BodyInputs> all;
  for (const BodyInputs& body : bodies) {
    if (!body.is_cloud()) continue;
    for (BodyInputs& fragment : fragments_of(body, planes(), file)) {
      if (find(fragment.name) != nullptr)
        throw InputError(file + ": the body '" + fragment.name + "' has the name of a fragment of '" +
                         body.name + "'");
      all.push_back(std::move(fragment));
    }
  }
  for (BodyInputs& fragment : all) bodies.push_back(std::move(fragment));
}

void SceneInputs::validate(const std::string& file) const {
  if (std::none_of(bodies.begin(), bodies.end(), [](const BodyInputs& b) { return b.is_deformable(); }))
    throw InputError(
        file + ": the scene has no deformable body: a section with the name of a body and the key Model");
  for (const char* alone : {"none", "axis"})
    if (symmetry.size() > 1 && holds(symmetry, alone))
      throw InputError(file + ": key 'Scene/Symmetry planes': '" + alone + "' stands alone");
  for (const BodyInputs& body : bodies) {
    body.validate(file, planes());
    for (const auto& [key, name] :
         {std::pair("Bonded to", body.bonded_to), std::pair("Around", body.around)}) {
      if (name.empty() || body.model == BodyModel::none) continue;
      const BodyInputs* other = find(name);
      if (other == nullptr || !other->is_deformable() || other == &body)
        throw InputError(file + ": key '" + body.name + "/" + key + "': found '" + name +
                         "', allowed: the name of another deformable body of the scene");
    }
  }
  try {
    list_of(order);
  } catch (const std::invalid_argument& error) {
    throw InputError(file + ": key 'Contact/Order': found '" + order +
                     "', allowed: names between commas, each once (" + error.what() + ")");
  }
  for (const std::string& name : split(order))
    if (std::none_of(bodies.begin(), bodies.end(), [&](const BodyInputs& body) { return body.name == name; }))
      throw InputError(file + ": key 'Contact/Order': found '" + name + "', which is no body of the scene");
  if (contact.law == "kernel" && contact.friction.depends_on_velocity())
    throw InputError(file + ": key 'Contact/Sliding friction': found " +
                     format_quantity(contact.friction.sliding, Dimension::none) +
                     ", allowed: unset with Scheme = kernel, whose tractions know no velocity");
  check_overlaps(*this, place_bodies(*this, file), file);
}

SymmetryPlanes SceneInputs::planes() const {
  return {.normal = {holds(symmetry, "x"), holds(symmetry, "y"), false}, .axis = holds(symmetry, "axis")};
}

const BodyInputs* SceneInputs::find(const std::string& name) const {
  for (const BodyInputs& body : bodies)
    if (body.name == name && body.model != BodyModel::none) return &body;
  return nullptr;
}

std::vector<std::string> SceneInputs::contact_order() const {
  std::vector<std::string> names;
  for (const std::string& name : split(order))
    if (const BodyInputs* body = find(name); body && body->is_deformable()) names.push_back(name);
  for (const BodyInputs& body : bodies)
    if (body.is_deformable() && !holds(names, body.name)) names.push_back(body.name);
  return names;
}

} // namespace spall
