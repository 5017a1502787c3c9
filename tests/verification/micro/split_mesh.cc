// Tests of meshes that are split along faces that meet in any way, and of the openings there.

#include "micro/cell/node_pairs.h"

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <stdexcept>

namespace {

using namespace spall;

/// Divides the unit cell into n x n (x n) elements.
template<int dim> CellComplex<dim> grid(unsigned int n) {
  CellComplex<dim> complex;
  const unsigned int wide = n + 1, high = n + 1, deep = dim == 3 ? n + 1 : 1;
  for (unsigned int k = 0; k < deep; ++k)
    for (unsigned int j = 0; j < high; ++j)
      for (unsigned int i = 0; i < wide; ++i) {
        dealii::Point<dim> p;
        const std::array<unsigned int, 3> at = {i, j, k};
        for (int c = 0; c < dim; ++c) p[c] = double(at[c]) / n;
        complex.vertices.push_back(p);
      }
  for (unsigned int k = 0; k < (dim == 3 ? n : 1); ++k)
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i) {
        std::array<unsigned int, (1 << dim)> cell{};
        for (unsigned int v = 0; v < cell.size(); ++v)
          cell[v] = i + (v & 1) + wide * (j + (v >> 1 & 1) + high * (k + (v >> 2)));
        complex.cells.push_back(cell);
      }
  for (int c = 0; c < dim; ++c) complex.periods[c][c] = 1;
  return complex;
}
/// Returns the crack face from vertex (i, j) to the right or upwards.
CrackFace<2> face(unsigned int n, unsigned int i, unsigned int j, bool right, int line, bool open = false) {
  const unsigned int a = i + (n + 1) * j;
  return {.vertices = {a, right ? a + 1 : a + n + 1}, .line = line, .open = open};
}

/// Returns the number of vertices of the mesh at a place.
template<int dim> int copies(const dealii::Triangulation<dim>& mesh, const dealii::Point<dim>& place) {
  int count = 0;
  for (const auto& vertex : mesh.get_vertices()) count += vertex.distance(place) < 1e-12;
  return count;
}

TEST(SplitMesh, AVertexHasACopyForEachSeparatedPart) {
  constexpr unsigned int n = 6;
  CellComplex<2> complex = grid<2>(n);
  // The cracks are a line across the cell, a line that crosses it at (2, 3) and ends inside at (2, 1), and a
  // line that branches off upwards at (4, 3).
  for (unsigned int i = 0; i < n; ++i) complex.cracks.push_back(face(n, i, 3, true, 0));
  for (unsigned int j = 1; j < 6; ++j) complex.cracks.push_back(face(n, 2, j, false, 1));
  for (unsigned int j = 3; j < 6; ++j) complex.cracks.push_back(face(n, 4, j, false, 2));
  dealii::Triangulation<2> mesh;
  const auto seams = make_split_mesh(complex, 0, mesh);
  const auto at = [&](int i, int j) { return copies(mesh, {i / 6.0, j / 6.0}); };
  EXPECT_EQ(at(2, 3), 4); // crossing
  EXPECT_EQ(at(4, 3), 3); // branch
  EXPECT_EQ(at(2, 1), 1); // end
  EXPECT_EQ(at(2, 2), 2);
  EXPECT_EQ(at(0, 3), 2); // at the border
  EXPECT_EQ(at(3, 5), 1);
  std::set<dealii::types::boundary_id> ids;
  unsigned int cracks = 0;
  for (const auto& seam : seams) {
    ids.insert({seam.lower, seam.upper});
    cracks += seam.crack;
    EXPECT_NE(seam.crack, seam.border);
  }
  EXPECT_EQ(ids.size(), 2 * seams.size());
  EXPECT_EQ(cracks, complex.cracks.size());
}

TEST(SplitMesh, In3DACrackMayEndInside) {
  constexpr unsigned int n = 4;
  CellComplex<3> complex = grid<3>(n);
  // The cracks are half of the horizontal plane z = 1/2 and the whole vertical plane x = 1/2.
  const auto number = [](unsigned int i, unsigned int j, unsigned int k) { return i + 5 * (j + 5 * k); };
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = 0; i < 3; ++i)
      complex.cracks.push_back(
          {.vertices = {number(i, j, 2), number(i + 1, j, 2), number(i, j + 1, 2), number(i + 1, j + 1, 2)}});
  for (unsigned int k = 0; k < n; ++k)
    for (unsigned int j = 0; j < n; ++j)
      complex.cracks.push_back(
          {.vertices = {number(2, j, k), number(2, j + 1, k), number(2, j, k + 1), number(2, j + 1, k + 1)},
           .line = 1});
  dealii::Triangulation<3> mesh;
  const auto seams = make_split_mesh(complex, 1, mesh);
  EXPECT_EQ(copies<3>(mesh, {0.5, 0.5, 0.5}), 4);
  EXPECT_EQ(copies<3>(mesh, {0.75, 0.5, 0.5}), 1); // at the crack front
  EXPECT_EQ(copies<3>(mesh, {0.625, 0.5, 0.5}), 2);
  EXPECT_EQ(copies<3>(mesh, {0.5, 0.5, 0.125}), 2);

  dealii::FESystem<3> element(dealii::FE_Q<3>(2), 3);
  dealii::DoFHandler<3> dofs(mesh);
  dofs.distribute_dofs(element);
  std::map<int, double> area;
  for (const CrackPair<3>& pair : crack_pairs(dofs, seams, Boundary::periodic)) {
    area[pair.line] += pair.weight;
    EXPECT_NEAR(pair.normal[pair.line == 0 ? 2 : 0], 1, 1e-12);
  }
  // Faces at the end of a crack lose the area of their nodes that are not split: a sixth of a quadratic face.
  EXPECT_NEAR(area[0], 0.75 - 2 * 0.125 / 6, 1e-12);
  EXPECT_NEAR(area[1], 1, 1e-12);
}

// At crossing ligaments k copies have k - 1 openings, and the area of the dependent interface is not lost.
TEST(SplitMesh, CrossingsHaveATreeOfOpenings) {
  constexpr unsigned int n = 4;
  CellComplex<2> complex = grid<2>(n);
  for (unsigned int i = 0; i < n; ++i) complex.cracks.push_back(face(n, i, 2, true, 0));
  for (unsigned int j = 0; j < n; ++j) complex.cracks.push_back(face(n, 2, j, false, 1));
  for (const unsigned int degree : {1U, 3U}) {
    dealii::Triangulation<2> mesh;
    const auto seams = make_split_mesh(complex, 1, mesh);
    dealii::FESystem<2> element(dealii::FE_Q<2>(degree), 2);
    dealii::DoFHandler<2> dofs(mesh);
    dofs.distribute_dofs(element);
    std::map<int, double> length;
    std::map<int, int> at_crossing;
    std::size_t count = 0;
    for (const CrackPair<2>& pair : crack_pairs(dofs, seams, Boundary::periodic)) {
      ++count;
      length[pair.line] += pair.weight;
      at_crossing[pair.line] += pair.position.distance({0.5, 0.5}) < 1e-12;
      EXPECT_FALSE(pair.initially_open);
      EXPECT_NEAR(pair.normal[1 - pair.line], pair.line == 0 ? 1 : -1, 1e-12);
    }
    EXPECT_NEAR(length[0], 1, 1e-12);
    EXPECT_NEAR(length[1], 1, 1e-12);
    EXPECT_EQ(at_crossing[0], 2);
    EXPECT_EQ(at_crossing[1], 1);
    // There are two periodic lines of 8 * degree nodes; the crossing has three openings for the two lines.
    EXPECT_EQ(count, 2 * 8 * degree + 1);
    // With closed cracks the number of free unknowns is that of a mesh without cracks, except for the held
    // node.
    const auto constraints = closed_constraints(dofs, seams, Boundary::periodic);
    EXPECT_EQ(dofs.n_dofs() - constraints.n_constraints(), 2 * 64 * degree * degree - 2);
  }
}

TEST(SplitMesh, RefusesCracksThatCannotOpenAndBordersThatAreNotPeriodic) {
  dealii::Triangulation<2> mesh;
  CellComplex<2> single = grid<2>(4);
  single.cracks.push_back(face(4, 1, 2, true, 0));
  EXPECT_THROW(make_split_mesh(single, 0, mesh), std::invalid_argument);
  CellComplex<2> elsewhere = grid<2>(4);
  elsewhere.cracks.push_back({.vertices = {0, 7}});
  EXPECT_THROW(make_split_mesh(elsewhere, 0, mesh), std::invalid_argument);
  CellComplex<2> longer = grid<2>(4);
  longer.periods[0][0] = 1.1;
  EXPECT_THROW(make_split_mesh(longer, 0, mesh), std::invalid_argument);
}

// A crack on the border of the period is equivalent to one inside.
TEST(SplitMesh, BorderMayCrack) {
  constexpr unsigned int n = 4;
  CellComplex<2> complex = grid<2>(n);
  for (unsigned int i = 0; i < n; ++i) complex.cracks.push_back(face(n, i, i % 2 == 0 ? 0 : 4, true, 0));
  dealii::Triangulation<2> mesh;
  const auto seams = make_split_mesh(complex, 0, mesh);
  dealii::FESystem<2> element(dealii::FE_Q<2>(2), 2);
  dealii::DoFHandler<2> dofs(mesh);
  dofs.distribute_dofs(element);
  const auto pairs = crack_pairs(dofs, seams, Boundary::periodic);
  double length = 0;
  for (const CrackPair<2>& pair : pairs) {
    length += pair.weight;
    EXPECT_NEAR(pair.normal[1], 1, 1e-12);
  }
  EXPECT_NEAR(length, 1, 1e-12);
  EXPECT_EQ(pairs.size(), 8U);
  EXPECT_TRUE(crack_pairs(dofs, seams, Boundary::linear_displacement).empty());
}

} // namespace
