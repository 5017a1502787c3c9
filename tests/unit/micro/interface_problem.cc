// Tests on a cell with a closed-form solution: one node pair for the whole width. The stress is uniform, and
// eps = sigma / M + w / l with sigma = f_t (1 - w / w_f).

#include "micro/cohesive/linear_softening.h"
#include "micro/loading/curve_tracing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace spall;

constexpr double E = 18727e6, M = 1.7, S = 0.36; // moduli of uniaxial strain and shear over E
constexpr double ft = 3e6, Gf = 80;

/// Makes a uniform bar with the energy E M (eps - w / l)^2 / 2 per volume, and the same for shear.
CondensedCell<2> bar() {
  CondensedCell<2> cell;
  cell.stiffness = Eigen::Vector2d(M, S).asDiagonal();
  cell.coupling = Eigen::MatrixXd::Zero(2, 3);
  cell.coupling(0, 1) = M;
  cell.coupling(1, 2) = S;
  cell.uncracked = Eigen::Vector3d(M, M, S).asDiagonal();
  cell.nodes = {{.position = {0.5, 0.5}, .weight = 1}};
  return cell;
}

struct Bar : testing::Test {
  const CondensedCell<2> cell = bar();
  const LinearSoftening law{ft, Gf};
  const double wf = law.final_opening();
  InterfaceProblem<2> problem(double size) const {
    return {.cell = cell, .law = law, .youngs_modulus = E, .cell_size = size};
  }
  static void solve(const InterfaceProblem<2>& p, const Voigt<2>& strain, CellState<2>& state) {
    const NewtonReport report = equilibrate(p, strain, Eigen::VectorXd(state.opening), state);
    ASSERT_EQ(report.outcome, NewtonReport::Outcome::converged) << describe(report);
  }
};

const Voigt<2> pull = Voigt<2>::Unit(1), shear = Voigt<2>::Unit(2);

TEST_F(Bar, FollowsTheClosedForm) {
  const InterfaceProblem<2> p = problem(0.016);
  const CurveTrace<2> trace = trace_curve(p, {}, [](const DamageCurve&) { return true; });
  ASSERT_TRUE(trace.complete()) << trace.failure;
  const DamageCurve& c = trace.curve;
  for (std::size_t i = 1; i < c.strain.size(); ++i) {
    // The closed form is the series connection of bar and crack.
    const double intact = E * M * c.strain[i], stiff = ft / wf * p.cell_size / (E * M);
    const double expected = intact <= ft ? intact
                            : c.strain[i] * p.cell_size >= wf
                                ? 0
                                : (ft - ft / wf * p.cell_size * c.strain[i]) / (1 - stiff);
    EXPECT_NEAR(c.stress[i], expected, 1e-8 * ft);
    EXPECT_NEAR(c.damage[i], 1 - expected / intact, 1e-8);
    EXPECT_NEAR(c.damage_strength[i], intact <= ft ? 0 : 1 - expected / ft, 0.011);
  }
  EXPECT_NEAR(c.work.back(), Gf / p.cell_size, 1e-3 * Gf / p.cell_size);
  EXPECT_NEAR(c.dissipation.back(), Gf / p.cell_size, 1e-9 * Gf / p.cell_size);
}

TEST_F(Bar, RowsIncludeTotalFailureAndGrowGeometrically) {
  const InterfaceProblem<2> p = problem(0.016);
  const CurveTrace<2> trace =
      trace_curve(p, {.growth = 0.05, .final_strain = 1.3}, [](const DamageCurve&) { return true; });
  const auto& strain = trace.curve.strain;
  const auto failed = std::find(strain.begin(), strain.end(), wf / p.cell_size);
  ASSERT_NE(failed, strain.end());
  EXPECT_NEAR(trace.curve.stress[failed - strain.begin()], 0, 1e-8 * ft);
  EXPECT_GT(trace.curve.stress[failed - strain.begin() - 1], 1e-3 * ft);
  EXPECT_NEAR(strain.back(), 1.3 * wf / p.cell_size, 1e-15);
  for (std::size_t i = 2; i < strain.size(); ++i)
    EXPECT_LE(strain[i] - strain[i - 1], 1.1 * 0.05 * std::max(strain[i - 1], ft / (E * M)));
  EXPECT_EQ(trace.states.size(), strain.size());
}

TEST_F(Bar, UnloadsAlongTheSecantAndReloadsOnIt) {
  const InterfaceProblem<2> p = problem(0.016);
  CellState<2> state = unloaded_state(p);
  solve(p, 1e-3 * pull, state);
  const HomogenizedState<2> peak = homogenize(p, state);
  for (const double fraction : {0.7, 0.3, 0.9, 1.0}) {
    solve(p, fraction * 1e-3 * pull, state);
    const HomogenizedState<2> now = homogenize(p, state);
    EXPECT_NEAR(now.stress[1], fraction * peak.stress[1], 1e-8 * ft);
    EXPECT_DOUBLE_EQ(now.dissipation, peak.dissipation);
  }
}

TEST_F(Bar, AClosedCrackIsIntactUnderCompressionEvenWhenBroken) {
  const InterfaceProblem<2> p = problem(0.016);
  CellState<2> state = unloaded_state(p);
  solve(p, 2 * wf / p.cell_size * pull, state);
  EXPECT_NEAR(homogenize(p, state).stress[1], 0, 1e-8 * ft);
  solve(p, -1e-4 * pull, state);
  EXPECT_NEAR(homogenize(p, state).stress[1], -1e-4 * E * M, 1e-8 * ft);
  EXPECT_EQ(state.opening[0], 0);
}

TEST_F(Bar, ShearSoftensLikeTension) {
  const InterfaceProblem<2> p = problem(0.016);
  CellState<2> state = unloaded_state(p);
  const double stress = 0.4 * ft, opening = wf * (1 - stress / ft);
  solve(p, (stress / (E * S) + opening / p.cell_size) * shear, state);
  EXPECT_NEAR(state.opening[1], opening, 1e-8 * wf);
  EXPECT_NEAR(homogenize(p, state).stress[2], stress, 1e-8 * ft);
}

TEST_F(Bar, SnapBackIsRefusedOnRequestAndKeepsTheCurve) {
  const SteppingSettings refuse{.snap_back = AtInstability::refuse};
  const double limit = E * M * wf / ft; // larger cells snap back
  const CurveTrace<2> small =
      trace_curve(problem(0.8 * limit), refuse, [](const DamageCurve&) { return true; });
  EXPECT_TRUE(small.complete()) << small.failure;
  const CurveTrace<2> large =
      trace_curve(problem(1.2 * limit), refuse, [](const DamageCurve&) { return true; });
  EXPECT_FALSE(large.complete());
  EXPECT_NE(large.failure.find("snaps back"), std::string::npos) << large.failure;
  EXPECT_NEAR(large.curve.strain.back(), ft / (E * M), 1e-3 * ft / (E * M));
  EXPECT_EQ(large.curve.damage_strength.size(), large.curve.strain.size());
}

// Every row of the softening branch satisfies eps = sigma / M + w / l with the stress at the largest opening.
TEST_F(Bar, SnapBackIsFollowedOnTheExactPathAtItsExactWork) {
  const double size = 3 * E * M * wf / ft;
  const CurveTrace<2> trace = trace_curve(problem(size), {}, [](const DamageCurve&) { return true; });
  ASSERT_TRUE(trace.complete()) << trace.failure;
  ASSERT_EQ(trace.events.size(), 1U);
  EXPECT_EQ(trace.events[0].kind, CurveEvent::Kind::snap_back);
  EXPECT_NEAR(trace.events[0].from, ft / (E * M), 0.02 * ft / (E * M));
  const DamageCurve& c = trace.curve;
  for (std::size_t i = 0; i < c.strain.size(); ++i) {
    const double w = c.opening[i], stress = w == 0 ? c.strain[i] * E * M : std::max(0.0, ft * (1 - w / wf));
    EXPECT_NEAR(c.stress[i], stress, 1e-7 * ft);
    EXPECT_NEAR(c.strain[i], stress / (E * M) + w / size, 1e-7 * ft / (E * M));
  }
  EXPECT_NEAR(c.work.back(), Gf / size, 1e-3 * Gf / size);
  // On the softening branch the tangent at given strain has one negative eigenvalue.
  int unstable = 0;
  for (const RowReport& row : trace.reports) {
    EXPECT_LE(row.stability.negative, 1);
    if (row.stability.negative == 1) {
      EXPECT_EQ(row.control, Control::damage);
    }
    unstable += row.stability.negative;
  }
  EXPECT_GT(unstable, 10);
}

TEST_F(Bar, EnvelopeOfASnapBackDropsAtItsStrain) {
  const double size = 1.5 * E * M * wf / ft, peak = ft / (E * M), failure = wf / size;
  ASSERT_LT(failure, peak);
  const CurveTrace<2> trace = trace_curve(problem(size), {}, [](const DamageCurve&) { return true; });
  ASSERT_TRUE(trace.complete()) << trace.failure;
  const DamageCurve table = envelope(trace.curve);
  for (std::size_t i = 1; i < table.strain.size(); ++i) {
    EXPECT_GT(table.strain[i], table.strain[i - 1]);
    EXPECT_GE(table.damage[i], table.damage[i - 1]);
    EXPECT_NEAR(table.damage[i], table.strain[i] <= table.strain[1] ? 0 : table.damage_strength[i], 1e-7);
  }
  EXPECT_LT(table.strain.size(), trace.curve.strain.size());
  const auto broken =
      std::find_if(table.damage.begin(), table.damage.end(), [](double d) { return d > 0.99; });
  EXPECT_NEAR(table.strain[broken - table.damage.begin()], peak, 0.03 * peak);
}

TEST_F(Bar, ALoadingProgramReturnsToTheVirginCurve) {
  const InterfaceProblem<2> p = problem(0.016);
  const CurveTrace<2> there_and_back =
      trace_curve(p, {.turning_strains = {1e-3, 2e-4, 9e-4, 0}}, [](const DamageCurve&) { return true; });
  ASSERT_TRUE(there_and_back.complete()) << there_and_back.failure;
  const CurveTrace<2> straight = trace_curve(p, {}, [](const DamageCurve&) { return true; });
  EXPECT_NEAR(there_and_back.curve.work.back(), straight.curve.work.back(),
              1e-3 * straight.curve.work.back());
  double largest = 0;
  for (std::size_t i = 1; i < there_and_back.states.size(); ++i) {
    const DamageCurve& c = there_and_back.curve;
    largest = std::max(largest, c.strain[i]);
    if (c.strain[i] < largest) {
      EXPECT_EQ(c.dissipation[i], c.dissipation[i - 1]);
      EXPECT_NEAR(c.stress[i] * 1e-3,
                  c.strain[i] * (ft - ft / wf * 0.016 * 1e-3) / (1 - ft / wf * 0.016 / (E * M)),
                  1e-7 * ft * 1e-3);
    }
  }
  const DamageCurve table = envelope(there_and_back.curve);
  for (std::size_t i = 1; i < table.strain.size(); ++i) EXPECT_GT(table.strain[i], table.strain[i - 1]);
}

TEST_F(Bar, StopsOnRequestAndKeepsTheRows) {
  const CurveTrace<2> trace =
      trace_curve(problem(0.016), {}, [](const DamageCurve& c) { return c.strain.size() < 10; });
  EXPECT_TRUE(trace.interrupted);
  EXPECT_EQ(trace.curve.strain.size(), 10U);
}

TEST_F(Bar, FailedNewtonLeavesTheStateUntouched) {
  InterfaceProblem<2> p = problem(0.016);
  p.newton.max_iterations = 0;
  CellState<2> state = unloaded_state(p);
  const NewtonReport report = equilibrate(p, 1e-3 * pull, Eigen::Vector2d::Zero(), state);
  EXPECT_EQ(report.outcome, NewtonReport::Outcome::not_converged);
  EXPECT_GT(report.traction_error, 0);
  EXPECT_EQ(state.strain, Voigt<2>::Zero());
  EXPECT_EQ(state.largest[0], 0);
}

// Node A slides under pressure and open node B changes the pressure: T = [[1, mu S_AB], [0, 1]]. Its
// eigenvalues are 1, but its symmetric part has the eigenvalue 1 - mu |S_AB| / 2 < 0: no disturbance grows,
// although the sufficient criterion fails.
TEST(StabilityWithFriction, SymmetricPartMayBeIndefiniteWhereNothingGrows) {
  CondensedCell<2> cell;
  cell.stiffness = Eigen::Vector4d(100, 1, 1, 1).asDiagonal();
  cell.stiffness(0, 2) = cell.stiffness(2, 0) = -5;
  cell.coupling = Eigen::MatrixXd::Zero(4, 3);
  cell.coupling(0, 0) = 100;
  cell.coupling(1, 2) = cell.coupling(2, 1) = 1;
  cell.uncracked = Eigen::Vector3d(1000, 10, 10).asDiagonal();
  cell.nodes.assign(2, {.weight = 0.5, .initially_open = true});
  const LinearSoftening law(ft, Gf);
  InterfaceProblem<2> p{.cell = cell, .law = law, .youngs_modulus = E, .cell_size = 0.016};
  p.mode.friction = 1;
  CellState<2> state = unloaded_state(p);
  const NewtonReport report = equilibrate(p, {-1e-4, 1e-4, 0.02}, Eigen::VectorXd(state.opening), state);
  ASSERT_EQ(report.outcome, NewtonReport::Outcome::converged) << describe(report);
  ASSERT_GT(state.opening[1], 0) << "it slides";
  const Stability s = stability(p, state);
  EXPECT_EQ(s.negative, 0);
  EXPECT_NEAR(s.lowest, (1 - 0.5 * 5) / 0.5, 1e-9); // relative to the area of each node, 1/2
}

/// Makes two equal bars side by side, each so long that it snaps back.
CondensedCell<2> two_bars() {
  CondensedCell<2> cell;
  cell.stiffness = Eigen::Vector4d(M / 2, S / 2, M / 2, S / 2).asDiagonal();
  cell.coupling = Eigen::MatrixXd::Zero(4, 3);
  cell.coupling(0, 1) = cell.coupling(2, 1) = M / 2;
  cell.coupling(1, 2) = cell.coupling(3, 2) = S / 2;
  cell.uncracked = Eigen::Vector3d(M, M, S).asDiagonal();
  cell.nodes.assign(2, {.weight = 0.5});
  return cell;
}

// If both bars soften there are two negative eigenvalues, and the determinant is positive.
TEST_F(Bar, TwoNegativeEigenvaluesAreUnstable) {
  const CondensedCell<2> pair = two_bars();
  const double size = 1.5 * E * M * wf / ft;
  for (const double friction : {0.0, 0.3}) {
    InterfaceProblem<2> p{.cell = pair, .law = law, .youngs_modulus = E, .cell_size = size};
    p.mode.friction = friction;
    CellState<2> state = unloaded_state(p);
    Eigen::VectorXd half = Eigen::VectorXd::Zero(4);
    half[0] = half[2] = 0.5 * wf;
    const double strain = 0.5 * ft / (E * M) + 0.5 * wf / size;
    EXPECT_EQ(equilibrate(p, strain * pull, half, state).outcome, NewtonReport::Outcome::unstable)
        << friction;
    CellState<2> guess = state;
    guess.opening = half;
    guess.strain = strain * pull;
    CellState<2> reached = guess;
    reached.largest.assign(2, 0.5 * wf);
    EXPECT_EQ(stability(p, reached).negative, 2) << friction;
  }
}

// While the strain decreases the bars could soften together; on the path of lower energy they break one after
// the other.
TEST_F(Bar, ABranchUnderDamageControlIsFollowedOrRefusedNeverIgnored) {
  const CondensedCell<2> pair = two_bars();
  const double size = 1.5 * E * M * wf / ft;
  const InterfaceProblem<2> p{.cell = pair, .law = law, .youngs_modulus = E, .cell_size = size};
  const CurveTrace<2> t = trace_curve(p, {}, [](const DamageCurve&) { return true; });
  ASSERT_TRUE(t.complete()) << t.failure;
  EXPECT_TRUE(std::any_of(t.events.begin(), t.events.end(), [](const CurveEvent& event) {
    return event.kind == CurveEvent::Kind::bifurcation;
  }));
  for (const RowReport& row : t.reports) EXPECT_LE(row.stability.negative, 1);
  EXPECT_NEAR(t.curve.work.back(), Gf / size, 2e-3 * Gf / size);
  bool one_broken = false;
  for (const CellState<2>& state : t.states)
    one_broken = one_broken || std::min(state.largest[0], state.largest[1]) == 0;
  EXPECT_TRUE(one_broken);

  const CurveTrace<2> refused =
      trace_curve(p, {.bifurcation = AtInstability::refuse}, [](const DamageCurve&) { return true; });
  EXPECT_FALSE(refused.complete());
  EXPECT_NE(refused.failure.find("branches"), std::string::npos) << refused.failure;
}

/// Makes the same bar in 3D, where shear on the crack is xy or yz.
CondensedCell<3> bar_in_3d() {
  CondensedCell<3> cell;
  cell.stiffness = Eigen::Vector3d(M, S, S).asDiagonal();
  cell.coupling = Eigen::MatrixXd::Zero(3, 6);
  cell.coupling(0, 1) = M;
  cell.coupling(1, 3) = cell.coupling(2, 4) = S;
  cell.uncracked.setZero();
  cell.uncracked.diagonal() << M, M, M, S, S, S;
  cell.nodes = {{.position = {0.5, 0.5}, .weight = 1}};
  return cell;
}

TEST_F(Bar, In3DHasTheSameCurveSnapBackIncluded) {
  const CondensedCell<3> solid = bar_in_3d();
  for (const double size : {0.016, 3 * E * M * wf / ft}) {
    const DamageCurve plane = trace_curve(problem(size), {}, [](const DamageCurve&) { return true; }).curve;
    const InterfaceProblem<3> p{.cell = solid, .law = law, .youngs_modulus = E, .cell_size = size};
    const CurveTrace<3> trace = trace_curve(p, {}, [](const DamageCurve&) { return true; });
    ASSERT_TRUE(trace.complete()) << trace.failure;
    ASSERT_EQ(trace.curve.strain.size(), plane.strain.size());
    for (std::size_t i = 0; i < plane.strain.size(); ++i) {
      EXPECT_NEAR(trace.curve.strain[i], plane.strain[i], 1e-9 * plane.strain.back());
      EXPECT_NEAR(trace.curve.stress[i], plane.stress[i], 1e-8 * ft);
    }
  }
}

// Shear softens in the same way in any direction; the other strains are free and have no stress.
TEST_F(Bar, In3DShearsAlikeInEveryDirection) {
  const CondensedCell<3> solid = bar_in_3d();
  const double stress = 0.4 * ft, opening = wf * (1 - stress / ft);
  for (double angle = 0; angle < 6; angle += 0.7) {
    const Voigt<3> along = std::cos(angle) * Voigt<3>::Unit(3) + std::sin(angle) * Voigt<3>::Unit(4);
    const InterfaceProblem<3> p{.cell = solid, .law = law, .youngs_modulus = E, .cell_size = 0.016};
    CellState<3> state = unloaded_state(p);
    const double strain = stress / (E * S) + opening / p.cell_size;
    ASSERT_EQ(equilibrate(p, strain * along, Eigen::VectorXd(state.opening), state).outcome,
              NewtonReport::Outcome::converged);
    EXPECT_NEAR(state.opening[1], std::cos(angle) * opening, 1e-8 * wf);
    EXPECT_NEAR(state.opening[2], std::sin(angle) * opening, 1e-8 * wf);
    EXPECT_LE((homogenize(p, state).stress - stress * along).norm(), 1e-8 * ft);
  }
}

// The bar is compressed, then sheared along a path with a corner: the traction is mu p against the present
// slip.
TEST_F(Bar, In3DFrictionFollowsTheDirectionOfSlip) {
  const CondensedCell<3> solid = bar_in_3d();
  InterfaceProblem<3> p{.cell = solid, .law = law, .youngs_modulus = E, .cell_size = 0.016};
  p.mode.friction = 0.5;
  CellState<3> state = unloaded_state(p);
  state.largest[0] = wf; // broken
  const double pressure = 1e-4 * E * M;
  Voigt<3> strain = -1e-4 * Voigt<3>::Unit(1);
  const auto go = [&](int component, double to) {
    for (int step = 0; step < 20; ++step) {
      strain[component] += (to - strain[component]) / (20 - step);
      ASSERT_EQ(equilibrate(p, strain, Eigen::VectorXd(state.opening), state).outcome,
                NewtonReport::Outcome::converged);
      const Voigt<3> stress = homogenize(p, state).stress;
      EXPECT_LE(std::hypot(stress[3], stress[4]), 0.5 * pressure * (1 + 1e-8));
    }
  };
  go(3, 1e-3);
  EXPECT_NEAR(homogenize(p, state).stress[3], 0.5 * pressure, 1e-6 * pressure);
  EXPECT_NEAR(homogenize(p, state).stress[4], 0, 1e-6 * pressure);
  go(4, 2e-2);
  const Voigt<3> stress = homogenize(p, state).stress;
  EXPECT_NEAR(stress[4], 0.5 * pressure, 1e-2 * pressure);
  EXPECT_LT(std::abs(stress[3]), 0.05 * pressure); // the friction of the first leg has rotated
  EXPECT_GT(state.friction_work, 0);
}

TEST(EnergyChecks, NoticeABrokenBalance) {
  DamageCurve curve;
  curve.strain = {0, 1e-4};
  curve.stress = {0, 2e6};
  curve.psi = {0, 100};
  curve.work = {0, 130};
  curve.dissipation = {0, 10};
  const EnergyChecks checks = check_energies(curve);
  EXPECT_NEAR(checks.stress, 0, 1e-12);
  EXPECT_NEAR(checks.work, 0.2, 1e-12);
}

// A row with NaN must be reported even if other rows are in balance.
TEST(EnergyChecks, ReportNaN) {
  DamageCurve curve;
  curve.strain = {0, 1e-4, 2e-4};
  curve.stress = {0, std::nan(""), 4e6};
  curve.psi = {0, 100, 400};
  curve.work = {0, 100, 400};
  curve.dissipation = {0, 0, 0};
  EnergyChecks checks = check_energies(curve);
  EXPECT_FALSE(checks.stress <= EnergyChecks::stress_tolerance);
  EXPECT_LE(checks.work, EnergyChecks::work_tolerance);
  DamageCurve bad;
  bad.psi_work_error = std::nan("");
  checks.include(bad);
  checks.include(DamageCurve{});
  EXPECT_FALSE(checks.work <= EnergyChecks::work_tolerance);
}

} // namespace
