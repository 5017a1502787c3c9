#pragma once

#include "micro/inputs.h"
#include "micro/loading/curve_tracing.h"
#include "micro/loading/undamaged_energy.h"
#include "micro/solid.h"

#include <functional>
#include <memory>
#include <vector>

namespace spall {

/// One cell of a case at one size, ready to be loaded: its solid, condensed onto the strains that the loading
/// controls, its cohesive laws, and the equations of its cracks, which refer to both.
template<int dim> class CellProblem {
public:
  /// @param solid the solid for that cell size; it must outlive this object
  CellProblem(const MicrocellInputs& inputs, const Solid<dim>& solid, double cell_size)
      : load(inputs.load<dim>()), whole(solid.bulk->condensed()),
        undamaged(undamaged_energy(whole, load, solid.youngs_modulus, solid.poisson_ratio)),
        controlled(release(whole, load.free)),
        law(make_cohesive_law(inputs.softening, inputs.strength, inputs.fracture_energy)),
        line_laws(inputs.line_laws(cell_size)), problem{.cell = controlled,
                                                        .law = *law,
                                                        .youngs_modulus = inputs.youngs_modulus,
                                                        .cell_size = cell_size,
                                                        .newton = inputs.newton,
                                                        .direction = load.direction,
                                                        .mode = inputs.mode} {
    for (const auto& line_law : line_laws) problem.line_laws.push_back(line_law.get());
  }
  CellProblem(const CellProblem&) = delete;
  CellProblem& operator=(const CellProblem&) = delete;

  const InterfaceProblem<dim>& equations() const { return problem; }
  /// The condensed solid before the free strain components were condensed out.
  const CondensedCell<dim>& solid() const { return whole; }
  const MacroLoad<dim>& loading() const { return load; }

  /// Traces the whole curve and fills every column; @see trace_curve().
  CurveTrace<dim> trace(const SteppingSettings& stepping,
                        const std::function<bool(const DamageCurve&)>& continue_after) const {
    CurveTrace<dim> result = trace_curve(problem, stepping, continue_after);
    set_damage_plus(result.curve, undamaged);
    return result;
  }

private:
  MacroLoad<dim> load;
  const CondensedCell<dim>& whole;
  /// Strain energy of the uncracked cell at load 1, split into tensile and compressive part.
  SplitEnergy undamaged;
  CondensedCell<dim> controlled;
  std::unique_ptr<CohesiveLaw> law;
  std::vector<std::unique_ptr<CohesiveLaw>> line_laws;
  InterfaceProblem<dim> problem;
};

} // namespace spall
