#include "micro/cell/mesh.h"

#include "micro/cell/disjoint_sets.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace spall {
namespace {

using dealii::Point;
using dealii::Tensor;

/// Distance below which two places are the same, in units of the period: far below any element, far above
/// round-off.
constexpr double same_place = 1e-9;

template<int dim> using FaceVertices = std::array<unsigned int, (1 << (dim - 1))>;

/// A face and the one or two cells that it belongs to.
template<int dim> struct Face {
  FaceVertices<dim> vertices; ///< vertex numbers in the order of the first cell
  /// For each cell and vertex of the face: 2^dim * cell + vertex of the cell.
  std::vector<unsigned int> corners;
  Point<dim> centre;
  const CrackFace<dim>* crack = nullptr;
  bool border() const { return corners.size() == vertices.size(); }
  unsigned int cell(unsigned int side) const { return corners[side * vertices.size()] >> dim; }
};

template<int dim> FaceVertices<dim> sorted(FaceVertices<dim> vertices) {
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

template<int dim> struct Faces {
  explicit Faces(const CellComplex<dim>& complex) {
    using Geometry = dealii::GeometryInfo<dim>;
    for (unsigned int cell = 0; cell < complex.cells.size(); ++cell)
      for (unsigned int f = 0; f < Geometry::faces_per_cell; ++f) {
        FaceVertices<dim> vertices;
        std::vector<unsigned int> corners;
        for (unsigned int v = 0; v < vertices.size(); ++v) {
          const unsigned int corner = Geometry::face_to_cell_vertices(f, v);
          vertices[v] = complex.cells[cell][corner];
          corners.push_back((cell << dim) + corner);
        }
        const auto [entry, fresh] = known.try_emplace(sorted<dim>(vertices), all.size());
        if (fresh) {
          Point<dim> centre;
          for (const unsigned int v : vertices) centre += complex.vertices[v] / double(vertices.size());
          all.push_back({.vertices = vertices, .corners = {}, .centre = centre});
        }
        auto& of_face = all[entry->second].corners;
        of_face.insert(of_face.end(), corners.begin(), corners.end());
      }
    for (const CrackFace<dim>& crack : complex.cracks) {
      const auto entry = known.find(sorted<dim>(crack.vertices));
      if (entry == known.end()) throw std::invalid_argument("a crack face is not a face of the mesh");
      all[entry->second].crack = &crack;
    }
  }
  std::size_t number(const CrackFace<dim>& crack) const { return known.at(sorted<dim>(crack.vertices)); }

  std::vector<Face<dim>> all;

private:
  std::map<FaceVertices<dim>, std::size_t> known;
};

/// Returns a normal vector (not a unit vector) towards the upper side of a crack face.
Tensor<1, 2> upwards(const CellComplex<2>& complex, const CrackFace<2>& face) {
  const Tensor<1, 2> along = complex.vertices[face.vertices[1]] - complex.vertices[face.vertices[0]];
  Tensor<1, 2> normal;
  normal[0] = -along[1];
  normal[1] = along[0];
  return normal;
}
Tensor<1, 3> upwards(const CellComplex<3>& complex, const CrackFace<3>& face) {
  const Point<3>& origin = complex.vertices[face.vertices[0]];
  return dealii::cross_product_3d(complex.vertices[face.vertices[1]] - origin,
                                  complex.vertices[face.vertices[2]] - origin);
}

template<int dim> bool lies_above(const CellComplex<dim>& complex, unsigned int cell, const Face<dim>& face) {
  Point<dim> centre;
  for (const unsigned int v : complex.cells[cell]) centre += complex.vertices[v] / double(1 << dim);
  return upwards(complex, *face.crack) * (centre - face.centre) > 0;
}

/// Finds the periodic image of each border face: maps its number to the image's number.
template<int dim>
std::map<std::size_t, std::size_t> images(const CellComplex<dim>& complex,
                                          const std::vector<Face<dim>>& faces) {
  Tensor<2, dim> lattice; // columns
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) lattice[i][j] = complex.periods[j][i];
  const Tensor<2, dim> inverse = dealii::invert(lattice);
  std::vector<std::size_t> border;
  std::vector<Tensor<1, dim>> place; // centres in lattice coordinates
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (faces[i].border()) {
      border.push_back(i);
      place.push_back(inverse * faces[i].centre);
    }
  const auto is_image = [&](std::size_t a, std::size_t b) {
    for (int c = 0; c < dim; ++c) {
      const double apart = place[a][c] - place[b][c];
      if (std::abs(apart - std::round(apart)) > same_place) return false;
    }
    return true;
  };
  std::map<std::size_t, std::size_t> result;
  for (std::size_t a = 0; a < border.size(); ++a) {
    if (result.contains(border[a])) continue;
    std::size_t b = a + 1;
    while (b < border.size() && (result.contains(border[b]) || !is_image(a, b))) ++b;
    if (b == border.size()) throw std::invalid_argument("a border face has no image one period away");
    result[border[a]] = border[b];
    result[border[b]] = border[a];
  }
  return result;
}

/// The vertices of the mesh after splitting, its cells, and for each corner of a cell its copy of the vertex.
template<int dim> struct SplitVertices {
  std::vector<Point<dim>> vertices;
  std::vector<dealii::CellData<dim>> cells;
  std::vector<unsigned int> copy; ///< vertex of corner 2^dim * cell + vertex of the cell
};

/// Copies each vertex as often as the crack faces separate the cells around it.
template<int dim>
SplitVertices<dim> split_vertices(const CellComplex<dim>& complex, const Faces<dim>& faces) {
  constexpr unsigned int per_face = 1 << (dim - 1);
  // Corners of cells that are connected across an uncracked face share their vertices; each set of corners is
  // one copy of a vertex.
  DisjointSets corners(complex.cells.size() << dim);
  for (const Face<dim>& face : faces.all)
    for (unsigned int v = 0; !face.border() && face.crack == nullptr && v < per_face; ++v)
      for (unsigned int other = per_face; other < 2 * per_face; ++other) {
        const auto vertex = [&](unsigned int corner) {
          return complex.cells[corner >> dim][corner & ((1U << dim) - 1)];
        };
        if (vertex(face.corners[v]) == vertex(face.corners[other]))
          corners.join(face.corners[v], face.corners[other]);
      }
  SplitVertices<dim> split;
  split.cells.resize(complex.cells.size());
  split.copy.resize(complex.cells.size() << dim);
  for (unsigned int corner = 0; corner < split.copy.size(); ++corner) {
    const unsigned int cell = corner >> dim, v = corner & ((1U << dim) - 1);
    if (corners(corner) == corner) { // the smallest member of a set comes first
      split.copy[corner] = static_cast<unsigned int>(split.vertices.size());
      split.vertices.push_back(complex.vertices[complex.cells[cell][v]]);
    }
    split.copy[corner] = split.copy[corners(corner)];
    split.cells[cell].vertices[v] = split.copy[corner];
    split.cells[cell].material_id = complex.materials.empty() ? 0 : complex.materials[cell];
  }
  return split;
}

} // namespace

template<int dim>
std::vector<Seam<dim>> make_split_mesh(const CellComplex<dim>& complex, unsigned int refinements,
                                       dealii::Triangulation<dim>& mesh) {
  const Faces<dim> faces(complex);
  constexpr unsigned int per_face = 1 << (dim - 1);

  SplitVertices<dim> split = split_vertices(complex, faces);
  dealii::SubCellData boundary;
  std::vector<Seam<dim>> seams;
  const auto mark = [&](const Face<dim>& face, unsigned int side, dealii::types::boundary_id id) {
    dealii::CellData<dim - 1> data;
    for (unsigned int v = 0; v < per_face; ++v)
      data.vertices[v] = split.copy[face.corners[side * per_face + v]];
    data.boundary_id = id;
    if constexpr (dim == 2)
      boundary.boundary_lines.push_back(data);
    else
      boundary.boundary_quads.push_back(data);
    return sorted<dim>([&] {
      FaceVertices<dim> of;
      for (unsigned int v = 0; v < per_face; ++v) of[v] = data.vertices[v];
      return of;
    }());
  };
  const auto add_seam = [&](const Face<dim>& lower, const Face<dim>& upper, unsigned int upper_side) {
    const auto number = static_cast<unsigned int>(seams.size());
    Seam<dim> seam{.lower = 2 * number, .upper = 2 * number + 1, .shift = upper.centre - lower.centre};
    seam.border = lower.border();
    const unsigned int lower_side = seam.border ? 0 : 1 - upper_side;
    if (mark(lower, lower_side, seam.lower) == mark(upper, upper_side, seam.upper))
      throw std::invalid_argument(
          "a crack of a single face cannot open, because the vertices at its ends are not split");
    seams.push_back(seam);
  };
  const auto image = images(complex, faces.all);
  for (const CrackFace<dim>& crack : complex.cracks) {
    const Face<dim>& face = faces.all[faces.number(crack)];
    if (!face.border())
      add_seam(face, face, lies_above(complex, face.cell(1), face) ? 1 : 0);
    else if (const Face<dim>& other = faces.all[image.at(faces.number(crack))];
             lies_above(complex, face.cell(0), face))
      add_seam(other, face, 0);
    else
      add_seam(face, other, 0);
    seams.back().crack = true;
    seams.back().line = crack.line;
    seams.back().open = crack.open;
  }
  for (const auto& [one, other] : image)
    if (one < other && faces.all[one].crack == nullptr && faces.all[other].crack == nullptr)
      add_seam(faces.all[one], faces.all[other], 0);

  dealii::GridTools::consistently_order_cells(split.cells);
  mesh.create_triangulation(split.vertices, split.cells, boundary);
  mesh.refine_global(refinements);
  return seams;
}

template std::vector<Seam<2>> make_split_mesh(const CellComplex<2>&, unsigned int, dealii::Triangulation<2>&);
template std::vector<Seam<3>> make_split_mesh(const CellComplex<3>&, unsigned int, dealii::Triangulation<3>&);

CellComplex<2> cell_complex(const CellGrid& grid) {
  CellComplex<2> complex;
  const auto width = static_cast<unsigned int>(grid.x.size());
  for (const GridRow& row : grid.rows)
    for (unsigned int i = 0; i < width; ++i) complex.vertices.emplace_back(grid.x[i], row.y[i]);
  for (unsigned int row = 0; row + 1 < grid.rows.size(); ++row)
    for (unsigned int i = 0; i + 1 < width; ++i) {
      const unsigned int corner = row * width + i;
      complex.cells.push_back({corner, corner + 1, corner + width, corner + width + 1});
    }
  for (unsigned int row = 0; row < grid.rows.size(); ++row)
    for (unsigned int i = 0; grid.rows[row].line >= 0 && i + 1 < width; ++i)
      complex.cracks.push_back({.vertices = {row * width + i, row * width + i + 1},
                                .line = grid.rows[row].line,
                                .open = grid.open[grid.rows[row].line][i]});
  for (const GridColumn& column : grid.vertical)
    for (unsigned int row = 0; row + 1 < grid.rows.size(); ++row) {
      const unsigned int at = row * width + static_cast<unsigned int>(column.at);
      complex.cracks.push_back( // the upper side is the right one
          {.vertices = {at + width, at}, .line = column.line, .open = column.open[row]});
    }
  complex.periods[0][0] = complex.periods[1][1] = 1; // the lattice is square for any rise
  return complex;
}

} // namespace spall
