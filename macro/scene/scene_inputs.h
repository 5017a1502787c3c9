#pragma once

#include "macro/contact/contact_inputs.h"
#include "macro/scene/body_inputs.h"

#include <deque>
#include <string>
#include <vector>

namespace spall {

/// The physical part of a scene file: a list of bodies, and how they touch. Every section that is not one of
/// the program's own (`own_sections`) is a body of that name.
struct SceneInputs {
  std::vector<std::string> symmetry; ///< "x", "y": planes through the axis; "axis"; "none"
  std::deque<BodyInputs>
      bodies;        ///< in the order of the file; at fixed places, as parameters are bound to them
  std::string order; ///< names of bodies in the order of contact; the others follow in the order of the file
  ContactInputs contact;

  /// Names of the sections of a scene file that are no bodies.
  static const std::vector<std::string>& own_sections();
  /// Finds the bodies of an input. @param overrides of the command line, which may name further ones
  /// @throws InputError: a name used twice in one file, or that differs from another one only by capitals.
  void find_bodies(const InputText& text, const std::vector<std::string>& overrides);
  /// Binds the keys of the scene and of the bodies found. Lives as long as `parameters` is used.
  void declare(Parameters& parameters);
  /// Adds the bodies that clouds of fragments stand for, after the keys have been read. @throws InputError
  void add_fragments(const std::string& file);
  /// Checks that go beyond one key. @throws InputError. `file` names the input in messages.
  void validate(const std::string& file) const;

  SymmetryPlanes planes() const;
  /// Null if there is no such body, or if it is left out (Model = none).
  const BodyInputs* find(const std::string& name) const;
  /// Names of the deformable bodies in the order of contact: of two, the earlier one touches with its points
  /// and the later one with its surface, so that what breaks comes first and what stays whole last.
  std::vector<std::string> contact_order() const;
};

} // namespace spall
