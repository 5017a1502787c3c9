#pragma once

#include "macro/dynamics/simulation.h"
#include "macro/material/j2.h"
#include "macro/shape/fill.h"
#include "tests/unit/dynamics/bodies_of.h"
#include "tests/unit/points/clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <ostream>
#include <string>

namespace spall {

/// Prints a scheme in the output of ctest.
inline void PrintTo(Scheme scheme, std::ostream* out) { *out << name_of(scheme); }

} // namespace spall

namespace spall::test {

/// Makes a metal that never yields. It is hypoelastic, which is elastic to first order in the strain.
inline J2 elastic(double youngs_modulus = 78.6e9, double poisson_ratio = 0.33) {
  J2 m;
  m.youngs_modulus = youngs_modulus, m.poisson_ratio = poisson_ratio;
  m.initial_yield = 1e30, m.hardening_modulus = 0, m.density = 2700;
  return m;
}

struct Numerics {
  Scheme scheme = Scheme::nsni;
  bool double_precision = true;
  double stabilization = IntegrationInputs{}.stabilization;
  int refresh_interval = IntegrationInputs{}.refresh_interval;
  double least_deformation = IntegrationInputs{}.least_deformation;
  double step_factor = 0.5;
  Correction correction = Correction::none;
  int verify_every = 0; ///< number of steps between estimates of the critical step; 0: none
  double newmark_gamma = 0.5;

  /// Returns the solid's inputs for these points. Conforming schemes need the outline of the body; the points
  /// get the volumes of their cells.
  SolidInputs solid(Points& points, const std::vector<HalfSpace>& outline) const {
    SolidInputs s = solid();
    if (is_conforming(scheme)) {
      s.cells = std::make_shared<const ConformingCells>(voronoi_cells(points, SymmetryPlanes{}, outline));
      s.approximation.configuration = Configuration::lagrangian;
      adopt_volumes(points, *s.cells);
    }
    return s;
  }
  SolidInputs solid() const {
    SolidInputs s;
    s.integration.scheme = scheme;
    s.integration.stabilization = stabilization;
    s.integration.correction = correction;
    s.integration.refresh_interval = refresh_interval;
    s.integration.least_deformation = least_deformation;
    s.double_precision = double_precision;
    return s;
  }
};

/// Makes a simulation of one body without contact.
inline Simulation free_flight(const J2& material, Points points, const Numerics& numerics,
                              const std::vector<HalfSpace>& outline = {}) {
  const SolidInputs inputs = numerics.solid(points, outline);
  return {bodies_of(make_solid(material, std::move(points), SymmetryPlanes{}, inputs)), ContactInputs{},
          TimeInputs{.end_time = 1,
                     .step_factor = numerics.step_factor,
                     .verify_every = numerics.verify_every,
                     .gamma = numerics.newmark_gamma},
          inputs.integration};
}

inline void set_velocity(Points& points, const std::function<Vec3(const Vec3&)>& field) {
  for (std::size_t i = 0; i < points.owned; ++i) points.velocity.set(i, field(points.position[i]));
}

/// Makes a block of n x n x n points of a material.
inline Points block(const J2& material, int n, double spacing, double jitter) {
  Points points = points_at(jittered_lattice(n, spacing, jitter), spacing);
  for (double& m : points.mass) m *= material.density;
  return points;
}

/// Returns the outline of that block.
inline std::vector<HalfSpace> block_outline(int n, double spacing) {
  std::vector<HalfSpace> outline;
  for (int c = 0; c < 3; ++c) {
    Vec3 normal{};
    normal[c] = 1;
    outline.push_back({normal, n * spacing});
    normal[c] = -1;
    outline.push_back({normal, 0});
  }
  return outline;
}

inline std::string scheme_label(const ::testing::TestParamInfo<Scheme>& instance) {
  std::string name = name_of(instance.param);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

} // namespace spall::test
