#include "macro/scene/reinforcement_inputs.h"

#include "shared/error.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace spall {
namespace {

std::string length(double value) { return format_quantity(value, Dimension::length); }

/// Gives a function that refuses the value of a key.
auto refusal(const std::string& file, const std::string& section) {
  return [file, section](const std::string& key, const std::string& why) {
    throw InputError(file + ": key '" + section + "/" + key + "': " + why);
  };
}

} // namespace

void ReinforcementInputs::declare(Parameters& parameters, const std::string& name, const Needed& needed) {
  static const Choices<MeshFaces> all_faces = {{"none", MeshFaces::none},
                                               {"front", MeshFaces::front},
                                               {"back", MeshFaces::back},
                                               {"both", MeshFaces::both}};
  static const Choices<BondKind> kinds = {{"rigid", BondKind::rigid}, {"slip", BondKind::slip}};
  auto section = parameters.section(name);
  section.choice("Faces", faces, all_faces,
                 "at which faces of a slab or block there is a mesh of bars: front is the lower face, where "
                 "projectiles come from");
  section.choice("Direction", direction,
                 {{"both", MeshDirection::both}, {"x", MeshDirection::x}, {"y", MeshDirection::y}},
                 "along which axis the bars lie; both: those along y lie inside of those along x");
  const Needed if_there =
      needed_if("Faces", faces, all_faces, {MeshFaces::front, MeshFaces::back, MeshFaces::both}) && needed;
  auto mesh = parameters.section(name, if_there);
  mesh.quantity("Bar diameter", diameter, Dimension::length, {above_zero, 1}, "of the bars");
  mesh.quantity("Spacing", spacing, Dimension::length, {above_zero, 1e3},
                "between the axes of neighbouring bars");
  mesh.quantity("Cover", cover, Dimension::length, {above_zero, 1e3},
                "of concrete, from the face to the outer bars, and from the side to the ends of the bars");
  section.quantity("Offset", offset, Dimension::length, {0, 1e3},
                   "distance of a bar from the axis of the body, in both directions. 0: a bar crosses the "
                   "axis; half of Spacing: the axis goes through the middle of a mesh");
  section.choice("Bond", bond.kind, kinds,
                 "rigid: the bars go with the concrete; slip: bond stress and slip of the fib Model Code "
                 "2010 (pull-out, good bond), and a largest pressure of the bar on the concrete");
  auto steel_section = parameters.section(name, if_there);
  steel_section.quantity("Young's modulus", steel.youngs_modulus, Dimension::stress, {above_zero, 1e13},
                         "of the bars");
  steel_section.quantity("Yield stress", steel.yield_stress, Dimension::stress, {above_zero, 1e13},
                         "of the bars: force over initial section");
  steel_section.quantity("Hardening modulus", steel.hardening_modulus, Dimension::stress, {0, 1e13},
                         "stress per plastic strain, both over initial section and length");
  steel_section.number("Rupture strain", steel.rupture_strain, {above_zero, 10},
                       "accumulated plastic strain of a segment (as long as the points' spacing) at which "
                       "it breaks");
  steel_section.quantity("Density", steel.density, Dimension::density, {above_zero, 1e5}, "of the bars");
  auto optional = parameters.section(name, Needed::never());
  optional.quantity("Bond stiffness", bond.stiffness, Dimension::stress, {above_zero, 1e13},
                    "force per length of a bar and per displacement against the concrete; if not set, "
                    "2 pi G / ln(R / r) with the concrete's shear modulus G, the bar's radius r and half the "
                    "radius of the supports R");
  auto of_slip = parameters.section(name, needed_if("Bond", bond.kind, kinds, {BondKind::slip}) && if_there);
  of_slip.quantity("Concrete strength", bond.concrete_strength, Dimension::stress, {above_zero, 1e10},
                   "mean strength of cylinders in compression, for the bond stress");
  of_slip.quantity("Rib spacing", bond.rib_spacing, Dimension::length, {BondLaw::second_slip, 1},
                   "clear distance between the ribs of a bar");
}

void ReinforcementInputs::validate(const std::string& file, const std::string& section, const Shape& shape,
                                   const SymmetryPlanes& planes) const {
  if (!present()) return;
  const auto refuse = refusal(file, section);
  if (planes.axis)
    refuse("Faces", "bars have no rotational symmetry; allowed with Scene/Symmetry planes = axis: none");
  const Cylinder* cylinder = std::get_if<Cylinder>(&shape);
  if (!(cylinder && cylinder->hole == 0) && !std::holds_alternative<Block>(shape))
    refuse("Faces", "bars lie in a cylinder without a hole or in a block; allowed for this body: none");
  validate_places(file, section, shape, planes);
}

void ReinforcementInputs::validate_places(const std::string& file, const std::string& section,
                                          const Shape& shape, const SymmetryPlanes& planes) const {
  const auto refuse = refusal(file, section);
  const double height = extent(shape, {0, 0, 1}) + extent(shape, {0, 0, -1});
  const int crossing = direction == MeshDirection::both ? 2 : 1;
  const double mesh = cover + crossing * diameter;
  const double room = faces == MeshFaces::both ? 0.5 * height : height - cover;
  if (mesh > room)
    refuse("Cover", "found " + length(cover) +
                        ": the bars would lie outside of the concrete or in each "
                        "other; allowed: cover and bars within " +
                        length(room));
  if (!(spacing > diameter))
    refuse("Spacing", "found " + length(spacing) + ", allowed: more than Bar diameter, " + length(diameter));
  const double half = 0.5 * spacing, tolerance = 1e-9 * spacing;
  const bool across_x = planes.normal[0] && direction != MeshDirection::x,
             across_y = planes.normal[1] && direction != MeshDirection::y;
  if ((across_x || across_y) && offset != 0 && std::abs(offset - half) > tolerance)
    refuse("Offset", "found " + length(offset) +
                         ", allowed with these Scene/Symmetry planes: 0 or half of "
                         "Spacing, " +
                         length(half));
  if (offset > half + tolerance)
    refuse("Offset", "found " + length(offset) + ", allowed: at most half of Spacing, " + length(half));
  if (lines(shape, planes, {}).empty())
    refuse("Spacing", "no bar of Spacing " + length(spacing) + " and Offset " + length(offset) +
                          " lies inside of the concrete with Cover " + length(cover));
}

double ReinforcementInputs::half_length(const Shape& shape, int along, double distance) const {
  if (const Cylinder* cylinder = std::get_if<Cylinder>(&shape)) {
    const double radius = cylinder->radius - cover;
    return distance < radius ? std::sqrt(radius * radius - distance * distance) : 0;
  }
  const Block& block = std::get<Block>(shape);
  const double size[] = {0.5 * block.width - cover, 0.5 * block.depth - cover};
  return distance + 0.5 * diameter <= size[1 - along] ? std::max(0.0, size[along]) : 0;
}

void ReinforcementInputs::add_layer(std::vector<BarLine>& all, const Shape& shape,
                                    const SymmetryPlanes& planes, const Vec3& origin, int along,
                                    double z) const {
  const int across = 1 - along;
  const double reach = extent(shape, across == 0 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
  const auto most = static_cast<int>(std::ceil(reach / spacing)) + 1;
  for (int k = -most; k <= most; ++k) {
    const double place = offset + k * spacing;
    const double half = half_length(shape, along, std::abs(place));
    // Ends shorter than a mesh are left out: they would hold nothing.
    if (2 * half < spacing || (planes.normal[across] && place < 0)) continue;
    BarLine line{.from = origin, .to = origin, .share = planes.normal[across] && place == 0 ? 0.5 : 1};
    line.from[across] += place, line.to[across] += place;
    line.from[2] += z, line.to[2] += z;
    line.from[along] -= planes.normal[along] ? 0 : half;
    line.to[along] += half;
    all.push_back(line);
  }
}

std::vector<BarLine> ReinforcementInputs::lines(const Shape& shape, const SymmetryPlanes& planes,
                                                const Vec3& origin) const {
  std::vector<BarLine> all;
  if (!present()) return all;
  const double low = -extent(shape, {0, 0, -1}), high = extent(shape, {0, 0, 1});
  const double outer = cover + 0.5 * diameter, inner = outer + diameter;
  const auto add_face = [&](double face, double inward) {
    if (direction != MeshDirection::y) add_layer(all, shape, planes, origin, 0, face + inward * outer);
    const double of_y = direction == MeshDirection::y ? outer : inner;
    if (direction != MeshDirection::x) add_layer(all, shape, planes, origin, 1, face + inward * of_y);
  };
  if (faces == MeshFaces::front || faces == MeshFaces::both) add_face(low, 1);
  if (faces == MeshFaces::back || faces == MeshFaces::both) add_face(high, -1);
  return all;
}

} // namespace spall
