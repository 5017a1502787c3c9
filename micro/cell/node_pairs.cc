#include "micro/cell/node_pairs.h"

#include "micro/cell/mesh.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace spall {
namespace {

using Dof = dealii::types::global_dof_index;
using Face = dealii::DoFHandler<2>::active_face_iterator;

/// Height on a vertical edge, modulo the cell's period; a small margin keeps 1 at 1.
double modulo(double y) { return y - std::floor(y + 1e-9); }

/// Faces of one boundary, sorted along it; vertical edges modulo the period, so that shifted ones match.
std::vector<Face> faces_on(const dealii::DoFHandler<2>& dofs, dealii::types::boundary_id id, int along) {
  std::vector<Face> faces;
  for (const auto& cell : dofs.active_cell_iterators())
    for (const auto& face : cell->face_iterators())
      if (face->at_boundary() && face->boundary_id() == id) faces.push_back(face);
  const auto key = [along](const Face& face) {
    return along == 1 ? modulo(face->center()[1]) : face->center()[0];
  };
  std::sort(faces.begin(), faces.end(), [&](const Face& a, const Face& b) { return key(a) < key(b); });
  return faces;
}

/// Calls visit(dofs of one face, dofs of its partner) for two boundaries with matching faces.
template<class Visit>
void for_facing(const dealii::DoFHandler<2>& dofs, dealii::types::boundary_id a, dealii::types::boundary_id b,
                int along, const Visit& visit) {
  const std::vector<Face> from = faces_on(dofs, a, along), to = faces_on(dofs, b, along);
  AssertThrow(from.size() == to.size(), dealii::ExcMessage("facing boundaries do not match"));
  const unsigned int per_face = dofs.get_fe().n_dofs_per_face();
  std::vector<Dof> here(per_face), there(per_face);
  for (std::size_t i = 0; i < from.size(); ++i) {
    // Same vertex order on both, or the nodes would be crossed.
    const double apart = (from[i]->vertex(0) - to[i]->vertex(0))[along];
    AssertThrow(std::abs(along == 1 ? apart - std::round(apart) : apart) < 1e-9,
                dealii::ExcMessage("facing faces do not match"));
    from[i]->get_dof_indices(here);
    to[i]->get_dof_indices(there);
    visit(from[i], here, there);
  }
}

/// Sets of dofs that are one and the same unknown (union-find); the smallest one represents its set.
class SameDofs {
public:
  explicit SameDofs(Dof count) : parent(count) { std::iota(parent.begin(), parent.end(), Dof(0)); }
  Dof operator()(Dof i) const {
    while (parent[i] != i) i = parent[i];
    return i;
  }
  void join(Dof a, Dof b) {
    a = (*this)(a);
    b = (*this)(b);
    parent[std::max(a, b)] = std::min(a, b);
  }
  void join_facing(const dealii::DoFHandler<2>& dofs, dealii::types::boundary_id a,
                   dealii::types::boundary_id b, int along) {
    for_facing(dofs, a, b, along,
               [this](const Face&, const std::vector<Dof>& here, const std::vector<Dof>& there) {
                 for (std::size_t i = 0; i < here.size(); ++i) join(here[i], there[i]);
               });
  }

private:
  std::vector<Dof> parent;
};

SameDofs same_on_edges(const dealii::DoFHandler<2>& dofs, bool periodic) {
  SameDofs same(dofs.n_dofs());
  if (!periodic) return same;
  same.join_facing(dofs, CellBoundary::left, CellBoundary::right, 1);
  same.join_facing(dofs, CellBoundary::bottom, CellBoundary::top, 0);
  return same;
}

} // namespace

std::vector<CrackPair> crack_pairs(const dealii::DoFHandler<2>& dofs, const CellGrid& grid, bool periodic) {
  const auto& element = dofs.get_fe();
  const SameDofs same = same_on_edges(dofs, periodic);
  // Integral of each shape function over a face of length 1.
  std::vector<double> integral(element.n_dofs_per_face());
  {
    const dealii::QGauss<1> quadrature(element.degree + 1);
    for (unsigned int i = 0; i < integral.size(); ++i) {
      // Face 2 of the reference square is its bottom, y = 0.
      const unsigned int index = element.face_to_cell_index(i, 2);
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        integral[i] +=
            quadrature.weight(q) * element.shape_value(index, dealii::Point<2>(quadrature.point(q)[0], 0));
    }
  }
  struct Share {
    double length = 0;
    std::array<double, 2> normal{};
  };
  struct Shares {
    Share ligament, crack;
  };
  std::vector<CrackPair> pairs;
  std::vector<Shares> shares;
  std::map<Dof, std::size_t> known; // representative of the lower x dof -> pair
  for (std::size_t line = 0; line < grid.open.size(); ++line) {
    std::size_t interval = 0;
    for_facing(
        dofs, CellBoundary::crack_lower(line), CellBoundary::crack_upper(line), 0,
        [&](const Face& face, const std::vector<Dof>& lower, const std::vector<Dof>& upper) {
          const bool open = grid.open[line][interval++];
          const auto along = face->vertex(1) - face->vertex(0);
          const std::array<double, 2> normal = {-along[1] / face->measure(), along[0] / face->measure()};
          for (unsigned int i = 0; i < lower.size(); ++i) {
            const auto [component, node] = element.face_system_to_component_index(i, 2);
            if (component != 0) continue;
            unsigned int y = 0; // the same node's other component
            while (element.face_system_to_component_index(y, 2) !=
                   std::pair<unsigned int, unsigned int>(1, node))
              ++y;
            const double at = element.unit_support_point(element.face_to_cell_index(i, 2))[0];
            const double x = face->vertex(0)[0] + at * (face->vertex(1)[0] - face->vertex(0)[0]);
            const auto [entry, fresh] = known.try_emplace(same(lower[i]), pairs.size());
            if (fresh) {
              pairs.push_back({.position = x, .line = static_cast<int>(line)});
              shares.emplace_back();
            }
            CrackPair& pair = pairs[entry->second];
            pair.on_edge = pair.on_edge || x == 0 || x == 1;
            Share& share = open ? shares[entry->second].crack : shares[entry->second].ligament;
            share.length += integral[i] * face->measure();
            for (int c = 0; c < 2; ++c) share.normal[c] += integral[i] * face->measure() * normal[c];
            const bool new_image =
                std::none_of(pair.images.begin(), pair.images.end(),
                             [&](const FacingNodes& image) { return image.lower[0] == lower[i]; });
            if (new_image)
              pair.images.push_back({.lower = {lower[i], lower[y]}, .upper = {upper[i], upper[y]}});
          }
        });
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[i].initially_open = shares[i].ligament.length == 0;
    const Share& share = pairs[i].initially_open ? shares[i].crack : shares[i].ligament;
    pairs[i].weight = share.length;
    const double size = std::hypot(share.normal[0], share.normal[1]);
    pairs[i].normal = {share.normal[0] / size, share.normal[1] / size};
  }
  return pairs;
}

dealii::AffineConstraints<double> closed_constraints(const dealii::DoFHandler<2>& dofs, Boundary boundary,
                                                     unsigned int lines) {
  SameDofs same = same_on_edges(dofs, boundary == Boundary::periodic);
  for (unsigned int line = 0; line < lines; ++line)
    same.join_facing(dofs, CellBoundary::crack_lower(line), CellBoundary::crack_upper(line), 0);

  std::set<Dof> held;
  if (boundary == Boundary::linear_displacement) {
    std::vector<Dof> of_face(dofs.get_fe().n_dofs_per_face());
    for (const auto id : {CellBoundary::left, CellBoundary::right, CellBoundary::bottom, CellBoundary::top})
      for (const Face& face : faces_on(dofs, id, 0)) {
        face->get_dof_indices(of_face);
        for (const Dof i : of_face) held.insert(same(i));
      }
  } else {
    // No translation: the first node of the first cell is held; any will do.
    std::vector<Dof> of_cell(dofs.get_fe().n_dofs_per_cell());
    dofs.begin_active()->get_dof_indices(of_cell);
    std::array<Dof, 2> first{};
    for (int component = 1; component >= 0; --component)
      for (unsigned int i = of_cell.size(); i-- > 0;)
        if (dofs.get_fe().system_to_component_index(i).first == static_cast<unsigned int>(component))
          first[component] = same(of_cell[i]);
    held = {first[0], first[1]};
    if (boundary == Boundary::uniform_traction) { // nor rotation: the lower right corner stays at its height
      const Face last = faces_on(dofs, CellBoundary::bottom, 0).back();
      std::vector<Dof> of_face(dofs.get_fe().n_dofs_per_face());
      last->get_dof_indices(of_face);
      held.insert(same(of_face[3])); // vertices come first: x, y of the left one, x, y of the right one
    }
  }

  dealii::AffineConstraints<double> constraints;
  for (Dof i = 0; i < dofs.n_dofs(); ++i) {
    const Dof master = same(i);
    if (held.contains(master)) {
      constraints.add_line(i);
    } else if (master != i) {
      constraints.add_line(i);
      constraints.add_entry(i, master, 1);
    }
  }
  constraints.close();
  return constraints;
}

} // namespace spall
