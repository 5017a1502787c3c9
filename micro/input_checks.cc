#include "micro/cell/penny.h"
#include "micro/inputs.h"
#include "shared/error.h"
#include "shared/memory.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace spall {
namespace {

/// Largest element on the ligament, in units of E' G_f / f_t^2, at which the process zone is resolved. On
/// coarser meshes the Newton iteration was found to alternate between two states.
constexpr double process_zone_resolution = 0.12;

double process_zone(double youngs_modulus, double poisson_ratio, double strength, double fracture_energy) {
  return process_zone_resolution * youngs_modulus / (1 - poisson_ratio * poisson_ratio) * fracture_energy /
         (strength * strength);
}

void check_aggregates(const MicrocellInputs& inputs, const std::string& where) {
  const AggregateInputs& a = inputs.aggregates;
  const auto length = [](double value) { return format_quantity(value, Dimension::length); };
  if (inputs.geometry.crack_ratio != 0)
    throw InputError(where + ": key 'Cell/Initial crack': found one together with aggregates, allowed: 0");
  if (inputs.boundary == Boundary::uniform_traction)
    throw InputError(where +
                     ": key 'Cell/Boundary': found uniform traction together with aggregates, allowed: "
                     "periodic, linear displacement");
  if (inputs.ensemble.samples > 0 && !a.scaled)
    throw InputError(where +
                     ": key 'Aggregates/Scale to the material': found no for an ensemble, whose cells would "
                     "have different elastic constants, allowed: yes");
  if (a.grading.smallest >= a.grading.largest)
    throw InputError(where + ": key 'Aggregates/Smallest diameter': found " + length(a.grading.smallest) +
                     ", allowed: less than the largest, " + length(a.grading.largest));
  if (inputs.sizes.front() < a.grading.largest)
    throw InputError(where + ": key 'Cell/Sizes': found " + length(inputs.sizes.front()) +
                     ", allowed: at least the largest aggregate, " + length(a.grading.largest));
  for (const double size : inputs.sizes) {
    LongestSides longest;
    try {
      longest = longest_sides(
          place_aggregates(aggregate_diameters(a.grading, size), inputs.geometry.random.seed), a.refinements);
    } catch (const std::runtime_error& error) {
      throw InputError(where + ": section 'Aggregates': " + error.what() + " of " + length(size) +
                       "; try a smaller volume fraction or another seed");
    }
    const double zone =
                     process_zone(inputs.youngs_modulus, inputs.poisson_ratio,
                                  inputs.strength * a.zone_strength, inputs.fracture_energy * a.zone_energy),
                 mortar = process_zone(inputs.youngs_modulus, inputs.poisson_ratio, inputs.strength,
                                       inputs.fracture_energy);
    if (size * longest.interface_zone > zone || size * longest.mortar > mortar)
      throw InputError(
          where + ": key 'Aggregates/Refinements': found " + std::to_string(a.refinements) +
          ", which makes elements of " + length(size * std::max(longest.interface_zone, longest.mortar)) +
          " at cracks, allowed: at most 0.12 E' G_f / f_t^2 = " + length(std::min(zone, mortar)));
  }
}

/// Returns whether the cell is a 3D one with a penny-shaped crack.
bool is_penny(const MicrocellInputs& inputs) {
  return inputs.dimension == 3 && inputs.geometry.shape == CrackShape::penny;
}

void check_sizes(const MicrocellInputs& inputs, const std::string& where) {
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
}

void check_loading(const MicrocellInputs& inputs, const std::string& where) {
  if ((inputs.dimension == 3 ? inputs.load<3>().direction.norm() : inputs.load<2>().direction.norm()) == 0)
    throw InputError(
        where + ": key 'Loading/Strain yy': found a strain of 0 in all directions, allowed: another one");
  if (inputs.dimension == 2 && (inputs.strain_zz != 0 || inputs.strain_yz != 0 || inputs.strain_xz != 0))
    throw InputError(where +
                     ": section 'Loading': found strains across the plane, allowed in 2D: xx, yy and xy");
}

void check_cracks(const MicrocellInputs& inputs, const std::string& where) {
  const CellGeometry& geometry = inputs.geometry;
  if (inputs.dimension == 3 && inputs.mesh.kind == ElementKind::discontinuous)
    throw InputError(where + ": key 'Mesh/Kind': found discontinuous, allowed in 3D: continuous");
  if (inputs.dimension == 2 && geometry.shape != CrackShape::through)
    throw InputError(where + ": key 'Cracks/Shape': found penny, allowed: through, or Cell/Dimension = 3");
  if (is_penny(inputs) && (!geometry.is_single_centred() || geometry.crack_ratio == 0))
    throw InputError(where + ": key 'Cracks/Shape': found penny with other keys of its section or without an "
                             "initial crack, allowed: a single centred crack with Cell/Initial crack > 0");
  if (geometry.ligament == Ligament::aligned && geometry.angle != 0) {
    if (geometry.lines != 1 || geometry.cracks_per_line != 1 || geometry.offset_x != 0 ||
        geometry.offset_y != 0 || geometry.random.length != 0 || geometry.random.angle != 0 ||
        geometry.random.position != 0)
      throw InputError(where +
                       ": key 'Cracks/Ligament': found aligned, allowed only for one regular centred crack");
    if (inputs.boundary != Boundary::periodic)
      throw InputError(where +
                       ": key 'Cell/Boundary': found a boundary that is not periodic, allowed: periodic with "
                       "aligned inclined cracks, whose cell is no square");
  }
  try {
    crack_lines(geometry);
  } catch (const std::invalid_argument& error) {
    throw InputError(where + ": section 'Cracks': found " + error.what());
  }
}

/// Checks that the mesh resolves the process zone; the error message names a sufficient number of elements.
void check_mesh(const MicrocellInputs& inputs, const std::string& where) {
  const double allowed =
      process_zone(inputs.youngs_modulus, inputs.poisson_ratio, inputs.strength, inputs.fracture_energy);
  const auto coarsest = [&](int elements) {
    MeshDensity mesh = inputs.mesh;
    mesh.elements = elements;
    return inputs.sizes.back() * (is_penny(inputs)
                                      ? coarsest_ligament_element(penny_grid(inputs.geometry, mesh))
                                      : coarsest_ligament_element(cell_grid(inputs.geometry, mesh)));
  };
  if (const double found = coarsest(inputs.mesh.elements); found > allowed) {
    int enough = inputs.mesh.elements;
    while (enough < MicrocellInputs::most_elements && coarsest(enough) > allowed) ++enough;
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

/// Elements of the cell's mesh.
double elements_of(const MicrocellInputs& inputs) {
  const auto intervals = [](std::size_t places) { return static_cast<double>(places) - 1; };
  if (is_penny(inputs)) {
    const PennyGrid grid = penny_grid(inputs.geometry, inputs.mesh);
    return static_cast<double>(grid.quads.size()) * intervals(grid.heights.size());
  }
  const CellGrid grid = cell_grid(inputs.geometry, inputs.mesh);
  return intervals(grid.x.size()) * intervals(grid.rows.size()) *
         (inputs.dimension == 3 ? inputs.mesh.layers : 1);
}

/// Refuses a mesh whose stiffness matrix alone does not fit into the memory: its factor takes several times
/// as much.
void check_memory(const MicrocellInputs& inputs, const std::string& where) {
  const double degree = inputs.mesh.degree;
  const int dim = inputs.dimension;
  constexpr double bytes_per_entry = 12; // a number and its column
  const double unknowns = elements_of(inputs) * std::pow(degree, dim) * dim,
               entries_per_row = dim * std::pow(2 * degree + 1, dim);
  require_memory(unknowns * entries_per_row * bytes_per_entry,
                 where + ": section 'Mesh': the " + format_quantity(std::round(unknowns), Dimension::none) +
                     " unknowns of the cell");
}

} // namespace

void check(const MicrocellInputs& inputs, const std::string& where) {
  check_sizes(inputs, where);
  check_loading(inputs, where);
  if (inputs.aggregates.present()) {
    if (inputs.dimension == 3)
      throw InputError(where + ": key 'Cell/Dimension': found 3 together with aggregates, allowed: 2");
    check_aggregates(inputs, where);
    return;
  }
  check_cracks(inputs, where);
  check_mesh(inputs, where);
  check_memory(inputs, where);
}

} // namespace spall
