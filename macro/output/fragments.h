#pragma once

#include "macro/solid/solid.h"
#include "shared/input/parameters.h"
#include "shared/summary.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace spall {

/// When two points hold together: one is in the other's support, and they have moved against each other by
/// less than `gap` mean spacings since the start, rotation aside. That they interact is not enough: kernels
/// overlap over some two spacings, more where supports are stretched, and would join what has long parted.
struct FragmentInputs {
  double gap = 0.1;

  void declare(Parameters& parameters);
};

/// Where a fragment goes.
enum class FragmentPlace {
  remainder, ///< the heaviest: what is left of the body
  debris,    ///< moves towards +z and sticks out of the back
  ejecta,    ///< moves towards -z and sticks out of the front
  loose      ///< still between the faces
};
const char* name_of(FragmentPlace place);

/// A connected cluster of points of the whole body. One that crosses a symmetry plane is one with its mirror
/// image; one that does not has mirror images of its own. With rotational symmetry it is made of rings.
struct Fragment {
  FragmentPlace place = FragmentPlace::loose;
  double copies = 1;                           ///< how many like it the whole body has, itself included
  double points = 0;                           ///< of one
  double mass = 0;                             ///< of one, kg
  double size = 0;                             ///< diameter of the sphere with its undeformed volume, m
  Vec3 centre{};                               ///< of mass, m; of the copy in the modelled part
  Vec3 velocity{};                             ///< of the centre, m/s
  double kinetic_energy = 0;                   ///< of its points, so spin and strain rate included, J
  double shear_damage = 0, tensile_damage = 0; ///< means over its mass; 0 for materials without

  /// While they are sums over points, not yet means.
  Fragment& operator+=(const Fragment& other);
};

struct Fragments {
  std::vector<Fragment> list;          ///< remainder first, then by falling mass
  std::vector<std::uint32_t> of_point; ///< index into the list, for this rank's points
  double modelled_points = 0;          ///< of the body, on all ranks
};

/// The fragments of a body now. Before the first step it is whole. All ranks must call it, and all get the
/// whole list.
/// @param front,back z of the body's faces at the start, m
Fragments find_fragments(const Solid& solid, const FragmentInputs& inputs, double front, double back);

/// Of the fragments in one place, whole body.
struct FragmentSums {
  double count = 0, lone = 0; ///< fragments; of them single points
  double mass = 0;            ///< kg
  double momentum = 0;        ///< along z, N s
  double kinetic_energy = 0;  ///< J
  double heaviest = 0;        ///< kg
};
FragmentSums sum_of(const Fragments& fragments, FragmentPlace place);

/// fragments.csv: one line per fragment, SI.
void write_fragments(const std::filesystem::path& file, const Fragments& fragments);
/// Numbers, masses, momenta and energies by place, and the points that no fragment holds (0 unless something
/// is no number). @param prefix of the names
void add_fragments(Summary& summary, const Fragments& fragments, const SymmetryPlanes& planes,
                   const std::string& prefix = "");

} // namespace spall
