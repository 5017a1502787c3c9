#include "micro/output/fields.h"

#include "micro/equilibrium/isotropic.h"
#include "shared/output_directory.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/numerics/data_out.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>

namespace spall {
namespace {

/// Returns the components of stress that are written; in 2D they include the one normal to the plane.
template<int dim> std::vector<std::array<int, 2>> stress_components() {
  std::vector<std::array<int, 2>> components;
  for (int i = 0; i < 3; ++i) components.push_back({i, i});
  for (int i = dim; i < voigt_size<dim>; ++i) components.push_back(tensor_index<dim>(i));
  return components;
}

/// Computes the stress from the displacement gradient, and adds the material number.
template<int dim> class StressPostprocessor : public dealii::DataPostprocessor<dim> {
public:
  StressPostprocessor(const std::vector<Isotropic>& phases_, double youngs_modulus_)
      : phases(phases_), youngs_modulus(youngs_modulus_), components(stress_components<dim>()) {}

  void evaluate_vector_field(const dealii::DataPostprocessorInputs::Vector<dim>& inputs,
                             std::vector<dealii::Vector<double>>& outputs) const override {
    const auto material = inputs.template get_cell<dim>()->material_id();
    for (unsigned int q = 0; q < outputs.size(); ++q) {
      dealii::SymmetricTensor<2, 3> strain; // in plane strain the components normal to the plane are 0
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j <= i; ++j)
          strain[i][j] = 0.5 * (inputs.solution_gradients[q][i][j] + inputs.solution_gradients[q][j][i]);
      const auto stress = youngs_modulus * phases[material].stress(strain);
      for (unsigned int i = 0; i < components.size(); ++i)
        outputs[q][i] = stress[components[i][0]][components[i][1]];
      outputs[q][components.size()] = material;
    }
  }
  std::vector<std::string> get_names() const override {
    std::vector<std::string> names;
    for (const auto& [row, column] : components)
      names.push_back(std::string("stress_") + "xyz"[row] + "xyz"[column]);
    names.push_back("material");
    return names;
  }
  std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation>
  get_data_component_interpretation() const override {
    return std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation>(
        components.size() + 1, dealii::DataComponentInterpretation::component_is_scalar);
  }
  dealii::UpdateFlags get_needed_update_flags() const override { return dealii::update_gradients; }

private:
  const std::vector<Isotropic>& phases;
  double youngs_modulus;
  std::vector<std::array<int, 2>> components;
};

/// The units of what a file holds, by name.
template<int dim> std::map<std::string, std::string> units_of(const StressPostprocessor<dim>& stress) {
  std::map<std::string, std::string> units = {{"displacement", "m"}};
  for (const std::string& name : stress.get_names()) units[name] = name == "material" ? "1" : "Pa";
  return units;
}

/// Returns the text of a .vtu file with a number without unit added, as field data of the whole cell.
std::string with_number(std::string text, const std::string& name, double value) {
  const std::string grid = "<UnstructuredGrid>";
  char number[32];
  std::snprintf(number, sizeof number, "%.17g", value);
  return text.insert(text.find(grid) + grid.size(),
                     "\n<FieldData><DataArray type=\"Float64\" Name=\"" + name +
                         "\" units=\"1\" NumberOfTuples=\"1\" format=\"ascii\">" + number +
                         "</DataArray></FieldData>");
}

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
  // The peak is always one of the rows, because users look for it; the rows before and after it are evenly
  // spaced.
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

template<int dim>
void write_fields(const Bulk<dim>& bulk, const InterfaceProblem<dim>& problem,
                  const std::vector<CellState<dim>>& states, const std::vector<std::size_t>& rows,
                  const std::filesystem::path& directory) {
  if (rows.empty()) return;
  // The solver works on the unit cell; a copy of its mesh at real size has the same dof numbers.
  dealii::Triangulation<dim> mesh;
  mesh.copy_triangulation(bulk.mesh());
  dealii::GridTools::scale(problem.cell_size, mesh);
  dealii::DoFHandler<dim> dofs(mesh);
  dofs.distribute_dofs(bulk.dofs().get_fe());
  const StressPostprocessor<dim> stress(bulk.phases(), problem.youngs_modulus);

  std::vector<std::pair<double, std::string>> series;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const CellState<dim>& state = states[rows[i]];
    dealii::Vector<double> u = bulk.displacement(state.opening / problem.cell_size, state.strain);
    u *= problem.cell_size;
    dealii::DataOut<dim> out;
    out.attach_dof_handler(dofs);
    out.add_data_vector(u, std::vector<std::string>(dim, "displacement"), dealii::DataOut<dim>::type_dof_data,
                        std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation>(
                            dim, dealii::DataComponentInterpretation::component_is_part_of_vector));
    out.add_data_vector(u, stress);
    out.build_patches(dofs.get_fe().degree);
    dealii::DataOutBase::VtkFlags flags;
    flags.physical_units = units_of(stress);
    out.set_flags(flags);
    char name[32];
    std::snprintf(name, sizeof name, "fields_%03zu.vtu", i);
    std::ostringstream text;
    out.write_vtu(text);
    const double strain = state.strain.dot(problem.direction) / problem.direction.squaredNorm();
    write_atomically(directory / name, with_number(text.str(), "macroscopic_strain", strain));
    series.emplace_back(static_cast<double>(rows[i]), name);
  }
  std::ostringstream record;
  dealii::DataOutBase::write_pvd_record(record, series);
  write_atomically(directory / "fields.pvd", record.str());
}

#define SPALL_INSTANTIATE(dim)                                                                               \
  template void write_fields(const Bulk<dim>&, const InterfaceProblem<dim>&,                                 \
                             const std::vector<CellState<dim>>&, const std::vector<std::size_t>&,            \
                             const std::filesystem::path&);
SPALL_INSTANTIATE(2)
SPALL_INSTANTIATE(3)
#undef SPALL_INSTANTIATE

} // namespace spall
