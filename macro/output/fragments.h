#pragma once

#include "macro/solid/solid.h"
#include "shared/input/parameters.h"
#include "shared/summary.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace spall {

/// What counts as broken off. Two points are connected if one is in the other's support, and their relative
/// displacement since the start, without rotation, is less than `gap` mean spacings. Interaction alone is not
/// sufficient, because kernels overlap over about two spacings, more where supports are stretched, and would
/// connect parts that have separated.
struct FragmentInputs {
  double gap = 0.1;
  /// Opening of cracks behind which concrete is loose, m, for craters. A crack carries nothing from about
  /// 5 G_F / f_t on (Hordijk 1991), 0.2 to 0.3 mm in concrete; where it comes off in a few layers (a spall
  /// bar breaks in four planes at once), that is 1 mm together.
  double loose = 1e-3;

  void declare(Parameters& parameters);
};

/// The destination of a fragment.
enum class FragmentPlace {
  remainder, ///< the heaviest fragment, which is the remaining body
  debris,    ///< the fragment moves towards +z and extends beyond the back
  ejecta,    ///< the fragment moves towards -z and extends beyond the front
  loose      ///< the fragment is still between the faces
};
const char* name_of(FragmentPlace place);

/// A connected cluster of points of the whole body. One that crosses a symmetry plane is one with its mirror
/// image; one that does not has mirror images of its own. With rotational symmetry it is made of rings.
struct Fragment {
  FragmentPlace place = FragmentPlace::loose;
  double copies = 1;         ///< number of equal copies in the whole body, itself included
  double points = 0;         ///< number of points of one copy
  double mass = 0;           ///< mass of one copy, kg
  double size = 0;           ///< diameter of the sphere with its undeformed volume, m
  Vec3 centre{};             ///< centre of mass of the copy in the modelled part, m
  Vec3 velocity{};           ///< velocity of the centre of mass, m/s
  double kinetic_energy = 0; ///< kinetic energy of its points, J, which includes spin and strain rate
  double shear_damage = 0, tensile_damage = 0; ///< means over its mass; 0 for materials without

  /// Adds another part, as long as the members are sums over points and not yet means.
  Fragment& operator+=(const Fragment& other);
};

struct Fragments {
  std::vector<Fragment> list;          ///< remainder first, then by falling mass
  std::vector<std::uint32_t> of_point; ///< index into the list, for this rank's points
  double modelled_points = 0;          ///< number of modelled points of the body on all ranks
};

/// Finds the present fragments of a body. Before the first step it is undamaged. All ranks must call it, and
/// all get the whole list.
/// @param front,back z of the body's faces at the start, m
Fragments find_fragments(const Solid& solid, const FragmentInputs& inputs, double front, double back);

/// Sums over the fragments with one destination, for the whole body.
struct FragmentSums {
  double count = 0, lone = 0; ///< number of fragments, and of those that are single points
  double mass = 0;            ///< total mass, kg
  double momentum = 0;        ///< total momentum along z, N s
  double kinetic_energy = 0;  ///< total kinetic energy, J
  double heaviest = 0;        ///< mass of the heaviest one, kg
};
FragmentSums sum_of(const Fragments& fragments, FragmentPlace place);

/// fragments.csv: one line per fragment, SI.
void write_fragments(const std::filesystem::path& file, const Fragments& fragments);
/// Numbers, masses, momenta and energies by place, and the points that no fragment holds (0 unless a value is
/// NaN). @param prefix prefix of the names
void add_fragments(Summary& summary, const Fragments& fragments, const SymmetryPlanes& planes,
                   const std::string& prefix = "");

} // namespace spall
