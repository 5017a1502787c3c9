#include "micro/output/fields.h"

#include "micro/equilibrium/isotropic.h"
#include "shared/output_directory.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/numerics/data_out.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace spall {
namespace {

/// Stress of plane strain from the displacement gradient, with the stress across the plane, and the number of
/// the material.
class StressPostprocessor : public dealii::DataPostprocessor<2> {
public:
  StressPostprocessor(const std::vector<Isotropic>& phases_, double youngs_modulus_)
      : phases(phases_), youngs_modulus(youngs_modulus_) {}

  void evaluate_vector_field(const dealii::DataPostprocessorInputs::Vector<2>& inputs,
                             std::vector<dealii::Vector<double>>& outputs) const override {
    const Isotropic& elastic = phases[inputs.get_cell<2>()->material_id()];
    for (unsigned int q = 0; q < outputs.size(); ++q) {
      const auto& gradient = inputs.solution_gradients[q];
      const double lambda = youngs_modulus * elastic.lambda, mu = youngs_modulus * elastic.mu;
      const double pressure_part = lambda * (gradient[0][0] + gradient[1][1]);
      outputs[q][0] = pressure_part + 2 * mu * gradient[0][0];
      outputs[q][1] = pressure_part + 2 * mu * gradient[1][1];
      outputs[q][2] = pressure_part;
      outputs[q][3] = mu * (gradient[0][1] + gradient[1][0]);
      outputs[q][4] = inputs.get_cell<2>()->material_id();
    }
  }
  std::vector<std::string> get_names() const override {
    return {"stress_xx", "stress_yy", "stress_zz", "stress_xy", "material"};
  }
  std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation>
  get_data_component_interpretation() const override {
    return std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation>(
        5, dealii::DataComponentInterpretation::component_is_scalar);
  }
  dealii::UpdateFlags get_needed_update_flags() const override { return dealii::update_gradients; }

private:
  const std::vector<Isotropic>& phases;
  double youngs_modulus;
};

} // namespace

std::vector<std::size_t> rows_to_show(const DamageCurve& curve, int count) {
  const std::size_t rows = curve.strain.size();
  if (count <= 0 || rows == 0) return {};
  double peak = 0;
  for (const double stress : curve.stress) peak = std::max(peak, stress);
  std::vector<double> length(rows, 0);
  for (std::size_t i = 1; i < rows; ++i)
    length[i] = length[i - 1] + std::hypot((curve.strain[i] - curve.strain[i - 1]) / curve.strain.back(),
                                           peak > 0 ? (curve.stress[i] - curve.stress[i - 1]) / peak : 0);
  // People look for the peak: it is one of the rows, those before and after it are evenly spread.
  const std::size_t top =
      count < 3 ? rows - 1
                : std::max_element(curve.stress.begin(), curve.stress.end()) - curve.stress.begin();
  const int intervals = count - 1;
  const int before = top + 1 == rows
                         ? intervals
                         : std::clamp(static_cast<int>(std::lround(intervals * length[top] / length.back())),
                                      1, intervals - 1);
  std::vector<std::size_t> shown;
  std::size_t row = 0;
  for (int i = 0; i < count; ++i) {
    const double wanted =
        i == intervals ? length.back()
        : i == before  ? length[top]
        : i < before   ? length[top] * i / before
                       : length[top] + (length.back() - length[top]) * (i - before) / (intervals - before);
    while (row + 1 < rows && length[row] < wanted) ++row;
    if (shown.empty() || shown.back() != row) shown.push_back(row);
  }
  return shown;
}

void write_fields(const Bulk& bulk, const InterfaceProblem<2>& problem,
                  const std::vector<CellState<2>>& states, const std::vector<std::size_t>& rows,
                  const std::filesystem::path& directory) {
  // The solver works on the unit cell; a copy of its mesh at real size numbers its dofs alike.
  dealii::Triangulation<2> mesh;
  mesh.copy_triangulation(bulk.mesh());
  dealii::GridTools::scale(problem.cell_size, mesh);
  dealii::DoFHandler<2> dofs(mesh);
  dofs.distribute_dofs(bulk.dofs().get_fe());
  const StressPostprocessor stress(bulk.phases(), problem.youngs_modulus);

  std::vector<std::pair<double, std::string>> series;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const CellState<2>& state = states[rows[i]];
    dealii::Vector<double> u = bulk.displacement(state.opening / problem.cell_size, state.strain);
    u *= problem.cell_size;
    dealii::DataOut<2> out;
    out.attach_dof_handler(dofs);
    out.add_data_vector(u, std::vector<std::string>(2, "displacement"), dealii::DataOut<2>::type_dof_data,
                        std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation>(
                            2, dealii::DataComponentInterpretation::component_is_part_of_vector));
    out.add_data_vector(u, stress);
    out.build_patches(dofs.get_fe().degree);
    char name[32];
    std::snprintf(name, sizeof name, "fields_%03zu.vtu", i);
    std::ostringstream text;
    out.write_vtu(text);
    write_atomically(directory / name, text.str());
    series.emplace_back(state.strain.sum(), name);
  }
  std::ostringstream record;
  dealii::DataOutBase::write_pvd_record(record, series);
  write_atomically(directory / "fields.pvd", record.str());
}

} // namespace spall
