#include "micro/cell/node_pairs.h"

#include "micro/cell/mesh.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace spall {
namespace {

using Dof = dealii::types::global_dof_index;
using Face = dealii::DoFHandler<2>::active_face_iterator;

/// Faces of one boundary, sorted along it.
std::vector<Face> faces_on(const dealii::DoFHandler<2>& dofs, dealii::types::boundary_id id, int along) {
  std::vector<Face> faces;
  for (const auto& cell : dofs.active_cell_iterators())
    for (const auto& face : cell->face_iterators())
      if (face->at_boundary() && face->boundary_id() == id) faces.push_back(face);
  std::sort(faces.begin(), faces.end(),
            [along](const Face& a, const Face& b) { return a->center()[along] < b->center()[along]; });
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
    AssertThrow((from[i]->vertex(0) - to[i]->vertex(0))[along] == 0,
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

SameDofs periodic(const dealii::DoFHandler<2>& dofs) {
  SameDofs same(dofs.n_dofs());
  same.join_facing(dofs, CellBoundary::left, CellBoundary::right, 1);
  same.join_facing(dofs, CellBoundary::bottom, CellBoundary::top, 0);
  return same;
}

} // namespace

std::vector<CrackPair> crack_pairs(const dealii::DoFHandler<2>& dofs, const CellGeometry& geometry) {
  const auto& element = dofs.get_fe();
  const SameDofs same = periodic(dofs);
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
  struct Weights {
    double ligament = 0, crack = 0;
  };
  std::vector<CrackPair> pairs;
  std::vector<Weights> weights;
  std::map<Dof, std::size_t> known; // representative of the lower x dof -> pair
  for_facing(dofs, CellBoundary::crack_lower, CellBoundary::crack_upper, 0,
             [&](const Face& face, const std::vector<Dof>& lower, const std::vector<Dof>& upper) {
               const bool open = std::abs(face->center()[0] - 0.5) < 0.5 * geometry.crack_ratio;
               for (unsigned int i = 0; i < lower.size(); ++i) {
                 const auto [component, node] = element.face_system_to_component_index(i, 2);
                 if (component != 0) continue;
                 unsigned int y = 0; // the same node's other component
                 while (element.face_system_to_component_index(y, 2) !=
                        std::pair<unsigned int, unsigned int>(1, node))
                   ++y;
                 const auto [entry, fresh] = known.try_emplace(same(lower[i]), pairs.size());
                 if (fresh) {
                   const double at = element.unit_support_point(element.face_to_cell_index(i, 2))[0];
                   pairs.push_back(
                       {.position = face->vertex(0)[0] + at * (face->vertex(1)[0] - face->vertex(0)[0])});
                   weights.emplace_back();
                 }
                 CrackPair& pair = pairs[entry->second];
                 Weights& weight = weights[entry->second];
                 (open ? weight.crack : weight.ligament) += integral[i] * face->measure();
                 const bool new_image =
                     std::none_of(pair.images.begin(), pair.images.end(),
                                  [&](const FacingNodes& image) { return image.lower[0] == lower[i]; });
                 if (new_image)
                   pair.images.push_back({.lower = {lower[i], lower[y]}, .upper = {upper[i], upper[y]}});
               }
             });
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[i].initially_open = weights[i].ligament == 0;
    pairs[i].weight = pairs[i].initially_open ? weights[i].crack : weights[i].ligament;
  }
  return pairs;
}

dealii::AffineConstraints<double> closed_periodic_constraints(const dealii::DoFHandler<2>& dofs) {
  SameDofs same = periodic(dofs);
  same.join_facing(dofs, CellBoundary::crack_lower, CellBoundary::crack_upper, 0);

  // The node that is held: any will do, the first of the first cell.
  std::vector<Dof> of_cell(dofs.get_fe().n_dofs_per_cell());
  dofs.begin_active()->get_dof_indices(of_cell);
  std::array<Dof, 2> held{};
  for (int component = 1; component >= 0; --component)
    for (unsigned int i = of_cell.size(); i-- > 0;)
      if (dofs.get_fe().system_to_component_index(i).first == static_cast<unsigned int>(component))
        held[component] = same(of_cell[i]);

  dealii::AffineConstraints<double> constraints;
  for (Dof i = 0; i < dofs.n_dofs(); ++i) {
    const Dof master = same(i);
    if (master == held[0] || master == held[1]) {
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
