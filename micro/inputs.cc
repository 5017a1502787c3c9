#include "micro/inputs.h"

#include "shared/error.h"

#include <algorithm>
#include <cstdio>

namespace spall {
namespace {

/// Largest element on the ligament, in units of E' G_f / f_t^2, at which the process zone is resolved.
/// Measured: coarser meshes send Newton into cycles of two.
constexpr double process_zone_resolution = 0.12;

/// Upper bound of the search for a mesh that would do.
constexpr int most_elements = 200;

} // namespace

void MicrocellInputs::declare(Parameters& parameters) {
  auto material = parameters.section("Material");
  material.quantity("Young's modulus", youngs_modulus, Dimension::stress, {.min = above_zero},
                    "of the concrete between the cracks; must be the macroscopic model's");
  material.number("Poisson's ratio", poisson_ratio, {.min = 0, .max = 0.49},
                  "of the concrete between the cracks; must be the macroscopic model's");
  material.quantity("Tensile strength", strength, Dimension::stress, {.min = above_zero},
                    "f_t: traction at which an intact ligament starts to open");
  material.quantity("Fracture energy", fracture_energy, Dimension::energy_per_area, {.min = above_zero},
                    "G_f: energy per area to separate the faces of a crack completely");
  material.choice("Softening", softening, softening_words(),
                  "shape of the traction-opening curve after the strength");

  auto cell = parameters.section("Cell");
  cell.quantities("Sizes", sizes, Dimension::length, {.min = above_zero},
                  "edges of the square cells, ascending; one curve of the table each");
  cell.quantity("Reference size", reference_size, Dimension::length, {.min = above_zero},
                "the size, one of Sizes, whose curve.csv and fields are written");
  cell.number("Initial crack", geometry.crack_ratio, {.min = 0, .max = 0.9},
              "2 a0 / l: length of the centred initial crack over the cell's edge");

  auto density = parameters.section("Mesh");
  density.integer("Elements", mesh.elements, {.min = 2, .max = most_elements},
                  "elements over half the cell's height; the width follows");
  density.number("Grading", mesh.grading, {.min = 1, .max = 8},
                 "element size grows as (distance from the crack tip)^(1 - 1/grading); 1: uniform");
  density.integer("Degree", mesh.degree, {.min = 1, .max = 3}, "polynomial degree of the displacement");

  auto loading = parameters.section("Loading");
  loading.number("Row growth", stepping.growth, {.min = 1e-4, .max = 0.2},
                 "strain of a row over the last one, minus 1; up to the strain f_t / M the rows are equally "
                 "spaced by this fraction of it (M: modulus of uniaxial strain)");
  loading.number("Final strain", stepping.final_strain, {.min = 1e-3, .max = 100},
                 "last row in units of w_f / l, the strain at which the cell has failed completely (of 2 f_t "
                 "/ M if that is "
                 "larger)");
  loading.number("Stress change", stepping.stress_change, {.min = 1e-4, .max = 1},
                 "largest change of stress from row to row, in units of f_t; the step is cut to keep it");
  loading.number("Smallest step", stepping.smallest_step, {.min = 1e-9, .max = 1},
                 "in units of f_t / M; the computation ends where a smaller one would be needed");

  auto solver = parameters.section("Solver");
  solver.number("Tolerance", newton.tolerance, {.min = 1e-12, .max = 1e-7},
                "largest error of the traction at any node of the crack line, in units of f_t");
  solver.integer("Iterations", newton.max_iterations, {.min = 1, .max = 1000},
                 "Newton iterations before a step is cut");

  parameters.section("Output").integer("Field states", field_states, {.min = 0, .max = 1000},
                                       "states of the reference cell written as fields; 0: none");
}

void check(const MicrocellInputs& inputs, const std::string& where) {
  const auto length = [](double value) { return format_quantity(value, Dimension::length); };
  if (inputs.sizes.empty()) throw InputError(where + ": key 'Cell/Sizes' must be set");
  for (std::size_t i = 1; i < inputs.sizes.size(); ++i)
    if (inputs.sizes[i] <= inputs.sizes[i - 1])
      throw InputError(where + ": key 'Cell/Sizes': found " + length(inputs.sizes[i - 1]) + " before " +
                       length(inputs.sizes[i]) + ", allowed: ascending sizes");
  if (std::find(inputs.sizes.begin(), inputs.sizes.end(), inputs.reference_size) == inputs.sizes.end()) {
    std::string sizes;
    for (const double size : inputs.sizes) sizes += (sizes.empty() ? "" : ", ") + length(size);
    throw InputError(where + ": key 'Cell/Reference size': found " + length(inputs.reference_size) +
                     ", allowed: one of Cell/Sizes (" + sizes + ")");
  }

  const double plane_modulus = inputs.youngs_modulus / (1 - inputs.poisson_ratio * inputs.poisson_ratio);
  const double allowed =
      process_zone_resolution * plane_modulus * inputs.fracture_energy / (inputs.strength * inputs.strength);
  const auto coarsest = [&](int elements) {
    MeshDensity mesh = inputs.mesh;
    mesh.elements = elements;
    return inputs.sizes.back() *
           coarsest_ligament_element(inputs.geometry, grid_lines(inputs.geometry, mesh));
  };
  if (const double found = coarsest(inputs.mesh.elements); found > allowed) {
    int enough = inputs.mesh.elements;
    while (enough < most_elements && coarsest(enough) > allowed) ++enough;
    char text[400];
    std::snprintf(
        text, sizeof text,
        ": key 'Mesh/Elements': found %d, which makes elements of %.3g mm on the ligament of the "
        "cell of %.6g mm, allowed: at most 0.12 E' G_f / f_t^2 = %.3g mm, or the process zone is not "
        "resolved; ",
        inputs.mesh.elements, found * 1e3, inputs.sizes.back() * 1e3, allowed * 1e3);
    throw InputError(where + text +
                     (coarsest(enough) <= allowed ? "set Mesh/Elements to " + std::to_string(enough)
                                                  : "use smaller cells"));
  }
}

} // namespace spall
