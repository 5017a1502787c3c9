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
  material.quantity(
      "Young's modulus", youngs_modulus, Dimension::stress, {.min = above_zero},
      "Young's modulus of the concrete between the cracks; it must be that of the macroscopic model");
  material.number(
      "Poisson's ratio", poisson_ratio, {.min = 0, .max = 0.49},
      "Poisson's ratio of the concrete between the cracks; it must be that of the macroscopic model");
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
                  "shear strength of an intact ligament, in units of the tensile strength");
  material.number("Shear fracture energy", mode.energy_ratio, {.min = 0.05, .max = 100},
                  "mode II fracture energy G_II, in units of the fracture energy");
  material.number("Friction", mode.friction, {.min = 0, .max = 2},
                  "Coulomb friction coefficient of crack faces in contact");
  material.number("Strength scatter", strength_scatter, {.min = 0, .max = 0.5},
                  "relative scatter s: the strength of each crack line is multiplied by a random factor "
                  "between 1 - s and 1 + s (from Cracks/Seed); its fracture energy is not");
}

void MicrocellInputs::declare_cell(Parameters& parameters) {
  auto cell = parameters.section("Cell");
  cell.integer("Dimension", dimension, {.min = 2, .max = 3},
               "spatial dimension. 2: a square cell in plane strain; 3: a cubic cell");
  cell.quantities("Sizes", sizes, Dimension::length, {.min = above_zero},
                  "edge lengths of the cells, ascending; each gives one curve of the damage table");
  cell.quantity("Reference size", reference_size, Dimension::length, {.min = above_zero},
                "the cell size, one of Sizes, for which curve.csv and fields are written");
  cell.number("Initial crack", geometry.crack_ratio, {.min = 0, .max = 0.9},
              "2 a0 / l: length or diameter of each initial crack over the edge length of the cell");
  cell.choice("Boundary", boundary, boundary_words(),
              "boundary condition; under linear displacement no crack can cross the edge of the cell");
}

void MicrocellInputs::declare_cracks(Parameters& parameters) {
  auto cracks = parameters.section("Cracks");
  cracks.choice("Shape", geometry.shape, shape_words(),
                "shape of the initial cracks in 3D. through: the cracks of the plane cell, extended along z; "
                "penny: one circular crack in the middle plane");
  cracks.integer("Lines", geometry.lines, {.min = 1, .max = 20},
                 "number of parallel, evenly spaced crack lines");
  cracks.integer("Cracks per line", geometry.cracks_per_line, {.min = 1, .max = 20},
                 "number of initial cracks on each line; the ligaments between their tips are cohesive");
  cracks.number("Offset x", geometry.offset_x, {.min = -0.5, .max = 0.5},
                "shift of the cracks to the right of their regular positions, as a fraction of the edge");
  cracks.number("Offset y", geometry.offset_y, {.min = -0.5, .max = 0.5},
                "upward shift of the cracks, as a fraction of the edge");
  cracks.number("Angle", geometry.angle, {.min = -75, .max = 75},
                "angle between the cracks and the horizontal, degrees");
  cracks.choice("Ligament", geometry.ligament, ligament_words(),
                "direction of the ligaments. joined: straight to the next tip; aligned: in the crack's "
                "direction (for a single crack, at angles whose tangent is a ratio of small integers)");
  cracks.number("Length scatter", geometry.random.length, {.min = 0, .max = 1},
                "relative scatter s of the crack lengths, uniform from (1 - s) to (1 + s) times the mean");
  cracks.number("Angle scatter", geometry.random.angle, {.min = 0, .max = 75},
                "scatter s of the crack angles, uniform from mean - s to mean + s, degrees");
  cracks.number(
      "Position scatter", geometry.random.position, {.min = 0, .max = 1},
      "scatter of the crack positions. 0: evenly spaced; 1: anywhere in the crack's share of its line");
  cracks.integer("Vertical lines", geometry.vertical.count, {.min = 0, .max = 20},
                 "number of straight, evenly spaced vertical crack lines, which cross the others");
  cracks.number(
      "Vertical crack", geometry.vertical.crack_ratio, {.min = 0, .max = 0.9},
      "length of the initial crack in the middle of each vertical line over the edge length of the cell");
  cracks.integer("Seed", geometry.random.seed, {.min = 0, .max = 1e9}, "seed of all random numbers");
  cracks.number(
      "Imperfection", imperfection, {.min = 0, .max = 0.5},
      "relative reduction of the strength of the lowest line, which breaks the symmetry of equal lines");
}

void MicrocellInputs::declare_mesh(Parameters& parameters) {
  auto density = parameters.section("Mesh");
  density.integer(
      "Elements", mesh.elements, {.min = 2, .max = most_elements},
      "number of elements over half the height of the cell; the number over the width follows from it");
  density.number("Grading", mesh.grading, {.min = 1, .max = 8},
                 "mesh grading: the element size grows as (distance from the crack tip)^(1 - 1/grading); 1: "
                 "uniform mesh");
  density.integer("Degree", mesh.degree, {.min = 1, .max = 3}, "polynomial degree of the displacement");
  density.choice(
      "Kind", mesh.kind, element_words(),
      "kind of finite elements. continuous: nodes are doubled on cracks only; discontinuous: every element "
      "has its own nodes, coupled by the symmetric interior penalty form, in 2D only");
  density.number("Penalty", mesh.penalty, {.min = 0.01, .max = 1e4},
                 "interior penalty of discontinuous elements, in units of p (p + 1) (lambda + 2 mu) / h");
  density.integer("Layers", mesh.layers, {.min = 1, .max = 100},
                  "number of elements along z in a 3D cell with through cracks");
}

/// Declares the keys of the macroscopic strain path.
void MicrocellInputs::declare_loading(Parameters& parameters) {
  auto loading = parameters.section("Loading");
  static const std::vector<std::pair<std::string, LoadMode>> modes = {
      {"uniaxial strain", LoadMode::uniaxial_strain},
      {"uniaxial stress", LoadMode::uniaxial_stress},
      {"biaxial", LoadMode::biaxial},
      {"shear", LoadMode::shear},
      {"direction", LoadMode::direction}};
  loading.choice("Mode", load_mode, modes,
                 "strain path. uniaxial strain or stress: tension along y with zero lateral strains or "
                 "stresses; biaxial: equal strains xx and yy; shear: strain 2 e_xy; direction: the strains "
                 "given by the keys below");
  loading.number("Strain xx", strain_xx, {.min = -1, .max = 1},
                 "component e_xx of the strain for mode direction");
  loading.number("Strain yy", strain_yy, {.min = -1, .max = 1},
                 "component e_yy of the strain for mode direction");
  loading.number("Strain zz", strain_zz, {.min = -1, .max = 1},
                 "component e_zz of the strain for mode direction, in 3D");
  loading.number("Shear strain xy", strain_xy, {.min = -1, .max = 1},
                 "shear strain 2 e_xy for mode direction");
  loading.number("Shear strain yz", strain_yz, {.min = -1, .max = 1},
                 "shear strain 2 e_yz for mode direction, in 3D");
  loading.number("Shear strain xz", strain_xz, {.min = -1, .max = 1},
                 "shear strain 2 e_xz for mode direction, in 3D");
}

/// Declares the keys of the step control, and of the reaction to instabilities.
void MicrocellInputs::declare_stepping(Parameters& parameters) {
  auto loading = parameters.section("Loading");
  loading.quantities("Turning strains", stepping.turning_strains, Dimension::none, {.min = -1, .max = 1},
                     "strains at which the loading reverses its direction, in order, before it continues to "
                     "the final strain");
  static const std::vector<std::pair<std::string, AtInstability>> reactions = {
      {"follow", AtInstability::follow}, {"refuse", AtInstability::refuse}};
  loading.choice("Snap-back", stepping.snap_back, reactions,
                 "reaction to a snap-back, where the strain must decrease for the crack to grow. follow: "
                 "prescribes the dissipated energy instead of the strain (the damage table gets the "
                 "envelope); refuse: ends with exit code 3");
  loading.choice("Bifurcation", stepping.bifurcation, reactions,
                 "reaction to a bifurcation of the equilibrium path. follow: continues on the stable branch; "
                 "refuse: ends with exit code 3");
  loading.number("Damage step", stepping.damage_step, {.min = 1e-6, .max = 0.1},
                 "first step of damage control, as a fraction of the fracture energy of all ligaments; later "
                 "steps adapt");
  loading.number(
      "Row growth", stepping.growth, {.min = 1e-4, .max = 0.2},
      "relative growth of the strain from row to row; up to the strain f_t / M the rows are equally spaced "
      "by this fraction of it (M: stiffness of the uncracked cell along the strain path)");
  loading.number("Final strain", stepping.final_strain, {.min = 1e-3, .max = 100},
                 "strain of the last row in units of w_f / l, at which the cell has failed completely (in "
                 "units of 2 f_t / M if that is larger)");
  loading.number("Stress change", stepping.stress_change, {.min = 1e-4, .max = 1},
                 "largest change of stress from row to row, in units of f_t; larger changes halve the step");
  loading.number("Smallest step", stepping.smallest_step, {.min = 1e-9, .max = 1},
                 "smallest step of strain, in units of f_t / M; where it is too large, the keys Snap-back "
                 "and Bifurcation apply");
}

void MicrocellInputs::declare_solver_and_output(Parameters& parameters) {
  auto solver = parameters.section("Solver");
  solver.number("Tolerance", newton.tolerance, {.min = 1e-12, .max = 1e-7},
                "largest error of the traction at any node of the crack line, in units of f_t");
  solver.integer("Iterations", newton.max_iterations, {.min = 1, .max = 1000},
                 "largest number of Newton iterations; after them the step is halved");

  parameters.section("Output").integer(
      "Field states", field_states, {.min = 0, .max = 1000},
      "number of states of the reference cell that are written as fields; 0: none");
}

void MicrocellInputs::declare_ensemble(Parameters& parameters) {
  auto section = parameters.section("Ensemble");
  section.integer("Samples", ensemble.samples, {.min = 0, .max = 100000},
                  "number of random cells (sections Cracks and Material) whose mean and quantiles become "
                  "tables; 0: one cell");
  section.integer("Seed", ensemble.seed, {.min = 0, .max = 1e9},
                  "random seed of the first sample; each further sample has the next number");
  section.integer("Threads", ensemble.threads, {.min = 0, .max = 1024},
                  "number of threads; 0: one for each core of the machine");
  section.number("Band", ensemble.band, {.min = 0.001, .max = 0.5},
                 "quantile of the stress for the weak table; the strong table has the quantile 1 - band");
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
  // The strengths have a random sequence of their own, so that the cracks are the same with and without
  // scatter.
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
