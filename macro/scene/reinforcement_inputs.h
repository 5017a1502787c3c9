#pragma once

#include "macro/points/ghosts.h"
#include "macro/reinforcement/reinforcement.h"
#include "macro/shape/shape.h"
#include "shared/input/parameters.h"

#include <string>
#include <vector>

namespace spall {

/// Which faces of a body have a mesh of bars. The front is the lower face, where a projectile comes from.
enum class MeshFaces { none, front, back, both };
/// Along which axes the bars of a mesh lie.
enum class MeshDirection { x, y, both };

/// Meshes of reinforcing bars, as the keys of the section Reinforcement of a body.
struct ReinforcementInputs {
  MeshFaces faces = MeshFaces::none;
  MeshDirection direction = MeshDirection::both;
  double diameter = required; ///< of a bar, m
  double spacing = required;  ///< between the axes of neighbouring bars, m
  double cover = required;    ///< of concrete over the outer bars, also at the sides of the body, m
  double offset = 0;          ///< distance of a bar from the axis of the body, m
  BarSteel steel;
  BondLaw bond;

  bool present() const { return faces != MeshFaces::none; }
  void declare(Parameters& parameters, const std::string& section, const Needed& needed);
  /// @param shape of the body. @throws InputError: one line with file, key, found and allowed
  void validate(const std::string& file, const std::string& section, const Shape& shape,
                const SymmetryPlanes& planes) const;
  /// The bars in a body of this shape whose frame has its origin there, m: the part of them that is modelled.
  std::vector<BarLine> lines(const Shape& shape, const SymmetryPlanes& planes, const Vec3& origin) const;

private:
  /// Half of the length of a bar along an axis (0: x, 1: y) at a distance from the axis of the body, m.
  double half_length(const Shape& shape, int along, double distance) const;
  void add_layer(std::vector<BarLine>& all, const Shape& shape, const SymmetryPlanes& planes,
                 const Vec3& origin, int along, double z) const;
  void validate_places(const std::string& file, const std::string& section, const Shape& shape,
                       const SymmetryPlanes& planes) const;
};

} // namespace spall
