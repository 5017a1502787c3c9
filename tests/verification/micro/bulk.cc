// Compares the bulk on its mesh with its condensed form and with closed forms.

#include "micro/equilibrium/bulk.h"

#include "micro/cell/node_pairs.h"
#include "micro/cohesive/linear_softening.h"
#include "micro/equilibrium/solid_stiffness.h"
#include "micro/homogenization/energies.h"
#include "micro/output/fields.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/mapping_q1.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace spall;

constexpr double nu = 0.3585;
const double M = (1 - nu) / ((1 + nu) * (1 - 2 * nu)), shear = 0.5 / (1 + nu),
             side = nu / ((1 + nu) * (1 - 2 * nu));

const Bulk<2>& bulk() {
  static const Bulk<2> instance({.crack_ratio = 0.25}, {}, nu);
  return instance;
}

// Periodic patch test: a closed crack line has no effect.
TEST(Bulk, ClosedCellIsUniform) {
  const CondensedCell<2>& cell = bulk().condensed();
  Eigen::Matrix3d elastic;
  elastic << M, side, 0, side, M, 0, 0, 0, shear;
  EXPECT_LE((cell.uncracked - elastic).norm(), 1e-12);
  const Voigt<2> strain(1e-4, -2e-4, 3e-4);
  const Eigen::VectorXd closed = Eigen::VectorXd::Zero(cell.stiffness.rows());
  const auto u = bulk().displacement(closed, strain);
  EXPECT_LE((bulk().average_stress(u) - elastic * strain).norm(), 1e-12 * strain.norm());
  // In a uniform cell the energy follows from the average strain.
  EXPECT_NEAR(bulk().elastic_energy(u), 0.5 * strain.dot(elastic * strain), 1e-12 * strain.squaredNorm());
}

TEST(Bulk, StiffnessIsPositiveDefiniteAndRigidSeparationIsStrain) {
  const CondensedCell<2>& cell = bulk().condensed();
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(cell.stiffness).eigenvalues().minCoeff(), 0);
  // A uniform opening w of the whole line corresponds to a strain -w of the cell without stress: the faces
  // move apart rigidly.
  Eigen::VectorXd uniform = Eigen::VectorXd::Zero(cell.stiffness.rows());
  for (Eigen::Index i = 0; i < uniform.size(); i += 2) uniform[i] = 1;
  EXPECT_LE((cell.stiffness * uniform - cell.coupling.col(1)).norm(), 1e-10 * cell.coupling.col(1).norm());
  double width = 0;
  for (const CrackNode& node : cell.nodes)
    if (!node.initially_open) width += node.weight;
  EXPECT_NEAR(width, 0.75, 1e-13);
}

// psi_bulk is the condensed quadratic form; it is compared with Eq. 25 integrated over the mesh, and the
// homogenised stress with the mesh average plus the crack's share (the average over the solid is the average
// over the cell, cracks having no volume).
TEST(Bulk, CondensedEnergyAndStressAreThoseOfTheMesh) {
  const CondensedCell<2>& cell = bulk().condensed();
  const LinearSoftening law(3e6, 80);
  const double E = 18727e6, l = 0.016;
  const InterfaceProblem<2> problem{.cell = cell, .law = law, .youngs_modulus = E, .cell_size = l};
  CellState<2> state = unloaded_state(problem);
  for (const Voigt<2>& strain : {Voigt<2>(0, 2e-4, 0), Voigt<2>(0, 5e-4, 0), Voigt<2>(1e-5, 4e-4, 1e-4)}) {
    ASSERT_EQ(equilibrate(problem, strain, Eigen::VectorXd(state.opening), state).outcome,
              NewtonReport::Outcome::converged);
    const HomogenizedState<2> condensed = homogenize(problem, state);
    const auto u = bulk().displacement(state.opening / l, strain);
    EXPECT_NEAR(condensed.psi_bulk, E * bulk().elastic_energy(u), 1e-9 * condensed.psi_undamaged);
    EXPECT_LE((condensed.stress - E * bulk().average_stress(u)).norm(), 1e-9 * 3e6);
  }
}

TEST(Bulk, DisplacementJumpsByTheOpening) {
  const CondensedCell<2>& cell = bulk().condensed();
  Eigen::VectorXd w(cell.stiffness.rows());
  for (Eigen::Index i = 0; i < w.size(); ++i) w[i] = 1e-3 * (1 + 0.1 * std::sin(double(i)));
  const auto u = bulk().displacement(w, Voigt<2>::Zero());
  std::vector<dealii::Point<2>> points(bulk().dofs().n_dofs());
  dealii::DoFTools::map_dofs_to_support_points(dealii::MappingQ1<2>(), bulk().dofs(), points);
  for (std::size_t i = 0; i < cell.nodes.size(); ++i) {
    // The values at this place are lower and upper x and y in some order; the difference between largest and
    // smallest value is the jump.
    std::vector<double> x, y;
    std::vector<dealii::types::global_dof_index> of_cell(bulk().dofs().get_fe().n_dofs_per_cell());
    for (const auto& quad : bulk().dofs().active_cell_iterators()) {
      quad->get_dof_indices(of_cell);
      for (unsigned int k = 0; k < of_cell.size(); ++k)
        if (points[of_cell[k]].distance({cell.nodes[i].position[0], 0.5}) < 1e-12) {
          const bool vertical = bulk().dofs().get_fe().system_to_component_index(k).first == 1;
          (vertical ? y : x).push_back(u[of_cell[k]]);
        }
    }
    ASSERT_FALSE(y.empty());
    EXPECT_NEAR(*std::max_element(y.begin(), y.end()) - *std::min_element(y.begin(), y.end()), w[2 * i],
                1e-14);
    EXPECT_NEAR(*std::max_element(x.begin(), x.end()) - *std::min_element(x.begin(), x.end()), w[2 * i + 1],
                1e-14);
  }
}

/// Compares the condensed form with dense algebra: the openings' stiffness is what is left of the mesh's when
/// the fluctuations Z are eliminated. Any displacements with unit openings serve, as they differ by
/// fluctuations only.
template<int dim> void expect_dense_condensation(const CellGeometry& geometry, const MeshDensity& density) {
  const CellComplex<dim> complex = cell_complex<dim>(geometry, density);
  const Bulk<dim> solid(complex, density.approximation(), 0, {Isotropic(nu)});
  const CondensedCell<dim>& cell = solid.condensed();
  dealii::Triangulation<dim> mesh; // made alike, so that its seams are those of the solid
  const auto seams = make_split_mesh(complex, 0, mesh);
  const auto constraints = closed_constraints(solid.dofs(), seams, Boundary::periodic);
  const Eigen::MatrixXd K = assemble_stiffness(solid.dofs(), solid.phases(), density.approximation());

  Eigen::MatrixXd Z = Eigen::MatrixXd::Zero(K.rows(), K.rows());
  std::vector<Eigen::Index> moving;
  for (Eigen::Index i = 0; i < K.rows(); ++i) {
    if (!constraints.is_constrained(i))
      Z(i, i) = 1, moving.push_back(i);
    else if (const auto* same = constraints.get_constraint_entries(i); !same->empty())
      Z(i, same->front().first) = 1;
  }
  Z = Z(Eigen::all, moving).eval();
  const Eigen::Index openings = cell.stiffness.rows();
  Eigen::MatrixXd U(K.rows(), openings + voigt_size<dim>); // of unit openings, then of unit strains
  for (Eigen::Index k = 0; k < U.cols(); ++k) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(U.cols(), k);
    const auto u = solid.displacement(unit.head(openings), unit.tail<voigt_size<dim>>());
    U.col(k) = Eigen::Map<const Eigen::VectorXd>(u.begin(), U.rows());
  }
  U += Z * Eigen::MatrixXd::Random(Z.cols(), U.cols()) * 0.01;
  const Eigen::MatrixXd pull = Z.transpose() * K * U,
                        S = U.transpose() * K * U -
                            pull.transpose() * (Z.transpose() * K * Z).llt().solve(pull);
  const auto near = [](const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected) {
    return (found - expected).norm() <= 1e-10 * expected.norm();
  };
  EXPECT_TRUE(near(cell.stiffness, S.topLeftCorner(openings, openings)));
  EXPECT_TRUE(near(cell.coupling, -S.topRightCorner(openings, voigt_size<dim>)));
  EXPECT_TRUE(near(cell.uncracked, S.bottomRightCorner(voigt_size<dim>, voigt_size<dim>)));
}

TEST(Bulk, CondensationIsThatOfDenseAlgebra) {
  expect_dense_condensation<2>({.crack_ratio = 0.25}, {.elements = 4, .grading = 1, .degree = 2});
  expect_dense_condensation<3>({.crack_ratio = 0.5, .shape = CrackShape::penny},
                               {.elements = 2, .grading = 1, .degree = 1});
}

TEST(Fields, RowsToShowAreEvenlySpacedAndIncludeThePeak) {
  DamageCurve curve;
  for (int i = 0; i <= 100; ++i) {
    curve.strain.push_back(i);
    curve.stress.push_back(i < 50 ? i : 100 - i);
  }
  const auto rows = rows_to_show(curve, 8);
  ASSERT_EQ(rows.size(), 8U);
  EXPECT_EQ(rows.front(), 0U);
  EXPECT_EQ(rows.back(), 100U);
  EXPECT_NE(std::find(rows.begin(), rows.end(), 50U), rows.end()) << "the peak";
  for (std::size_t i = 1; i < rows.size(); ++i) EXPECT_NEAR(double(rows[i] - rows[i - 1]), 100.0 / 7, 3);
  EXPECT_EQ(rows_to_show(curve, 2), (std::vector<std::size_t>{0, 100}));
  EXPECT_EQ(rows_to_show(curve, 1), std::vector<std::size_t>{100});
  EXPECT_TRUE(rows_to_show(curve, 0).empty());
  EXPECT_EQ(rows_to_show(curve, 1000).size(), 101U);
}

} // namespace
