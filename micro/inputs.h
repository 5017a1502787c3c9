#pragma once

#include "micro/cell/geometry.h"
#include "micro/cohesive/cohesive_law.h"
#include "micro/equilibrium/interface_problem.h"
#include "micro/loading/strain_stepping.h"
#include "shared/input/parameters.h"

#include <string>
#include <vector>

namespace spall {

/// Everything a CASE.prm can say; values here are the defaults, NaN must be set.
struct MicrocellInputs {
  double youngs_modulus = required, poisson_ratio = required;
  double strength = required, fracture_energy = required;
  Softening softening = Softening::linear;
  std::vector<double> sizes;
  double reference_size = required;
  CellGeometry geometry{.crack_ratio = required};
  MeshDensity mesh;
  SteppingSettings stepping;
  NewtonSettings newton;
  int field_states = 8;

  void declare(Parameters& parameters);
};

/// Refuses what single keys cannot show: sizes not ascending, a reference size that is not among them, a mesh
/// too coarse for the process zone of the largest cell. @throws InputError, `where` names the case file.
void check(const MicrocellInputs& inputs, const std::string& where);

} // namespace spall
