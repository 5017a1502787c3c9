#pragma once

#include "macro/scene/scene_inputs.h"

#include <map>
#include <string>

namespace spall {

/// Where a body with a shape is at the start.
struct Placed {
  Vec3 origin{};                  ///< of the shape's frame, m
  double lowest = 0, highest = 0; ///< z of its lowest and highest point, m; infinite where it has no end

  double thickness() const { return highest - lowest; }
};

/// The places of all bodies with a shape, by name.
/// @throws InputError: a body stands before or behind one that is not there, or behind itself by a detour.
/// `file` names the input in messages.
std::map<std::string, Placed> place_bodies(const SceneInputs& scene, const std::string& file);

/// Refuses bodies that overlap: a point of the surface of one lies inside the other by more than round-off.
/// @throws InputError
void check_overlaps(const SceneInputs& scene, const std::map<std::string, Placed>& places,
                    const std::string& file);

} // namespace spall
