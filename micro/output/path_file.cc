#include "micro/output/path_file.h"

#include "shared/input/quantity.h"
#include "shared/output_directory.h"

#include <cmath>

namespace spall {

template<int dim>
void write_path(const InterfaceProblem<dim>& problem, const CondensedCell<dim>& cell,
                const MacroLoad<dim>& load, const CurveTrace<dim>& trace, const std::filesystem::path& file) {
  std::string text = "load,control,iterations";
  for (const char* quantity : {",strain_", ",stress_"})
    for (int i = 0; i < voigt_size<dim>; ++i) {
      text += quantity;
      for (const int axis : tensor_index<dim>(i)) text += "xyz"[axis];
    }
  text += ",psi_integrated,psi_stress,psi_balance,damage_plus,lowest_eigenvalue,negative_eigenvalues\n";
  const DamageCurve& curve = trace.curve;
  for (std::size_t i = 0; i < trace.states.size(); ++i) {
    const CellState<dim>& state = trace.states[i];
    const Voigt<dim> strain =
        complete_strain(cell, load.free, state.strain, state.opening / problem.cell_size);
    const Voigt<dim> stress = homogenize(problem, state).stress;
    const RowReport& report = trace.reports[i];
    std::string line;
    const auto add = [&line](double value) {
      line += ',';
      line += std::isfinite(value) ? format_quantity(value, Dimension::none) : "nan";
    };
    line = format_quantity(curve.strain[i], Dimension::none) +
           (report.control == Control::strain ? ",strain," : ",damage,") + std::to_string(report.iterations);
    for (const double value : strain) add(value);
    for (const double value : stress) add(value);
    add(curve.psi[i]);
    add(0.5 * curve.stress[i] * curve.strain[i]);
    add(curve.work[i] - curve.dissipation[i]);
    add(curve.damage_plus[i]);
    add(report.stability.lowest);
    text += line + "," + std::to_string(report.stability.negative) + "\n";
  }
  write_atomically(file, text);
}

#define SPALL_INSTANTIATE(dim)                                                                               \
  template void write_path(const InterfaceProblem<dim>&, const CondensedCell<dim>&, const MacroLoad<dim>&,   \
                           const CurveTrace<dim>&, const std::filesystem::path&);
SPALL_INSTANTIATE(2)
SPALL_INSTANTIATE(3)
#undef SPALL_INSTANTIATE

} // namespace spall
