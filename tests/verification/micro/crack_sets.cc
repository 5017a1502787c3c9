// Tests of cracks other than the single centred one, boundaries other than periodic, and loads other than
// uniaxial strain.

#include "micro/cohesive/linear_softening.h"
#include "micro/equilibrium/condense.h"
#include "micro/inputs.h"
#include "micro/loading/curve_tracing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace {

using namespace spall;

constexpr double E = 18727e6, nu = 0.3585, ft = 3e6, Gf = 80, ratio = 0.25, size = 0.016;
const double M = (1 - nu) / ((1 + nu) * (1 - 2 * nu)), plane = 1 / (1 - nu * nu); // over E
const LinearSoftening law(ft, Gf);

InterfaceProblem<2> problem(const CondensedCell<2>& cell) {
  return {.cell = cell, .law = law, .youngs_modulus = E, .cell_size = size};
}
CurveTrace<2> trace(const InterfaceProblem<2>& p, const SteppingSettings& settings = {}) {
  const CurveTrace<2> result = trace_curve(p, settings, [](const DamageCurve&) { return true; });
  EXPECT_TRUE(result.complete()) << result.failure;
  return result;
}
double peak(const DamageCurve& curve) { return *std::max_element(curve.stress.begin(), curve.stress.end()); }

// On a crack through the cell at angle theta normal and shear stress vanish; the remaining stiffness is E'
// along it, as in plane stress: d = 1 - E' / E_oed sin^4(theta).
TEST(InclinedCrack, BrokenCellKeepsTheStiffnessAlongTheCrack) {
  for (const double tangent : {0.5, 1.0}) {
    const double theta = std::atan(tangent);
    const CondensedCell<2> cell = condense(
        {.crack_ratio = ratio, .angle = theta * 180 / std::numbers::pi, .ligament = Ligament::aligned},
        {.elements = 3}, nu);
    const CurveTrace<2> t = trace(problem(cell), {.final_strain = 3});
    EXPECT_NEAR(t.curve.damage.back(), 1 - plane / M * std::pow(std::sin(theta), 4), 1e-4) << tangent;
    // The crack length is 1 / cos(theta) per period, times the number of periods after which the line closes.
    const double periods = tangent == 0.5 ? 2 : 1;
    EXPECT_NEAR(t.curve.dissipation.back(), Gf / size * (periods / std::cos(theta) - ratio),
                1e-6 * Gf / size);
    EXPECT_LE(check_energies(t.curve).stress, 1e-8);
  }
}

TEST(InclinedCrack, JoinedLigamentsDissipateTheirLength) {
  const double theta = 30 * std::numbers::pi / 180;
  const CurveTrace<2> t = trace(problem(condense({.crack_ratio = ratio, .angle = 30}, {}, nu)));
  const double ligament = std::hypot(1 - ratio * std::cos(theta), ratio * std::sin(theta));
  EXPECT_NEAR(t.curve.dissipation.back(), Gf / size * ligament, 1e-9 * Gf / size);
  EXPECT_NEAR(t.curve.work.back(), Gf / size * ligament, 0.002 * Gf / size);
}

// A periodic cell is invariant to translations of its cracks. The two meshes are made by different code.
TEST(OffCentreCrack, IsTheSameCellShifted) {
  const DamageCurve centred = trace(problem(condense({.crack_ratio = ratio}, {}, nu))).curve;
  const DamageCurve shifted =
      trace(problem(condense({.crack_ratio = ratio, .offset_x = 0.13, .offset_y = -0.17}, {}, nu))).curve;
  EXPECT_NEAR(centred.damage[0], shifted.damage[0], 5e-4);
  EXPECT_NEAR(peak(centred), peak(shifted), 5e-4 * ft);
  EXPECT_NEAR(centred.work.back(), shifted.work.back(), 1e-3 * centred.work.back());
}

// With two equal lines the symmetric path, which would dissipate twice the energy, is unstable as soon as the
// ligaments soften.
TEST(ParallelCracks, OnlyOneOfTwoOpens) {
  const CondensedCell<2> cell =
      condense({.crack_ratio = ratio, .lines = 2}, {.elements = 4, .grading = 2, .degree = 2}, nu);
  const double once = Gf * (1 - ratio) / size;
  const CurveTrace<2> branched = trace(problem(cell));
  ASSERT_FALSE(branched.events.empty());
  EXPECT_EQ(branched.events[0].kind, CurveEvent::Kind::bifurcation);
  EXPECT_NEAR(branched.curve.dissipation.back(), once, 0.02 * once);
  for (const RowReport& row : branched.reports) EXPECT_EQ(row.stability.negative, 0);

  // If one line is slightly weaker, there is no bifurcation and nearly the same result.
  const LinearSoftening weaker(0.99 * ft, Gf);
  InterfaceProblem<2> told = problem(cell);
  told.line_laws = {&weaker, &law};
  const CurveTrace<2> imperfect = trace(told);
  EXPECT_TRUE(imperfect.events.empty());
  EXPECT_NEAR(imperfect.curve.dissipation.back(), once, 0.02 * once);
  EXPECT_NEAR(peak(imperfect.curve), peak(branched.curve), 0.015 * peak(branched.curve));

  const CurveTrace<2> refused = trace_curve(problem(cell), {.bifurcation = AtInstability::refuse},
                                            [](const DamageCurve&) { return true; });
  EXPECT_NE(refused.failure.find("branches"), std::string::npos) << refused.failure;
}

// The lowest eigenvalue decreases towards the bifurcation, and its eigenvector is antisymmetric.
TEST(ParallelCracks, LowestModeIsAntisymmetric) {
  const CondensedCell<2> cell =
      condense({.crack_ratio = ratio, .lines = 2}, {.elements = 4, .grading = 2, .degree = 2}, nu);
  const InterfaceProblem<2> p = problem(cell);
  const CurveTrace<2> t = trace(p);
  ASSERT_FALSE(t.events.empty());
  const auto& strain = t.curve.strain;
  const auto last = std::find(strain.begin(), strain.end(), t.events[0].from) -
                    strain.begin(); // the row before the bifurcation
  EXPECT_LT(t.reports[last].stability.lowest, 0.7 * t.reports[0].stability.lowest);
  const Stability s = stability(p, t.states[last]);
  double first = 0, second = 0;
  for (std::size_t i = 0; i < cell.nodes.size(); ++i)
    (cell.nodes[i].line == 0 ? first : second) += cell.nodes[i].weight * s.modes(2 * i, 0);
  EXPECT_NEAR(first / second, -1, 0.2);
}

// Energy bounds: linear displacements are stiffer than periodic boundaries, which are stiffer than uniform
// tractions.
TEST(Boundaries, OrderTheStiffness) {
  const auto initial = [](Boundary boundary) {
    return initial_damage(problem(condense({.crack_ratio = 0.5}, {}, nu, boundary)));
  };
  const double held = initial(Boundary::linear_displacement), repeated = initial(Boundary::periodic),
               loose = initial(Boundary::uniform_traction);
  EXPECT_LT(held, repeated - 0.005);
  EXPECT_LT(repeated, loose - 0.005);
}

TEST(Boundaries, UncrackedCellIsUniformUnderAll) {
  for (const auto& [word, boundary] : boundary_words()) {
    const CondensedCell<2> cell = condense({.crack_ratio = 0}, {.elements = 3}, nu, boundary);
    EXPECT_NEAR(cell.uncracked(1, 1), M, 1e-12) << word;
    EXPECT_NEAR(cell.uncracked(2, 2), 0.5 / (1 + nu), 1e-12) << word;
  }
}

// No crack can cross an edge that follows the macroscopic strain.
TEST(Boundaries, LinearDisplacementSaturates) {
  const CondensedCell<2> cell = condense({.crack_ratio = ratio}, {}, nu, Boundary::linear_displacement);
  EXPECT_NEAR(trace(problem(cell)).curve.damage.back(), 0.79, 0.01);
}

TEST(Loads, UniaxialStressLeavesNoOtherStress) {
  const CondensedCell<2> full = condense({.crack_ratio = ratio, .angle = 30}, {}, nu);
  const std::array<bool, 3> free = {true, false, true};
  const CondensedCell<2> cell = release(full, free);
  // In plane strain the uncracked stiffness under uniaxial stress in the plane is E'.
  EXPECT_NEAR(cell.uncracked(1, 1), plane, 1e-12);
  const InterfaceProblem<2> p = problem(cell), complete = problem(full);
  const CurveTrace<2> t = trace(p);
  for (std::size_t i = 0; i < t.states.size(); i += 20) {
    CellState<2> state = t.states[i];
    state.strain = complete_strain(full, free, state.strain, state.opening / size);
    const Voigt<2> stress = homogenize(complete, state).stress;
    EXPECT_NEAR(stress[0], 0, 1e-9 * ft);
    EXPECT_NEAR(stress[2], 0, 1e-9 * ft);
    EXPECT_NEAR(stress[1], t.curve.stress[i], 1e-8 * ft);
  }
}

// Biaxial strain adds a lateral stress that does not act on the horizontal crack; the dissipated energy is
// the same.
TEST(Loads, BiaxialStrainKeepsTheStiffnessAlongTheCrack) {
  const CondensedCell<2> cell = condense({.crack_ratio = ratio}, {}, nu);
  InterfaceProblem<2> p = problem(cell);
  p.direction = {1, 1, 0};
  const CurveTrace<2> t = trace(p);
  EXPECT_NEAR(t.curve.dissipation.back(), Gf * (1 - ratio) / size, 1e-9 * Gf / size);
  const double lateral = nu / ((1 + nu) * (1 - 2 * nu)), undamaged = 2 * (M + lateral);
  EXPECT_NEAR(t.curve.damage.back(), 1 - plane / undamaged, 1e-6);
}

TEST(Loads, ShearThroughTheCrackDissipatesTheSecondModesEnergy) {
  const CondensedCell<2> cell = condense({.crack_ratio = ratio}, {}, nu);
  InterfaceProblem<2> p = problem(cell);
  p.mode = {.strength_ratio = 1.5, .energy_ratio = 3};
  p.direction = {0, 0, 1};
  const CurveTrace<2> t = trace(p, {.final_strain = 3});
  const double expected = 3 * Gf * (1 - ratio) / size;
  EXPECT_NEAR(t.curve.damage.back(), 1, 1e-9);
  EXPECT_NEAR(t.curve.dissipation.back(), expected, 1e-3 * expected);
  EXPECT_NEAR(t.curve.work.back(), expected, 2e-3 * expected);
}

// Under pressure and shear a cracked cell is as stiff as an intact one inside the Coulomb cone; on the cone
// the work is dissipated by friction.
TEST(Loads, FrictionHoldsACrackUnderPressure) {
  const CondensedCell<2> cell = condense({.crack_ratio = ratio}, {}, nu);
  InterfaceProblem<2> p = problem(cell);
  p.mode.friction = 0.5;
  CellState<2> state = unloaded_state(p);
  std::fill(state.largest.begin(), state.largest.end(),
            2 * law.final_opening()); // all nodes are fully broken
  const double shear_modulus = 0.5 / (1 + nu), pressure = 1e-4 * M;
  for (const double share : {0.5, 0.99, 1.5, 3.0}) {
    const double shear = share * 0.5 * pressure / shear_modulus;
    ASSERT_EQ(equilibrate(p, {0, -1e-4, shear}, Eigen::VectorXd(state.opening), state).outcome,
              NewtonReport::Outcome::converged);
    EXPECT_NEAR(homogenize(p, state).stress[2], std::min(share, 1.0) * 0.5 * pressure * E, 1e-6 * ft)
        << share;
    EXPECT_EQ(state.friction_work > 0, share > 1);
  }
}

TEST(SpectralSplit, SumsToTheElasticEnergyAndSeparatesTheSigns) {
  const double lambda = nu / ((1 + nu) * (1 - 2 * nu)), mu = 0.5 / (1 + nu);
  for (const Voigt<2>& e :
       {Voigt<2>(0, 1, 0), Voigt<2>(1, -2, 0.7), Voigt<2>(-1, -1, 3), Voigt<2>(0, -1, 0)}) {
    const SplitEnergy split = spectral_split<2>(e, nu);
    const double trace_of = e[0] + e[1];
    EXPECT_NEAR(split.plus + split.minus,
                0.5 * lambda * trace_of * trace_of + mu * (e[0] * e[0] + e[1] * e[1] + 0.5 * e[2] * e[2]),
                1e-12);
  }
  EXPECT_EQ(spectral_split<2>({0, 1, 0}, nu).minus, 0);
  EXPECT_EQ(spectral_split<2>({0, -1, 0}, nu).plus, 0);
  EXPECT_NEAR(damage_plus(0.25, {.plus = 1, .minus = 0}), 0.75, 1e-15);
}

TEST(RandomCracks, SeedDeterminesTheCracksAndLinesKeepTheirDistance) {
  CellGeometry g{.crack_ratio = 0.15,
                 .lines = 2,
                 .cracks_per_line = 2,
                 .random = {.length = 0.5, .angle = 20, .position = 0.8}};
  std::vector<double> first;
  for (int seed = 1; seed <= 200; ++seed) {
    g.random.seed = seed;
    const CrackLines set = crack_lines(g), again = crack_lines(g);
    ASSERT_EQ(set.lines.size(), 2U);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(set.lines[k].knots.size(), 6U);
      for (std::size_t i = 1; i < set.lines[k].knots.size(); ++i) {
        EXPECT_GT(set.lines[k].knots[i].x, set.lines[k].knots[i - 1].x);
        EXPECT_EQ(set.lines[k].knots[i].y, again.lines[k].knots[i].y);
      }
      EXPECT_EQ(set.lines[k].knots.front().y, set.lines[k].knots.back().y);
    }
    first.push_back(set.lines[0].knots[1].x);
  }
  std::sort(first.begin(), first.end());
  EXPECT_EQ(std::adjacent_find(first.begin(), first.end()), first.end());
  g.angle = 70;
  g.random.angle = 0;
  g.random.length = 1;
  g.crack_ratio = 0.9;
  EXPECT_THROW(crack_lines(g), std::invalid_argument);
  EXPECT_THROW(crack_lines({.crack_ratio = 0.2, .angle = 10, .ligament = Ligament::aligned}),
               std::invalid_argument);
}

} // namespace
