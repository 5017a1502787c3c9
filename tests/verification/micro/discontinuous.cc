// Compares the discontinuous Galerkin method with continuous elements whose nodes are doubled on cracks only.

#include "micro/cohesive/linear_softening.h"
#include "micro/equilibrium/bulk.h"
#include "micro/loading/curve_tracing.h"
#include "shared/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace spall;

constexpr double E = 18727e6, nu = 0.3585, ft = 3e6, Gf = 80, ratio = 0.25, size = 0.016;
const double M = (1 - nu) / ((1 + nu) * (1 - 2 * nu)); // over E
const LinearSoftening law(ft, Gf);

Bulk<2> discontinuous(int elements, double penalty = Elements{}.penalty) {
  return {{.crack_ratio = ratio},
          {.elements = elements,
           .grading = 2,
           .degree = 2,
           .kind = ElementKind::discontinuous,
           .penalty = penalty},
          nu};
}
DamageCurve curve(const CondensedCell<2>& cell) {
  const InterfaceProblem<2> p{.cell = cell, .law = law, .youngs_modulus = E, .cell_size = size};
  const CurveTrace<2> result = trace_curve(p, {}, [](const DamageCurve&) { return true; });
  EXPECT_TRUE(result.complete()) << result.failure;
  return result.curve;
}
double damage_at(const DamageCurve& c, double strain) {
  const auto above = std::upper_bound(c.strain.begin(), c.strain.end(), strain) - c.strain.begin();
  const double share = (strain - c.strain[above - 1]) / (c.strain[above] - c.strain[above - 1]);
  return c.damage[above - 1] + share * (c.damage[above] - c.damage[above - 1]);
}

// Consistency: discontinuous elements are exact for the fields for which continuous ones are.
TEST(Discontinuous, ClosedCellIsUniform) {
  const Bulk<2> bulk = discontinuous(2);
  const CondensedCell<2>& cell = bulk.condensed();
  EXPECT_NEAR(cell.uncracked(1, 1), M, 1e-10);
  EXPECT_NEAR(cell.uncracked(2, 2), 0.5 / (1 + nu), 1e-10);
  EXPECT_NEAR(cell.uncracked(0, 2), 0, 1e-10);
  double ligament = 0;
  for (const CrackNode& node : cell.nodes)
    if (!node.initially_open) ligament += node.weight;
  EXPECT_NEAR(ligament, 1 - ratio, 1e-12);
}

TEST(Discontinuous, HasTheNumbersOfCaseA) {
  const DamageCurve c = curve(discontinuous(4).condensed());
  const auto peak = std::max_element(c.stress.begin(), c.stress.end());
  EXPECT_NEAR(*peak, 2.240e6, 0.003e6);
  EXPECT_NEAR(c.strain[peak - c.stress.begin()], 1.02e-4, 0.02 * 1.02e-4);
  EXPECT_NEAR(damage_at(c, 1e-4), 0.284, 0.005);
  EXPECT_NEAR(damage_at(c, 2e-4), 0.652, 0.005);
  EXPECT_NEAR(damage_at(c, 1e-3), 0.948, 0.005);
  const double expected = Gf * (1 - ratio) / size;
  EXPECT_NEAR(c.dissipation.back(), expected, 1e-9 * expected);
  EXPECT_NEAR(c.work.back(), expected, 0.002 * expected);
  EXPECT_LE(check_energies(c).stress, 1e-8);
}

TEST(Discontinuous, ConvergesToTheCurveOfContinuousElements) {
  const auto compare = [](int elements) {
    const Bulk<2> continuous({.crack_ratio = ratio}, {.elements = elements, .grading = 2, .degree = 2}, nu);
    return std::abs(curve(discontinuous(elements).condensed()).damage[0] -
                    curve(continuous.condensed()).damage[0]);
  };
  const double two = compare(2), eight = compare(8);
  EXPECT_LT(eight, 0.5 * two);
  EXPECT_LT(eight, 0.003);
}

// Ten times the penalty gives nearly the same curve; with far too small a penalty the stiffness is not
// positive definite and the case is refused.
TEST(Discontinuous, PenaltyMayBeLargeButNotSmall) {
  const DamageCurve usual = curve(discontinuous(3).condensed()),
                    large = curve(discontinuous(3, 10 * Elements{}.penalty).condensed());
  EXPECT_NEAR(usual.damage[0], large.damage[0], 0.005);
  EXPECT_NEAR(damage_at(usual, 2e-4), damage_at(large, 2e-4), 0.001);
  EXPECT_THROW(discontinuous(3, 0.1), ComputationError);
}

} // namespace
