#include "micro/inputs.h"

#include <random>

namespace spall {
namespace {

std::string describe_lines(const CellGeometry& geometry) {
  const auto number = [](double value) { return format_quantity(value, Dimension::none); };
  if (geometry.crack_ratio == 0)
    return "no initial crack, " + std::to_string(geometry.lines) + " cohesive line(s) across the cell";
  const std::string size = ", 2 a0 / l = " + number(geometry.crack_ratio);
  CellGeometry horizontal = geometry;
  horizontal.vertical = {};
  if (horizontal.is_single_centred()) return "one centred crack" + size;
  std::string text = std::to_string(geometry.lines) + " line(s) of " +
                     std::to_string(geometry.cracks_per_line) + " crack(s)" + size + ", " +
                     number(geometry.angle) + " degrees, ligaments " +
                     ligament_words()[static_cast<int>(geometry.ligament)].first;
  const RandomCracks& r = geometry.random;
  if (r.length > 0 || r.angle > 0 || r.position > 0)
    text += ", random (length " + number(r.length) + ", angle " + number(r.angle) + " degrees, position " +
            number(r.position) + ", seed " + std::to_string(r.seed) + ")";
  return text;
}

} // namespace

void MicrocellInputs::declare(Parameters& parameters) {
  declare_material(parameters);
  declare_cell(parameters);
  declare_cracks(parameters);
  aggregates.declare(parameters);
  declare_mesh(parameters);
  declare_loading(parameters);
  declare_stepping(parameters);
  declare_solver_and_output(parameters);
  declare_ensemble(parameters);
}

void MicrocellInputs::declare_material(Parameters& parameters) {
  auto material = parameters.section("Material");
  material.quantity("Young's modulus", youngs_modulus, Dimension::stress, {.min = above_zero},
                    "of the concrete between the cracks; must be the macroscopic model's");
  material.number("Poisson's ratio", poisson_ratio, {.min = 0, .max = 0.49},
                  "of the concrete between the cracks; must be the macroscopic model's");
  material.quantity("Tensile strength", strength, Dimension::stress, {.min = above_zero},
                    "f_t: traction at which an intact ligament starts to open");
  material.quantity("Fracture energy", fracture_energy, Dimension::energy_per_area, {.min = above_zero},
                    "G_f: energy per area to separate the faces of a crack completely");
  material.choice(
      "Softening", softening, softening_words(),
      "shape of the traction-opening curve after the strength; bilinear: Petersson 1981; exponential: "
      "exp(-w / c), cut off at w = 5 c and lowered by 0.7 % of the strength, so that it ends there "
      "at zero (5.18 G_f / f_t) with the whole fracture energy");
  material.number("Shear strength", mode.strength_ratio, {.min = 0.05, .max = 20},
                  "of an intact ligament, in units of the tensile strength");
  material.number("Shear fracture energy", mode.energy_ratio, {.min = 0.05, .max = 100},
                  "G_II, in units of the fracture energy");
  material.number("Friction", mode.friction, {.min = 0, .max = 2},
                  "Coulomb coefficient between crack faces that press on each other");
  material.number("Strength scatter", strength_scatter, {.min = 0, .max = 0.5},
                  "the strength of each crack line is multiplied by a random factor within 1 +- this (from "
                  "Cracks/Seed); its "
                  "fracture energy is not");
}

void MicrocellInputs::declare_cell(Parameters& parameters) {
  auto cell = parameters.section("Cell");
  cell.integer("Dimension", dimension, {.min = 2, .max = 3}, "2: plane strain; 3: a cube");
  cell.quantities("Sizes", sizes, Dimension::length, {.min = above_zero},
                  "edges of the cells, ascending; one curve of the table each");
  cell.quantity("Reference size", reference_size, Dimension::length, {.min = above_zero},
                "the size, one of Sizes, whose curve.csv and fields are written");
  cell.number("Initial crack", geometry.crack_ratio, {.min = 0, .max = 0.9},
              "2 a0 / l: length or diameter of each initial crack over the cell's edge");
  cell.choice("Boundary", boundary, boundary_words(),
              "boundary condition; under linear displacement no crack can cross the edge of the cell");
}

void MicrocellInputs::declare_cracks(Parameters& parameters) {
  auto cracks = parameters.section("Cracks");
  cracks.choice("Shape", geometry.shape, shape_words(),
                "in 3D. through: the cracks of the plane cell, extended along z; penny: one circular crack "
                "in the middle plane");
  cracks.integer("Lines", geometry.lines, {.min = 1, .max = 20}, "parallel crack lines, evenly spaced");
  cracks.integer("Cracks per line", geometry.cracks_per_line, {.min = 1, .max = 20},
                 "initial cracks on each line; the ligaments between their tips are cohesive");
  cracks.number("Offset x", geometry.offset_x, {.min = -0.5, .max = 0.5},
                "of the cracks to the right of their regular places, fraction of the edge");
  cracks.number("Offset y", geometry.offset_y, {.min = -0.5, .max = 0.5}, "upwards, fraction of the edge");
  cracks.number("Angle", geometry.angle, {.min = -75, .max = 75},
                "of the cracks against the horizontal, degrees");
  cracks.choice(
      "Ligament", geometry.ligament, ligament_words(),
      "joined: straight to the next tip; aligned: in the crack's direction (one crack, angles whose "
      "tangent is a ratio of small integers)");
  cracks.number("Length scatter", geometry.random.length, {.min = 0, .max = 1},
                "random lengths: mean times 1 +- this");
  cracks.number("Angle scatter", geometry.random.angle, {.min = 0, .max = 75},
                "random angles: mean +- this, degrees");
  cracks.number("Position scatter", geometry.random.position, {.min = 0, .max = 1},
                "random positions: 0 regular, 1 anywhere in the crack's share of its line");
  cracks.integer("Vertical lines", geometry.vertical.count, {.min = 0, .max = 20},
                 "straight vertical crack lines, evenly spaced, which cross the others");
  cracks.number("Vertical crack", geometry.vertical.crack_ratio, {.min = 0, .max = 0.9},
                "length of the initial crack in the middle of each vertical line over the cell's edge");
  cracks.integer("Seed", geometry.random.seed, {.min = 0, .max = 1e9}, "of all random numbers");
  cracks.number("Imperfection", imperfection, {.min = 0, .max = 0.5},
                "relative reduction of the strength of the lowest line, which makes equal lines different");
}

void MicrocellInputs::declare_mesh(Parameters& parameters) {
  auto density = parameters.section("Mesh");
  density.integer("Elements", mesh.elements, {.min = 2, .max = most_elements},
                  "elements over half the cell's height; the width follows");
  density.number("Grading", mesh.grading, {.min = 1, .max = 8},
                 "element size grows as (distance from the crack tip)^(1 - 1/grading); 1: uniform");
  density.integer("Degree", mesh.degree, {.min = 1, .max = 3}, "polynomial degree of the displacement");
  density.choice("Kind", mesh.kind, element_words(),
                 "continuous: nodes are doubled on cracks only; discontinuous: every element has its own "
                 "nodes, coupled by "
                 "the symmetric interior penalty form, in 2D only");
  density.number("Penalty", mesh.penalty, {.min = 0.01, .max = 1e4},
                 "of discontinuous elements, in units of p (p + 1) (lambda + 2 mu) / h");
  density.integer("Layers", mesh.layers, {.min = 1, .max = 100},
                  "in 3D: elements along z of a cell with through cracks");
}

/// How the cell is strained as a whole.
void MicrocellInputs::declare_loading(Parameters& parameters) {
  auto loading = parameters.section("Loading");
  static const std::vector<std::pair<std::string, LoadMode>> modes = {
      {"uniaxial strain", LoadMode::uniaxial_strain},
      {"uniaxial stress", LoadMode::uniaxial_stress},
      {"biaxial", LoadMode::biaxial},
      {"shear", LoadMode::shear},
      {"direction", LoadMode::direction}};
  loading.choice(
      "Mode", load_mode, modes,
      "uniaxial: along y, with the side strains or the side stresses zero; biaxial: equal strains xx and "
      "yy; shear: strain 2 e_xy; direction: the strains below");
  loading.number("Strain xx", strain_xx, {.min = -1, .max = 1}, "of mode direction");
  loading.number("Strain yy", strain_yy, {.min = -1, .max = 1}, "of mode direction");
  loading.number("Strain zz", strain_zz, {.min = -1, .max = 1}, "of mode direction, in 3D");
  loading.number("Shear strain xy", strain_xy, {.min = -1, .max = 1}, "2 e_xy, of mode direction");
  loading.number("Shear strain yz", strain_yz, {.min = -1, .max = 1}, "2 e_yz, of mode direction, in 3D");
  loading.number("Shear strain xz", strain_xz, {.min = -1, .max = 1}, "2 e_xz, of mode direction, in 3D");
}

/// How that strain grows row by row, and what is done where no stable state follows.
void MicrocellInputs::declare_stepping(Parameters& parameters) {
  auto loading = parameters.section("Loading");
  loading.quantities(
      "Turning strains", stepping.turning_strains, Dimension::none, {.min = -1, .max = 1},
      "strains at which the loading turns round, in order, before it goes on to the final strain");
  static const std::vector<std::pair<std::string, AtInstability>> ways = {{"follow", AtInstability::follow},
                                                                          {"refuse", AtInstability::refuse}};
  loading.choice(
      "Snap-back", stepping.snap_back, ways,
      "where strain must fall for the crack to grow on: follow by prescribing the damage (the table "
      "gets the envelope), or end with exit code 3");
  loading.choice("Bifurcation", stepping.bifurcation, ways,
                 "where the path branches: follow the stable branch, or end with exit code 3");
  loading.number("Damage step", stepping.damage_step, {.min = 1e-6, .max = 0.1},
                 "share of the fracture energy in the first row that prescribes damage; later rows adapt");
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
}

void MicrocellInputs::declare_solver_and_output(Parameters& parameters) {
  auto solver = parameters.section("Solver");
  solver.number("Tolerance", newton.tolerance, {.min = 1e-12, .max = 1e-7},
                "largest error of the traction at any node of the crack line, in units of f_t");
  solver.integer("Iterations", newton.max_iterations, {.min = 1, .max = 1000},
                 "Newton iterations before a step is cut");

  parameters.section("Output").integer("Field states", field_states, {.min = 0, .max = 1000},
                                       "states of the reference cell written as fields; 0: none");
}

void MicrocellInputs::declare_ensemble(Parameters& parameters) {
  auto many = parameters.section("Ensemble");
  many.integer("Samples", ensemble.samples, {.min = 0, .max = 100000},
               "random cells (sections Cracks and Material) whose mean and band become tables; 0: one cell");
  many.integer("Seed", ensemble.seed, {.min = 0, .max = 1e9},
               "of the first sample; the next have the next numbers");
  many.integer("Threads", ensemble.threads, {.min = 0, .max = 1024}, "0: as many as the machine has");
  many.number("Band", ensemble.band, {.min = 0.001, .max = 0.5},
              "quantile of the stress for the weak table; 1 minus it for the strong one");
}

template<int dim> MacroLoad<dim> MicrocellInputs::load() const {
  MacroLoad<dim> load;
  switch (load_mode) {
  case LoadMode::uniaxial_strain:
    break;
  case LoadMode::uniaxial_stress:
    load.free.fill(true);
    load.free[1] = false;
    break;
  case LoadMode::biaxial:
    load.direction[0] = 1;
    break;
  case LoadMode::shear:
    load.direction = Voigt<dim>::Unit(dim); // xy
    break;
  case LoadMode::direction:
    if constexpr (dim == 2)
      load.direction << strain_xx, strain_yy, strain_xy;
    else
      load.direction << strain_xx, strain_yy, strain_zz, strain_xy, strain_yz, strain_xz;
    break;
  }
  return load;
}
template MacroLoad<2> MicrocellInputs::load() const;
template MacroLoad<3> MicrocellInputs::load() const;

std::vector<std::unique_ptr<CohesiveLaw>> MicrocellInputs::line_laws(double cell_size) const {
  std::vector<std::unique_ptr<CohesiveLaw>> laws;
  const bool zones = aggregates.present();
  if (!zones && imperfection == 0 && strength_scatter == 0) return laws;
  const std::size_t particles = zones ? aggregate_diameters(aggregates.grading, cell_size).size() : 0;
  const CrackLines set = zones ? CrackLines{} : crack_lines(geometry);
  const std::size_t lines = zones ? 2 * particles : set.lines.size() + set.vertical.size();
  // A stream of its own: the same cracks with and without scatter.
  std::mt19937 random(static_cast<std::uint32_t>(geometry.random.seed) ^ 0x9e3779b9U);
  for (std::size_t k = 0; k < lines; ++k) {
    const double draw = random() * (2.0 / 4294967295.0) - 1;
    const bool zone = k < particles;
    const double factor = (1 + strength_scatter * draw) * (k == 0 ? 1 - imperfection : 1) *
                          (zone ? aggregates.zone_strength : 1);
    laws.push_back(make_cohesive_law(softening, factor * strength,
                                     fracture_energy * (zone ? aggregates.zone_energy : 1)));
  }
  return laws;
}

std::string MicrocellInputs::describe_cracks() const {
  if (aggregates.present()) return aggregates.describe() + ", seed " + std::to_string(geometry.random.seed);
  if (dimension == 3 && geometry.shape == CrackShape::penny)
    return "3D, one centred penny crack, 2 a0 / l = " +
           format_quantity(geometry.crack_ratio, Dimension::none);
  std::string text = (dimension == 3 ? "3D, all along z: " : "") + describe_lines(geometry);
  if (geometry.vertical.count > 0)
    text += "; crossed by " + std::to_string(geometry.vertical.count) + " vertical line(s), 2 a0 / l = " +
            format_quantity(geometry.vertical.crack_ratio, Dimension::none);
  return text;
}

std::string MicrocellInputs::describe_loading() const {
  switch (load_mode) {
  case LoadMode::uniaxial_strain:
    return "uniaxial strain";
  case LoadMode::uniaxial_stress:
    return "uniaxial stress";
  case LoadMode::biaxial:
    return "biaxial strain";
  case LoadMode::shear:
    return "shear strain";
  case LoadMode::direction:
    break;
  }
  std::vector<double> strain = {strain_xx, strain_yy, strain_xy};
  if (dimension == 3) strain = {strain_xx, strain_yy, strain_zz, strain_xy, strain_yz, strain_xz};
  std::string text = "strain direction";
  for (const double value : strain)
    text += (text.back() == 'n' ? " " : ", ") + format_quantity(value, Dimension::none);
  return text;
}

} // namespace spall
