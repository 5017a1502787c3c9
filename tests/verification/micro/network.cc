// Tests of crossing cracks: results that do not depend on the crossing are those of cells without one.

#include "micro/cohesive/linear_softening.h"
#include "micro/equilibrium/condense.h"
#include "micro/loading/curve_tracing.h"
#include "micro/loading/macro_load.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace spall;

constexpr double E = 18727e6, nu = 0.3585, ft = 3e6, Gf = 80, size = 0.016;
const double M = (1 - nu) / ((1 + nu) * (1 - 2 * nu)); // over E
const LinearSoftening law(ft, Gf);

using Cell = decltype(condense({.crack_ratio = 0}, {}, nu));
auto problem(const Cell& cell, const Voigt<2>& direction = Voigt<2>::Unit(1)) {
  return InterfaceProblem<2>{
      .cell = cell, .law = law, .youngs_modulus = E, .cell_size = size, .direction = direction};
}
auto trace(const Cell& cell, const Voigt<2>& direction = Voigt<2>::Unit(1)) {
  const auto result = trace_curve(problem(cell, direction), {}, [](const auto&) { return true; });
  EXPECT_TRUE(result.complete()) << result.failure;
  return result;
}
double peak(const DamageCurve& curve) { return *std::max_element(curve.stress.begin(), curve.stress.end()); }

const Cell& crossing() {
  static const Cell cell = condense({.crack_ratio = 0, .vertical = {.count = 1}}, {.degree = 2}, nu);
  return cell;
}

TEST(Crossing, IntactLigamentsHaveNoEffect) {
  const auto p = problem(crossing());
  const Voigt<2> strain = 0.3 * ft / (M * E) * Voigt<2>(1, 0.5, 0.4);
  auto state = unloaded_state(p);
  ASSERT_EQ(equilibrate(p, strain, state.opening, state).outcome, NewtonReport::Outcome::converged);
  EXPECT_EQ(state.opening.norm(), 0);
  const Voigt<2> stress = homogenize(p, state).stress / E;
  EXPECT_NEAR(stress[0], M * strain[0] + nu / ((1 + nu) * (1 - 2 * nu)) * strain[1], 1e-12 * M * strain[0]);
  EXPECT_NEAR(stress[2], 0.5 / (1 + nu) * strain[2], 1e-12 * strain[0]);
}

// Two open cracks through the cell separate four blocks, which transmit pressure only.
TEST(Crossing, FourBlocksFallApartAndCarryPressure) {
  const auto p = problem(crossing());
  for (const Voigt<2>& direction : {Voigt<2>(0, 1, 0), Voigt<2>(1, 0.3, 0), Voigt<2>(1, 1, 0.2)}) {
    auto state = unloaded_state(p);
    std::fill(state.largest.begin(), state.largest.end(), 2 * law.final_opening());
    ASSERT_EQ(equilibrate(p, 1e-4 * direction, state.opening, state).outcome,
              NewtonReport::Outcome::converged);
    EXPECT_LE(homogenize(p, state).stress.norm(), 1e-7 * E * M * 1e-4) << direction.transpose();
  }
  for (const Voigt<2>& direction : {Voigt<2>(0, -1, 0), Voigt<2>(-1, -0.3, 0)}) {
    auto state = unloaded_state(p);
    std::fill(state.largest.begin(), state.largest.end(), 2 * law.final_opening());
    ASSERT_EQ(equilibrate(p, 1e-4 * direction, state.opening, state).outcome,
              NewtonReport::Outcome::converged);
    // The dependent interface at the crossing does not transmit the pressure; it is one node of many.
    EXPECT_LE((homogenize(p, state).stress - 1e-4 * E * (crossing().uncracked * direction)).norm(),
              1e-4 * E * 1e-4)
        << direction.transpose();
  }
}

// In uniaxial tension a crack along the axis has hardly any effect, and the cross has the same stiffness
// along both axes.
TEST(Crossing, ACrossIsWeakenedByTheCrackAcrossThePull) {
  const MeshDensity mesh{.elements = 4, .grading = 3, .degree = 3};
  const Cell alone = condense({.crack_ratio = 0.3}, mesh, nu);
  const Cell cross = condense({.crack_ratio = 0.3, .vertical = {.count = 1, .crack_ratio = 0.3}}, mesh, nu);
  const auto damage = [](const Cell& cell, bool pull_up) {
    const Cell released = release(cell, {pull_up, !pull_up, true});
    return initial_damage(problem(released, Voigt<2>::Unit(pull_up ? 1 : 0)));
  };
  EXPECT_NEAR(damage(cross, true), damage(cross, false), 1e-3 * damage(cross, true));
  EXPECT_NEAR(damage(cross, true), damage(alone, true), 0.02 * damage(alone, true));
  EXPECT_NEAR(damage(alone, false), 0, 1e-9);
}

// In uniaxial tension the horizontal crack grows through the cell and the vertical ligament stays intact; in
// biaxial tension both cracks grow through. The areas of dependent interfaces at the crossing are not lost,
// and the mesh has little effect.
TEST(Crossing, WorkOfSeparationIsThatOfTheLigamentsBroken) {
  double up_before = 0, both_before = 0;
  for (const int elements : {2, 4}) {
    const Cell cell = condense({.crack_ratio = 0.25, .vertical = {.count = 1}},
                               {.elements = elements, .grading = 2, .degree = 2}, nu);
    const DamageCurve up = trace(cell).curve, both = trace(cell, {1, 1, 0}).curve;
    EXPECT_NEAR(up.dissipation.back(), 0.75 * Gf / size, 1e-6 * Gf / size);
    EXPECT_NEAR(both.dissipation.back(), 1.75 * Gf / size, 1e-6 * Gf / size);
    EXPECT_LE(check_energies(up).work, 5e-5);
    EXPECT_LE(check_energies(both).work, 5e-5);
    EXPECT_LE(check_energies(both).stress, 1e-8);
    EXPECT_NEAR(both.damage.back(), 1, 1e-9);
    if (elements > 2) {
      EXPECT_NEAR(peak(up), up_before, 2e-3 * ft);
      EXPECT_NEAR(peak(both), both_before, 2e-3 * ft);
    }
    up_before = peak(up);
    both_before = peak(both);
  }
}

} // namespace
