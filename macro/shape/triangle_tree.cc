#include "macro/shape/triangle_tree.h"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

namespace spall {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Place = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Place>;
using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Place place(const Vec3& x) { return {x[0], x[1], x[2]}; }

Mesh mesh_of(const Triangles& surface) {
  std::vector<Place> points;
  for (const Vec3& x : surface.points) points.push_back(place(x));
  Mesh mesh; // its faces have the numbers of the triangles
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, surface.corners, mesh);
  return mesh;
}

} // namespace

struct TriangleTree::Search {
  explicit Search(const Triangles& surface)
      : mesh(mesh_of(surface)), tree(faces(mesh).begin(), faces(mesh).end(), mesh), side((build(), tree)) {}
  /// What a first question would build: afterwards no question changes the tree.
  void build() {
    tree.build();
    tree.accelerate_distance_queries();
  }

  Mesh mesh;
  Tree tree;
  CGAL::Side_of_triangle_mesh<Mesh, Kernel> side;
};

TriangleTree::TriangleTree(const Triangles& surface) : search(std::make_shared<const Search>(surface)) {}

TriangleTree::Nearest TriangleTree::nearest(const Vec3& x) const {
  const auto [foot, face] = search->tree.closest_point_and_primitive(place(x));
  return {{foot.x(), foot.y(), foot.z()}, static_cast<std::size_t>(face.idx())};
}

bool TriangleTree::inside(const Vec3& x) const { return search->side(place(x)) == CGAL::ON_BOUNDED_SIDE; }

} // namespace spall
