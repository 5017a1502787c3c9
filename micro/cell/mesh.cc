#include "micro/cell/mesh.h"

namespace spall {

void make_cell_mesh(const CellGrid& grid, dealii::Triangulation<2>& mesh) {
  // Rows of vertices from bottom to top, those on crack lines twice.
  struct Row {
    const std::vector<double>* y;
    int ends_below = -1;   ///< crack line whose lower faces these vertices carry
    int begins_above = -1; ///< crack line whose upper faces these vertices carry
  };
  std::vector<Row> rows;
  for (const GridRow& row : grid.rows) {
    if (row.line >= 0) rows.push_back({.y = &row.y, .ends_below = row.line});
    rows.push_back({.y = &row.y, .begins_above = row.line});
  }

  const unsigned int width = grid.x.size();
  std::vector<dealii::Point<2>> vertices;
  for (const Row& row : rows)
    for (unsigned int i = 0; i < width; ++i) vertices.emplace_back(grid.x[i], (*row.y)[i]);

  std::vector<dealii::CellData<2>> cells;
  dealii::SubCellData boundary;
  const auto mark = [&boundary](unsigned int a, unsigned int b, dealii::types::boundary_id id) {
    dealii::CellData<1> face;
    face.vertices = {a, b};
    face.boundary_id = id;
    boundary.boundary_lines.push_back(face);
  };
  for (unsigned int row = 0; row + 1 < rows.size(); ++row) {
    if (rows[row].ends_below >= 0) continue; // the gap between the two copies
    for (unsigned int i = 0; i + 1 < width; ++i) {
      const unsigned int corner = row * width + i;
      dealii::CellData<2> cell;
      cell.vertices = {corner, corner + 1, corner + width, corner + width + 1};
      cells.push_back(cell);
      if (i == 0) mark(corner, corner + width, CellBoundary::left);
      if (i + 2 == width) mark(corner + 1, corner + width + 1, CellBoundary::right);
      if (row == 0) mark(corner, corner + 1, CellBoundary::bottom);
      if (row + 2 == rows.size()) mark(corner + width, corner + width + 1, CellBoundary::top);
      if (const int line = rows[row + 1].ends_below; line >= 0)
        mark(corner + width, corner + width + 1, CellBoundary::crack_lower(line));
      if (const int line = rows[row].begins_above; line >= 0)
        mark(corner, corner + 1, CellBoundary::crack_upper(line));
    }
  }
  mesh.create_triangulation(vertices, cells, boundary);
}

} // namespace spall
