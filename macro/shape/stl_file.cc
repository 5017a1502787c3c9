#include "macro/shape/stl_file.h"

#include "shared/error.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <fstream>

namespace spall {
namespace {

namespace processing = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Place = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Place>;
using Corners = std::vector<std::array<std::size_t, 3>>;

/// Edges that only one triangle has.
std::size_t open_edges(const Mesh& mesh) {
  std::size_t open = 0;
  for (const auto edge : mesh.edges()) open += mesh.is_border(edge) ? 1 : 0;
  return open;
}

/// Refuses a file with one line.
struct Refusal {
  const std::filesystem::path& file;

  [[noreturn]] void operator()(const std::string& why) const { throw InputError(file.string() + ": " + why); }
};

Mesh read_mesh(const std::filesystem::path& file, double unit, const Refusal& refuse) {
  if (!std::ifstream(file)) refuse("cannot be opened");
  std::vector<Place> points;
  Corners corners;
  if (!CGAL::IO::read_STL(file.string(), points, corners)) refuse("is not a whole STL file (text or binary)");
  if (corners.empty())
    refuse("no triangles found, allowed: an STL file (text or binary) with a closed surface");
  for (Place& x : points) {
    if (!std::isfinite(x.x() + x.y() + x.z())) refuse("has a corner that is not finite");
    x = Place(unit * x.x(), unit * x.y(), unit * x.z());
  }
  processing::merge_duplicate_points_in_polygon_soup(points, corners);
  std::size_t flat = 0;
  for (const auto& [a, b, c] : corners) flat += CGAL::collinear(points[a], points[b], points[c]) ? 1 : 0;
  if (flat > 0) refuse("has " + std::to_string(flat) + " triangles without area");
  if (!processing::orient_polygon_soup(points, corners))
    refuse("more than two triangles meet at an edge or surfaces touch at a point: it bounds no volume");
  Mesh mesh;
  processing::polygon_soup_to_polygon_mesh(points, corners, mesh);
  return mesh;
}

} // namespace

StlSurface read_stl(const std::filesystem::path& file, double unit) {
  const Refusal refuse{file};
  Mesh mesh = read_mesh(file, unit, refuse);
  if (const std::size_t open = open_edges(mesh); open > 0)
    refuse("the surface is not closed: " + std::to_string(open) + " edges have a triangle on one side only");
  if (processing::does_self_intersect(mesh)) refuse("the surface intersects itself");
  StlSurface read;
  // Parts that are all inside out bound the rest of space.
  if (!processing::does_bound_a_volume(mesh) || processing::volume(mesh) < 0) {
    processing::orient_to_bound_a_volume(mesh);
    read.turned = true;
  }
  for (const auto vertex : mesh.vertices()) {
    const Place& x = mesh.point(vertex);
    read.triangles.points.push_back({x.x(), x.y(), x.z()});
  }
  for (const auto face : mesh.faces()) {
    std::array<std::int64_t, 3> corners;
    std::size_t k = 0;
    for (const auto vertex : CGAL::vertices_around_face(mesh.halfedge(face), mesh))
      corners[k++] = vertex.idx();
    read.triangles.corners.push_back(corners);
  }
  return read;
}

} // namespace spall
