#include "micro/solid.h"

#include "micro/cell/aggregate_mesh.h"
#include "micro/homogenization/effective_constants.h"
#include "shared/error.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace spall {

std::vector<Isotropic> scaled_phases(const CellComplex<2>& complex, const Elements& elements,
                                     unsigned int refinements, std::vector<Isotropic> phases,
                                     double poisson_ratio) {
  CellComplex<2> whole = complex;
  whole.cracks.clear();
  const Isotropic wanted(poisson_ratio);
  for (int i = 0; i < 50; ++i) {
    const Bulk<2> bulk(whole, elements, refinements, phases);
    const EffectiveConstants now = effective_constants(bulk.condensed().uncracked);
    const Isotropic found(now.poisson_ratio, now.youngs_modulus);
    const double shear = wanted.mu / found.mu,
                 plane_bulk = (wanted.lambda + wanted.mu) / (found.lambda + found.mu);
    for (Isotropic& phase : phases) {
      const double bulk_modulus = plane_bulk * (phase.lambda + phase.mu);
      phase.mu *= shear;
      phase.lambda = bulk_modulus - phase.mu;
      if (!(phase.lambda + 2.0 / 3 * phase.mu > 0))
        throw std::runtime_error("aggregates or mortar would have a negative bulk modulus");
    }
    constexpr double exact = 1e-10;
    if (std::max(std::abs(shear - 1), std::abs(plane_bulk - 1)) < exact) return phases;
  }
  throw std::runtime_error("aggregates and mortar cannot be scaled to the constants of the cell");
}

namespace {

/// Makes a cell of aggregates in mortar.
Solid<2> aggregate_solid(const MicrocellInputs& inputs, double cell_size) {
  const AggregateInputs& aggregates = inputs.aggregates;
  try {
    const CellComplex<2> complex = cell_complex(
        place_aggregates(aggregate_diameters(aggregates.grading, cell_size), inputs.geometry.random.seed),
        aggregates.mortar_cracks);
    const double E = inputs.youngs_modulus;
    std::vector<Isotropic> phases = {
        Isotropic(aggregates.mortar_poisson_ratio, aggregates.mortar_youngs_modulus / E),
        Isotropic(aggregates.poisson_ratio, aggregates.youngs_modulus / E)};
    const Elements elements = inputs.mesh.approximation();
    if (aggregates.scaled)
      phases =
          scaled_phases(complex, elements, aggregates.refinements, std::move(phases), inputs.poisson_ratio);
    auto bulk = std::make_unique<Bulk<2>>(complex, elements, aggregates.refinements, std::move(phases),
                                          inputs.boundary);
    const EffectiveConstants whole = effective_constants(bulk->condensed().uncracked);
    return {std::move(bulk), E * whole.youngs_modulus, whole.poisson_ratio, whole.anisotropy};
  } catch (const std::runtime_error& error) {
    throw ComputationError(error.what());
  }
}

} // namespace

template<int dim> Solid<dim> make_solid(const MicrocellInputs& inputs, double cell_size) {
  if constexpr (dim == 2)
    if (inputs.aggregates.present()) return aggregate_solid(inputs, cell_size);
  return {std::make_unique<Bulk<dim>>(inputs.geometry, inputs.mesh, inputs.poisson_ratio, inputs.boundary),
          inputs.youngs_modulus, inputs.poisson_ratio, 0};
}
template Solid<2> make_solid(const MicrocellInputs&, double);
template Solid<3> make_solid(const MicrocellInputs&, double);

} // namespace spall
