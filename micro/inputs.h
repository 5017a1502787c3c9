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

/// The macroscopic strain path that the cell is loaded with.
enum class LoadMode { uniaxial_strain, uniaxial_stress, biaxial, shear, direction };

/// Settings of an ensemble: many random cells are computed instead of a single one.
struct EnsembleSettings {
  int samples = 0;   ///< number of random cells; 0: a single cell is computed
  int seed = 1;      ///< random seed of the first sample; sample i uses seed + i
  int threads = 0;   ///< number of threads; 0: one for each core of the machine
  double band = 0.1; ///< the weak and strong tables are the quantiles band and 1 - band
};

/// Everything that a CASE.prm can set. Values here are the defaults; a key whose default is `required` must
/// be set.
struct MicrocellInputs {
  static constexpr int most_elements = 200; ///< largest Mesh/Elements

  double youngs_modulus = required, poisson_ratio = required;
  double strength = required, fracture_energy = required;
  Softening softening = Softening::linear;
  MixedMode mode;
  std::vector<double> sizes;
  double reference_size = required;
  int dimension = 2;
  CellGeometry geometry{.crack_ratio = required};
  AggregateInputs aggregates; ///< if present, only the seed of `geometry` is used
  Boundary boundary = Boundary::periodic;
  double imperfection = 0;     ///< relative reduction of the strength of the first crack line
  double strength_scatter = 0; ///< relative random scatter of the strength, drawn for each crack line
  MeshDensity mesh;
  LoadMode load_mode = LoadMode::uniaxial_strain;
  /// Direction of the strain for LoadMode::direction; shear strains are 2 e_xy, 2 e_yz, 2 e_xz.
  double strain_xx = 0, strain_yy = 1, strain_zz = 0, strain_xy = 0, strain_yz = 0, strain_xz = 0;
  SteppingSettings stepping;
  NewtonSettings newton;
  int field_states = 8;
  EnsembleSettings ensemble;

  void declare(Parameters& parameters);
  template<int dim> MacroLoad<dim> load() const;
  /// Returns one cohesive law for each crack line of a cell, with imperfection and scatter (drawn from
  /// geometry.random.seed). The list is empty if all lines have the same law.
  std::vector<std::unique_ptr<CohesiveLaw>> line_laws(double cell_size) const;
  /// Descriptions of the crack set and of the loading for the damage table and for messages.
  std::string describe_cracks() const;
  std::string describe_loading() const;

private:
  void declare_material(Parameters& parameters);
  void declare_cell(Parameters& parameters);
  void declare_cracks(Parameters& parameters);
  void declare_mesh(Parameters& parameters);
  void declare_loading(Parameters& parameters);
  void declare_stepping(Parameters& parameters);
  void declare_solver_and_output(Parameters& parameters);
  void declare_ensemble(Parameters& parameters);
};

/// Checks the keys against each other: ascending sizes with the reference size among them, cracks that fit
/// into the cell, a mesh that resolves the process zone of the largest cell.
/// @param where name of the case file, which the error message begins with
/// @throws InputError
void check(const MicrocellInputs& inputs, const std::string& where);

} // namespace spall
