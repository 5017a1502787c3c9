// Tests with case A: plane strain, l = 16 mm, 2 a0 = l / 4, f_t = 3 MPa, G_f = 80 N/m, linear softening,
// periodic boundaries. The reference numbers come from an independent solver; the other properties hold for
// any cell.

#include "micro/cohesive/linear_softening.h"
#include "micro/equilibrium/condense.h"
#include "micro/loading/curve_tracing.h"
#include "shared/damage_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace {

using namespace spall;

constexpr double E = 18727e6, nu = 0.3585, ft = 3e6, Gf = 80, ratio = 0.25;
const double oedometric = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
const LinearSoftening law(ft, Gf);

const CondensedCell<2>& default_cell() {
  static const CondensedCell<2> cell = condense({.crack_ratio = ratio}, {}, nu);
  return cell;
}

InterfaceProblem<2> problem(const CondensedCell<2>& cell, double size) {
  return {.cell = cell, .law = law, .youngs_modulus = E, .cell_size = size};
}

DamageCurve trace(const CondensedCell<2>& cell, double size, const SteppingSettings& settings = {}) {
  const CurveTrace<2> result =
      trace_curve(problem(cell, size), settings, [](const DamageCurve&) { return true; });
  EXPECT_TRUE(result.complete()) << result.failure;
  return result.curve;
}

double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto above = std::upper_bound(x.begin(), x.end(), at) - x.begin();
  if (above == 0 || above == static_cast<std::ptrdiff_t>(x.size())) return above == 0 ? y.front() : y.back();
  return y[above - 1] + (y[above] - y[above - 1]) * (at - x[above - 1]) / (x[above] - x[above - 1]);
}

TEST(CaseA, AgreesWithTheIndependentSolver) {
  const DamageCurve curve = trace(default_cell(), 0.016);
  const auto peak = std::max_element(curve.stress.begin(), curve.stress.end());
  EXPECT_NEAR(*peak, 2.240e6, 0.002e6);
  EXPECT_NEAR(curve.strain[peak - curve.stress.begin()], 1.02e-4,
              0.02 * 1.02e-4); // the tolerance is the spacing of rows
  EXPECT_NEAR(interpolate(curve.strain, curve.damage, 1e-4), 0.284, 0.005);
  EXPECT_NEAR(interpolate(curve.strain, curve.damage, 2e-4), 0.652, 0.005);
  EXPECT_NEAR(interpolate(curve.strain, curve.damage, 1e-3), 0.948, 0.005);
}

TEST(CaseA, DissipatesTheFractureEnergyOfItsLigament) {
  const double size = 0.016;
  const DamageCurve curve = trace(default_cell(), size);
  const double expected = Gf * (1 - ratio) / size;
  EXPECT_NEAR(curve.work.back(), expected, 0.002 * expected);
  EXPECT_NEAR(curve.dissipation.back(), expected, 1e-9 * expected);
}

TEST(CaseA, FailsAtFinalOpeningOverCellSize) {
  const double size = 0.016, failure = law.final_opening() / size;
  const DamageCurve curve = trace(default_cell(), size);
  for (std::size_t i = 1; i < curve.strain.size(); ++i) {
    if (curve.strain[i] >= failure) {
      EXPECT_NEAR(curve.stress[i], 0, 1e-6 * ft);
    } else {
      EXPECT_GT(curve.stress[i], 1e-4 * ft);
    }
  }
  EXPECT_NEAR(curve.damage.back(), 1, 1e-9);
}

TEST(CaseA, FreeEnergyIsHalfStressTimesStrain) {
  EXPECT_LE(check_energies(trace(default_cell(), 0.016)).stress, 1e-8);
}

// The work is integrated by the trapezoidal rule, so the error of the balance falls with the square of the
// number of rows.
TEST(CaseA, WorkIsStoredOrDissipated) {
  const auto error = [](double growth) {
    return check_energies(trace(default_cell(), 0.016, {.growth = growth})).work;
  };
  const double coarse = error(0.08), fine = error(0.02);
  EXPECT_LE(fine, 1e-4);
  EXPECT_LE(fine, coarse / 8);
}

TEST(CaseA, DamageColumnsNeverDecrease) {
  for (const double size : {0.005, 0.016, 0.04}) {
    const DamageCurve curve = trace(default_cell(), size);
    for (const auto column :
         {&DamageCurve::damage, &DamageCurve::damage_strength, &DamageCurve::damage_renormalised})
      for (std::size_t i = 1; i < curve.strain.size(); ++i)
        EXPECT_GE((curve.*column)[i], (curve.*column)[i - 1] - 1e-12);
    EXPECT_EQ(curve.damage_renormalised.front(), 0);
  }
}

// Eq. 29 as a finite difference along the path is not a damage variable: it exceeds 1 (1.011 at this size).
TEST(CaseA, PathDerivativeOvershoots) {
  const DamageCurve curve = trace(default_cell(), 0.016);
  const double failure = law.final_opening() / 0.016;
  double largest = 0;
  for (std::size_t i = 0; curve.strain[i] < failure; ++i) {
    ASSERT_TRUE(std::isfinite(curve.damage_path[i])) << i;
    largest = std::max(largest, curve.damage_path[i]);
  }
  EXPECT_NEAR(largest, 1.011, 0.003);
}

TEST(CaseA, UnloadsAlongTheSecant) {
  const InterfaceProblem<2> p = problem(default_cell(), 0.016);
  CurveTrace<2> loading = trace_curve(p, {}, [](const DamageCurve& c) { return c.strain.back() < 5e-4; });
  CellState<2> state = loading.states.back();
  const HomogenizedState<2> top = homogenize(p, state);
  const Voigt<2> strain = state.strain;
  for (const double fraction : {0.8, 0.5, 0.1}) {
    ASSERT_EQ(equilibrate(p, fraction * strain, Eigen::VectorXd(fraction * state.opening), state).outcome,
              NewtonReport::Outcome::converged);
    const HomogenizedState<2> now = homogenize(p, state);
    EXPECT_NEAR(now.stress[1], fraction * top.stress[1], 1e-8 * ft);
    EXPECT_DOUBLE_EQ(now.dissipation, top.dissipation);
  }
}

TEST(CaseA, ClosedCrackHasTheStiffnessOfIntactConcrete) {
  const InterfaceProblem<2> p = problem(default_cell(), 0.016);
  CellState<2> state = unloaded_state(p);
  // First only the initial crack is open, then the whole width is broken.
  for (int broken = 0; broken < 2; ++broken) {
    const Voigt<2> strain = -1e-4 * Voigt<2>::Unit(1);
    ASSERT_EQ(equilibrate(p, strain, Eigen::VectorXd(state.opening), state).outcome,
              NewtonReport::Outcome::converged);
    EXPECT_NEAR(homogenize(p, state).stress[1], -1e-4 * oedometric, 1e-8 * ft);
    for (Eigen::Index i = 0; i < state.opening.size(); i += 2) {
      EXPECT_EQ(state.opening[i], 0) << "the normal opening must be zero in contact";
      EXPECT_NEAR(state.opening[i + 1], 0, 1e-9 * law.final_opening())
          << "the tangential opening must be zero without a driving stress";
    }
    std::fill(state.largest.begin(), state.largest.end(), 2 * law.final_opening());
  }
}

// The closed form of a collinear periodic array of cracks in an infinite body is delta / sigma = -(8 b / (pi
// E')) ln cos(pi a / (2 b)), b = l / 2, a = a0 (Tada, Paris, Irwin): a damage of 0.128 here. The cell is also
// periodic vertically, which shields the cracks a little.
TEST(InitialDamage, ApproachesTheClosedFormUnderRefinement) {
  const double plane = 1 / (1 - nu * nu), M = oedometric / E;
  const double delta = -(4 / (std::numbers::pi * plane)) * std::log(std::cos(std::numbers::pi * ratio / 2));
  const double closed_form = 1 - 1 / (1 + M * delta);
  double last = 0;
  std::vector<double> values;
  for (const int elements : {2, 4, 8}) {
    values.push_back(
        initial_damage(problem(condense({.crack_ratio = ratio}, {.elements = elements}, nu), 0.016)));
    EXPECT_GT(values.back(), last) << "a finer mesh must be softer";
    last = values.back();
  }
  EXPECT_NEAR(values[2], closed_form, 0.002);
  EXPECT_LT(values[2] - values[1], 0.5 * (values[1] - values[0]));
}

TEST(InitialDamage, IsThatOfTheFirstLoadedRow) {
  const DamageCurve curve = trace(default_cell(), 0.016, {.growth = 0.001, .final_strain = 0.05});
  EXPECT_NEAR(curve.damage[1], curve.damage[0], 1e-9);
}

// In monotonic tension the work depends on the cell size through the cracks alone: dW / d ln l = psi_cohesive
// - dissipation at constant strain, before and after the peak.
TEST(SizeLaw, DerivativeOfTheWorkIsCohesiveEnergyMinusDissipation) {
  const double size = 0.016, change = 1.01;
  const SteppingSettings fine{.growth = 0.002, .final_strain = 0.5};
  const DamageCurve here = trace(default_cell(), size, fine),
                    larger = trace(default_cell(), change * size, fine);
  for (std::size_t i = 50; i < here.strain.size(); i += 50) {
    const double strain = here.strain[i];
    if (strain > larger.strain.back()) break;
    const double both = 0.5 * (here.psi_cohesive[i] - here.dissipation[i] +
                               interpolate(larger.strain, larger.psi_cohesive, strain) -
                               interpolate(larger.strain, larger.dissipation, strain));
    EXPECT_NEAR((interpolate(larger.strain, larger.work, strain) - here.work[i]) / std::log(change), both,
                0.002 * here.work[i]);
  }
}

// A table of one size gives the damage of cells computed directly at other sizes, for both damage variables.
TEST(SizeLaw, TableOfOneSizeGivesTheOthers) {
  struct Case {
    Softening softening;
    double stiffness, strength; // largest error of the damage
  };
  for (const auto& [softening, stiffness, strength] :
       {Case{Softening::linear, 0.0015, 0.0015}, Case{Softening::exponential, 0.002, 0.004},
        Case{Softening::bilinear, 0.002, 0.004}}) {
    const auto softens = make_cohesive_law(softening, ft, Gf);
    const auto compute = [&](double size) {
      InterfaceProblem<2> p{.cell = default_cell(), .law = *softens, .youngs_modulus = E, .cell_size = size};
      return trace_curve(p, {}, [](const DamageCurve&) { return true; }).curve;
    };
    DamageTable table;
    table.youngs_modulus = E;
    table.poisson_ratio = nu;
    table.curves = {compute(0.015875)};
    for (const double size : {0.005, 0.010, 0.015875, 0.020, 0.040}) {
      const DamageCurve direct = compute(size);
      const DamageLaw secant(table, size, DamageDefinition::stiffness),
          weakening(table, size, DamageDefinition::strength);
      for (std::size_t i = 0; i < direct.strain.size(); ++i) { // row by row: a maximum would skip NaN
        ASSERT_LT(std::abs(secant(direct.strain[i]) - direct.damage[i]), size == 0.015875 ? 1e-9 : stiffness)
            << size;
        ASSERT_LT(std::abs(weakening(direct.strain[i]) - direct.damage_strength[i]),
                  size == 0.015875 ? 1e-9 : strength)
            << size;
      }
    }
  }
}

TEST(MeshRefinement, ConvergesToTheSameCurve) {
  const auto values = [](int elements) {
    const DamageCurve c =
        trace(condense({.crack_ratio = ratio}, {.elements = elements}, nu), 0.016, {.growth = 0.005});
    return std::array<double, 4>{*std::max_element(c.stress.begin(), c.stress.end()) / 2.24e6,
                                 interpolate(c.strain, c.damage, 1e-4), interpolate(c.strain, c.damage, 2e-4),
                                 interpolate(c.strain, c.damage, 1e-3)};
  };
  const auto coarse = values(2), normal = values(4), fine = values(8);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(normal[i], fine[i], 2e-4);
    EXPECT_NEAR(coarse[i], fine[i], 1e-3);
  }
}

TEST(Uncracked, WithoutACrackTheWholeWidthFailsAtTheStrength) {
  const CondensedCell<2> cell = condense({.crack_ratio = 0}, {}, nu);
  EXPECT_EQ(initial_damage(problem(cell, 0.016)), 0);
  const DamageCurve curve = trace(cell, 0.016);
  EXPECT_NEAR(*std::max_element(curve.stress.begin(), curve.stress.end()), ft, 0.001 * ft);
  EXPECT_NEAR(curve.work.back(), Gf / 0.016, 0.002 * Gf / 0.016);
}

} // namespace
