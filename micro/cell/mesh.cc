#include "micro/cell/mesh.h"

namespace spall {

void make_cell_mesh(const GridLines& lines, dealii::Triangulation<2>& mesh) {
  // Rows of vertices from bottom to top, the one on the crack line twice.
  std::vector<double> rows;
  std::size_t crack_row = 0; // index of the lower copy
  for (const double y : lines.y) {
    rows.push_back(y);
    if (y != 0.5) continue;
    crack_row = rows.size() - 1;
    rows.push_back(y);
  }

  const unsigned int width = lines.x.size();
  std::vector<dealii::Point<2>> vertices;
  for (const double y : rows)
    for (const double x : lines.x) vertices.emplace_back(x, y);

  std::vector<dealii::CellData<2>> cells;
  dealii::SubCellData boundary;
  const auto mark = [&boundary](unsigned int a, unsigned int b, dealii::types::boundary_id id) {
    dealii::CellData<1> face;
    face.vertices = {a, b};
    face.boundary_id = id;
    boundary.boundary_lines.push_back(face);
  };
  for (unsigned int row = 0; row + 1 < rows.size(); ++row) {
    if (row == crack_row) continue; // the gap between the two copies
    for (unsigned int i = 0; i + 1 < width; ++i) {
      const unsigned int corner = row * width + i;
      dealii::CellData<2> cell;
      cell.vertices = {corner, corner + 1, corner + width, corner + width + 1};
      cells.push_back(cell);
      if (i == 0) mark(corner, corner + width, CellBoundary::left);
      if (i + 2 == width) mark(corner + 1, corner + width + 1, CellBoundary::right);
      if (row == 0) mark(corner, corner + 1, CellBoundary::bottom);
      if (row + 2 == rows.size()) mark(corner + width, corner + width + 1, CellBoundary::top);
      if (row + 1 == crack_row) mark(corner + width, corner + width + 1, CellBoundary::crack_lower);
      if (row == crack_row + 1) mark(corner, corner + 1, CellBoundary::crack_upper);
    }
  }
  mesh.create_triangulation(vertices, cells, boundary);
}

} // namespace spall
