#pragma once

#include "micro/aggregate_inputs.h"
#include "micro/cell/boundary.h"
#include "micro/cell/geometry.h"
#include "micro/cohesive/cohesive_law.h"
#include "micro/equilibrium/interface_problem.h"
#include "micro/loading/curve_tracing.h"
#include "micro/loading/macro_load.h"
#include "shared/input/parameters.h"

#include <memory>
#include <string>
#include <vector>

namespace spall {

/// How the cell is strained.
enum class LoadMode { uniaxial_strain, uniaxial_stress, biaxial, shear, direction };

/// Many random cells instead of one.
struct EnsembleSettings {
  int samples = 0;   ///< 0: one cell only
  int seed = 1;      ///< of the first sample; sample i has seed + i
  int threads = 0;   ///< 0: as many as the machine has
  double band = 0.1; ///< the weak and strong tables are the quantiles band and 1 - band
};

/// Everything a CASE.prm can say; values here are the defaults, NaN must be set.
struct MicrocellInputs {
  double youngs_modulus = required, poisson_ratio = required;
  double strength = required, fracture_energy = required;
  Softening softening = Softening::linear;
  MixedMode mode;
  std::vector<double> sizes;
  double reference_size = required;
  int dimension = 2;
  CellGeometry geometry{.crack_ratio = required};
  AggregateInputs aggregates; ///< if present, the geometry counts for its seed only
  Boundary boundary = Boundary::periodic;
  double imperfection = 0;     ///< relative reduction of the strength of the first crack line
  double strength_scatter = 0; ///< relative, per crack line
  MeshDensity mesh;
  LoadMode load_mode = LoadMode::uniaxial_strain;
  /// Of LoadMode::direction.
  double strain_xx = 0, strain_yy = 1, strain_zz = 0, strain_xy = 0, strain_xz = 0, strain_yz = 0;
  SteppingSettings stepping;
  NewtonSettings newton;
  int field_states = 8;
  EnsembleSettings ensemble;

  void declare(Parameters& parameters);
  template<int dim> MacroLoad<dim> load() const;
  /// Laws of the crack lines of a cell, one each, with imperfection and scatter (by geometry.random.seed);
  /// empty if all are alike.
  std::vector<std::unique_ptr<CohesiveLaw>> line_laws(double cell_size) const;
  /// In words, for the table and people.
  std::string describe_cracks() const;
  std::string describe_loading() const;
};

/// Refuses what single keys cannot show: sizes not ascending, a reference size that is not among them, cracks
/// that do not fit, a mesh too coarse for the process zone of the largest cell. @throws InputError, `where`
/// names the case file.
void check(const MicrocellInputs& inputs, const std::string& where);

} // namespace spall
