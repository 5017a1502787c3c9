#pragma once

#include "macro/dynamics/simulation.h"
#include "macro/material/j2.h"
#include "macro/shape/fill.h"

#include <algorithm>
#include <string>
#include <vector>

namespace spall::test {

/// The paper's aluminium (Table 2).
inline J2 aluminium() {
  J2 m;
  m.youngs_modulus = 78.6e9, m.poisson_ratio = 0.33, m.initial_yield = 420e6, m.hardening_modulus = 0;
  m.density = 2700;
  return m;
}

/// Symmetry planes by name, as in Scene/Symmetry planes.
inline SymmetryPlanes planes_of(const std::vector<std::string>& names) {
  const auto has = [&](const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  return {.normal = {has("x"), has("y"), false}, .axis = has("axis")};
}

/// A rigid wall below z = 0.
inline RigidBody wall_at_zero() {
  RigidBody wall{.shape = PlaneWall{}, .free = {false, false, false}};
  wall.name = "wall";
  return wall;
}

/// A Taylor bar of aluminium on a rigid wall.
struct Bar {
  double diameter = 8e-3, height = 8e-3; ///< m
  Filling filling = {4, 8, Boundary::centred};
  SymmetryPlanes planes = {};
  double velocity = -373; ///< m/s
  double friction = 0;

  Points points() const {
    Points p =
        fill_cylinder({.radius = 0.5 * diameter, .height = height}, filling, planes, aluminium().density);
    for (std::size_t i = 0; i < p.owned; ++i) p.velocity.set(i, {0, 0, velocity});
    return p;
  }
  std::unique_ptr<Solid> solid(const SolidInputs& numerics = {}) const {
    auto made = make_solid(aluminium(), points(), planes, numerics);
    made->label = "bar";
    return made;
  }
  Simulation shoot(const SolidInputs& numerics = {}, const TimeInputs& time = {.end_time = 1}) const {
    Bodies bodies;
    bodies.solids.push_back(solid(numerics));
    bodies.rigids.push_back(wall_at_zero());
    ContactInputs contact;
    contact.friction = friction;
    return {std::move(bodies), contact, time, numerics.integration};
  }
};

/// Makes a bar of a few hundred points, whose cells are cubes of 1 mm.
inline Bar small_bar(const std::vector<std::string>& symmetry = {}, Boundary boundary = Boundary::centred) {
  return {.filling = {4, boundary == Boundary::on_surface ? 9 : 8, boundary}, .planes = planes_of(symmetry)};
}

} // namespace spall::test
