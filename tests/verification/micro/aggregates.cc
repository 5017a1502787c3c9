// Tests of cells with aggregates in mortar and a weak interface zone.

#include "micro/cell/aggregate_mesh.h"
#include "micro/cell/power_diagram.h"
#include "micro/cohesive/linear_softening.h"
#include "micro/homogenization/effective_constants.h"
#include "micro/loading/curve_tracing.h"
#include "micro/solid.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace spall;

constexpr double E = 18727e6, nu = 0.3585, ft = 3e6, Gf = 80, size = 0.02;
const LinearSoftening law(ft, Gf), zone(0.5 * ft, 0.5 * Gf);
const Grading grading{.fraction = 0.4, .smallest = 3e-3, .largest = 9.5e-3};
const std::vector<Isotropic> stiff = {Isotropic(0.2, 0.7), Isotropic(0.2, 2.0)};

CellComplex<2> complex_of(int seed, MortarCracks cracks = MortarCracks::corners_and_flats) {
  return cell_complex(place_aggregates(aggregate_diameters(grading, size), seed), cracks);
}
VoigtMatrix<2> uniform_stiffness(const Isotropic& phase) {
  VoigtMatrix<2> C;
  const double along = phase.lambda + 2 * phase.mu;
  C << along, phase.lambda, 0, phase.lambda, along, 0, 0, 0, phase.mu;
  return C;
}

TEST(Grading, HasTheGivenAreaAndSieveCurve) {
  for (const double l : {0.016, 0.032, 0.1}) {
    std::vector<double> d = aggregate_diameters(grading, l);
    double area = 0;
    for (const double x : d) area += 0.25 * std::numbers::pi * x * x;
    EXPECT_NEAR(area, grading.fraction, 1e-12);
    EXPECT_TRUE(std::is_sorted(d.rbegin(), d.rend()));
    // The share that passes a sieve differs from Fuller's curve by at most the aggregate of that size.
    const auto passes = [](double x) {
      return (std::sqrt(x) - std::sqrt(3e-3)) / (std::sqrt(9.5e-3) - std::sqrt(3e-3));
    };
    for (const double sieve : {4e-3, 5e-3, 6e-3, 8e-3}) {
      double passing = 0, across = 0;
      for (const double x : d) (x * l < sieve ? passing : across) += 0.25 * std::numbers::pi * x * x / area;
      double largest = 0;
      for (const double x : d) largest = std::max(largest, 0.25 * std::numbers::pi * x * x / area);
      EXPECT_NEAR(passing, passes(sieve), largest) << l << " " << sieve;
    }
  }
}

TEST(PowerDiagram, CellsHaveTheGivenAreasAndFillThePeriod) {
  const std::vector<Eigen::Vector2d> sites = {{0.1, 0.2}, {0.15, 0.25}, {0.8, 0.7}, {0.4, 0.9}};
  const std::vector<double> areas = {0.5, 0.1, 0.15, 0.25};
  const auto cells = power_diagram(sites, weights_for_areas(sites, areas));
  double total = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_NEAR(area(cells[i].corners), areas[i], 1e-9);
    total += area(cells[i].corners);
  }
  EXPECT_NEAR(total, 1, 1e-12);
}

TEST(Aggregates, SeedDeterminesTheCellAndTheFractionIsTheGivenOne) {
  const std::vector<double> d = aggregate_diameters(grading, size);
  for (int seed = 1; seed <= 30; ++seed) {
    const auto one = place_aggregates(d, seed), again = place_aggregates(d, seed),
               other = place_aggregates(d, seed + 1);
    EXPECT_EQ(one.front().centre, again.front().centre);
    EXPECT_NE(one.front().centre, other.front().centre);
    double whole = 0, inside = 0;
    for (std::size_t i = 0; i < d.size(); ++i) {
      const double cell = area(one[i].corners);
      whole += cell;
      inside += one[i].scale * one[i].scale * cell;
      EXPECT_NEAR(one[i].scale * one[i].scale * cell, 0.25 * std::numbers::pi * d[i] * d[i], 1e-12);
      EXPECT_LT(one[i].scale, 0.96);
    }
    EXPECT_NEAR(whole, 1, 1e-9);
    EXPECT_NEAR(inside, grading.fraction, 1e-9);
    // Elements have positive orientation, and the border matches its periodic image.
    const CellComplex<2> complex = cell_complex(one, MortarCracks::corners_and_flats);
    for (const auto& q : complex.cells) {
      const std::array<unsigned int, 4> round = {q[0], q[1], q[3], q[2]};
      for (int k = 0; k < 4; ++k) {
        const auto a = complex.vertices[round[(k + 1) % 4]] - complex.vertices[round[k]],
                   b = complex.vertices[round[(k + 2) % 4]] - complex.vertices[round[(k + 1) % 4]];
        EXPECT_GT(a[0] * b[1] - a[1] * b[0], 0) << seed;
      }
    }
    dealii::Triangulation<2> mesh;
    EXPECT_NO_THROW(make_split_mesh(complex, 0, mesh));
  }
}

// If aggregates and mortar have the same elasticity and nothing opens, the cell is uniform.
TEST(Aggregates, UniformConstantsGiveTheUniformCell) {
  const Isotropic phase(nu);
  for (int seed = 1; seed <= 3; ++seed) {
    const Bulk<2> bulk(complex_of(seed), 1, 0, {phase, phase});
    EXPECT_LE((bulk.condensed().uncracked - uniform_stiffness(phase)).norm(), 1e-12);
    // Well below the strength nothing opens (where cracks meet, some nodes have a multiple of the mean
    // stress).
    const InterfaceProblem<2> p{.cell = bulk.condensed(), .law = law, .youngs_modulus = E, .cell_size = size};
    CellState<2> state = unloaded_state(p);
    const Voigt<2> strain = 0.05 * ft / E * Voigt<2>(0.2, 1, 0.3);
    ASSERT_EQ(equilibrate(p, strain, state.opening, state).outcome, NewtonReport::Outcome::converged);
    EXPECT_EQ(state.opening.norm(), 0);
  }
}

TEST(Aggregates, EffectiveStiffnessLiesWithinTheBounds) {
  const double f = grading.fraction;
  const VoigtMatrix<2> soft = uniform_stiffness(stiff[0]), hard = uniform_stiffness(stiff[1]);
  const VoigtMatrix<2> voigt = (1 - f) * soft + f * hard,
                       reuss = ((1 - f) * soft.inverse() + f * hard.inverse()).inverse();
  // The bounds are those of Hashin and Shtrikman in the plane for the plane bulk modulus and the shear
  // modulus.
  const auto bulk_modulus = [](const Isotropic& p) { return p.lambda + p.mu; };
  const auto mix = [f](double matrix, double inclusion, double around) {
    return 1 / ((1 - f) / (matrix + around) + f / (inclusion + around)) - around;
  };
  const double K0 = bulk_modulus(stiff[0]), K1 = bulk_modulus(stiff[1]), G0 = stiff[0].mu, G1 = stiff[1].mu;
  const auto shear_around = [](double K, double G) { return G * K / (K + 2 * G); };
  for (int seed = 1; seed <= 5; ++seed) {
    const Bulk<2> bulk(complex_of(seed), 2, 0, stiff);
    const VoigtMatrix<2>& C = bulk.condensed().uncracked;
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<VoigtMatrix<2>>(voigt - C).eigenvalues().minCoeff(), 0);
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<VoigtMatrix<2>>(C - reuss).eigenvalues().minCoeff(), 0);
    const EffectiveConstants whole = effective_constants(C);
    const Isotropic mean(whole.poisson_ratio, whole.youngs_modulus);
    EXPECT_GE(bulk_modulus(mean), mix(K0, K1, G0));
    EXPECT_LE(bulk_modulus(mean), mix(K0, K1, G1));
    EXPECT_GE(mean.mu, mix(G0, G1, shear_around(K0, G0)));
    EXPECT_LE(mean.mu, mix(G0, G1, shear_around(K1, G1)));
    EXPECT_LE(whole.anisotropy, 0.05);
  }
}

TEST(Aggregates, ScaledPhasesHaveTheGivenConstants) {
  const CellComplex<2> complex = complex_of(1);
  const auto phases = scaled_phases(complex, 1, 0, stiff, nu);
  const EffectiveConstants whole = effective_constants(Bulk<2>(complex, 1, 0, phases).condensed().uncracked);
  EXPECT_NEAR(whole.youngs_modulus, 1, 1e-8);
  EXPECT_NEAR(whole.poisson_ratio, nu, 1e-8);
  EXPECT_NEAR(phases[1].mu / phases[0].mu, stiff[1].mu / stiff[0].mu, 1e-9);
}

// Compares psi computed in three ways and over the mesh, the work of separation, and the crack path.
TEST(Aggregates, CracksFollowTheWeakZone) {
  const int seed = 2;
  const CellComplex<2> complex = complex_of(seed);
  const std::size_t particles = aggregate_diameters(grading, size).size();
  const Bulk<2> bulk(complex, 1, 0, scaled_phases(complex, 1, 0, stiff, nu));
  double in_zone[2] = {0, 0};
  for (const bool weak : {false, true}) {
    InterfaceProblem<2> p{.cell = bulk.condensed(), .law = law, .youngs_modulus = E, .cell_size = size};
    p.line_laws.assign(particles, weak ? &zone : &law);
    p.line_laws.resize(2 * particles, &law);
    const CurveTrace<2> t = trace_curve(p, {.final_strain = 1.5}, [](const DamageCurve&) { return true; });
    ASSERT_TRUE(t.complete()) << weak << " " << t.failure;
    const DamageCurve& curve = t.curve;
    EXPECT_GE(curve.damage.back(), 0.99);
    // The work is at least that of the shortest crack, and not much more than that of the stronger law on a
    // longer path.
    EXPECT_GE(curve.work.back(), (weak ? 0.5 : 1) * Gf / size);
    EXPECT_LE(curve.work.back(), 2 * Gf / size);
    const EnergyChecks checks = check_energies(curve);
    EXPECT_LE(checks.stress, 1e-8);
    EXPECT_LE(checks.work, 1e-3);
    double broken = 0, all = 0;
    for (std::size_t i = 0; i < p.cell.nodes.size(); ++i) {
      const double energy = p.cell.nodes[i].weight * p.law_at(i).dissipation(t.states.back().largest[i]);
      const double length = energy / p.law_at(i).dissipation(p.law_at(i).final_opening());
      all += length;
      if (p.cell.nodes[i].line < static_cast<int>(particles)) broken += length;
    }
    in_zone[weak] = broken / all;
    // The energy integrated over the mesh equals that of the condensed form.
    const CellState<2>& state = t.states[t.states.size() / 2];
    const auto u = bulk.displacement(state.opening / size, state.strain);
    EXPECT_NEAR(E * bulk.elastic_energy(u), homogenize(p, state).psi_bulk,
                1e-8 * E * state.strain.squaredNorm());
  }
  EXPECT_GT(in_zone[1], in_zone[0] + 0.05);
  EXPECT_GT(in_zone[1], 0.55);
}

} // namespace
