#include "micro/cell/node_pairs.h"

#include "micro/cell/disjoint_sets.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace spall {
namespace {

using Dof = dealii::types::global_dof_index;

/// Distance below which two places are the same, in units of the period: far below any element, far above
/// round-off.
constexpr double same_place = 1e-9;

/// Contribution of a face to a node: the integrals over the face of the node's shape function, and of the
/// outward normal times the shape function.
template<int dim> struct Share {
  double weight = 0;
  dealii::Tensor<1, dim> normal{};
};

template<int dim> void add(Share<dim>& sum, const Share<dim>& share) {
  sum.weight += share.weight;
  sum.normal += share.normal;
}

/// A node on one face.
template<int dim> struct FaceNode {
  std::array<Dof, dim> dofs; ///< the first one is the node's number
  dealii::Point<dim> at;
  Share<dim> share;
};
template<int dim> struct BoundaryFace {
  dealii::Point<dim> centre;
  std::vector<FaceNode<dim>> nodes;
};

template<int dim> using FacesOf = std::map<dealii::types::boundary_id, std::vector<BoundaryFace<dim>>>;

/// Collects the faces of each boundary id.
template<int dim> FacesOf<dim> boundary_faces(const dealii::DoFHandler<dim>& dofs) {
  const auto& element = dofs.get_fe();
  std::vector<dealii::Point<dim>> support(dofs.n_dofs());
  dealii::DoFTools::map_dofs_to_support_points(dealii::MappingQ1<dim>(), dofs, support);
  const dealii::QGauss<dim - 1> quadrature(element.degree + 1);
  dealii::FEFaceValues<dim> values(
      element, quadrature, dealii::update_values | dealii::update_JxW_values | dealii::update_normal_vectors);
  std::vector<Dof> indices(element.n_dofs_per_cell());
  FacesOf<dim> result;
  for (const auto& cell : dofs.active_cell_iterators())
    for (const unsigned int f : cell->face_indices()) {
      if (!cell->face(f)->at_boundary()) continue;
      values.reinit(cell, f);
      cell->get_dof_indices(indices);
      BoundaryFace<dim> face{.centre = cell->face(f)->center(), .nodes = {}};
      for (unsigned int i = 0; i < indices.size(); ++i) {
        const auto [component, node] = element.system_to_component_index(i);
        if (component != 0 || !element.has_support_on_face(i, f)) continue;
        FaceNode<dim> here;
        for (int c = 0; c < dim; ++c) here.dofs[c] = indices[element.component_to_system_index(c, node)];
        here.at = support[here.dofs[0]];
        for (const unsigned int q : values.quadrature_point_indices()) {
          const double part = values.shape_value(i, q) * values.JxW(q);
          add(here.share, {part, part * values.normal_vector(q)});
        }
        face.nodes.push_back(here);
      }
      result[cell->face(f)->boundary_id()].push_back(std::move(face));
    }
  return result;
}

/// Returns the element of `list` whose member `place` is at the wanted point.
template<int dim, class T>
const T& at(const std::vector<T>& list, dealii::Point<dim> T::*place, const dealii::Point<dim>& wanted) {
  for (const T& candidate : list)
    if ((candidate.*place).distance(wanted) < same_place) return candidate;
  AssertThrow(false, dealii::ExcMessage("facing boundaries do not match"));
  return list.front();
}

/// Calls visit(lower face, matching nodes of the upper face in the same order) for the faces of one seam.
template<int dim, class Visit>
void for_facing(const FacesOf<dim>& faces, const Seam<dim>& seam, const Visit& visit) {
  const auto &from = faces.at(seam.lower), &to = faces.at(seam.upper);
  AssertThrow(from.size() == to.size(), dealii::ExcMessage("facing boundaries do not match"));
  std::vector<FaceNode<dim>> matching;
  for (const BoundaryFace<dim>& lower : from) {
    const auto& upper = at<dim>(to, &BoundaryFace<dim>::centre, lower.centre + seam.shift);
    matching.clear();
    for (const FaceNode<dim>& node : lower.nodes)
      matching.push_back(at<dim>(upper.nodes, &FaceNode<dim>::at, node.at + seam.shift));
    visit(lower, matching);
  }
}

/// Joins the dofs of nodes that move together: periodic images and, if `closed`, the two faces of cracks.
template<int dim>
DisjointSets same_dofs(const dealii::DoFHandler<dim>& dofs, const FacesOf<dim>& faces,
                       const std::vector<Seam<dim>>& seams, Boundary boundary, bool closed) {
  DisjointSets same(dofs.n_dofs());
  for (const Seam<dim>& seam : seams) {
    if (seam.border && boundary != Boundary::periodic) continue;
    if (seam.crack && !closed) continue;
    for_facing(faces, seam, [&](const BoundaryFace<dim>& lower, const std::vector<FaceNode<dim>>& upper) {
      for (std::size_t i = 0; i < upper.size(); ++i)
        for (int c = 0; c < dim; ++c) same.join(lower.nodes[i].dofs[c], upper[i].dofs[c]);
    });
  }
  return same;
}

/// Two nodes, each with its periodic images, that face each other across a crack.
template<int dim> struct Interface {
  Dof lower = 0, upper = 0;
  dealii::Point<dim> position;
  int line = 0;
  bool touches_ligament = false;
  /// Whether it has an opening of its own; false for the dependent interfaces where cracks meet.
  bool independent = false;
  Share<dim> of_ligament{}, of_crack{};
};

/// A face of a ligament with the share of each of its nodes.
template<int dim> struct LigamentFace {
  static constexpr std::size_t whole = std::numeric_limits<std::size_t>::max();
  struct Node {
    /// Number of the interface; `whole` at the end of a crack, where the node is not split.
    std::size_t interface = whole;
    dealii::Point<dim> at;
    Share<dim> share;
  };
  std::vector<Node> nodes;
};

template<int dim> struct Network {
  std::vector<Interface<dim>> interfaces;
  std::vector<LigamentFace<dim>> ligaments;
};

template<int dim>
Network<dim> find_interfaces(const FacesOf<dim>& faces, const std::vector<Seam<dim>>& seams,
                             Boundary boundary, const DisjointSets& same) {
  Network<dim> network;
  std::map<std::pair<Dof, Dof>, std::size_t> known;
  for (const Seam<dim>& seam : seams) {
    if (!seam.crack || (seam.border && boundary != Boundary::periodic)) continue;
    for_facing(faces, seam, [&](const BoundaryFace<dim>& lower, const std::vector<FaceNode<dim>>& upper) {
      LigamentFace<dim> ligament;
      for (std::size_t i = 0; i < upper.size(); ++i) {
        const FaceNode<dim>& node = lower.nodes[i];
        ligament.nodes.push_back({.at = node.at, .share = node.share});
        const Dof a = same(node.dofs[0]), b = same(upper[i].dofs[0]);
        if (a == b) continue;
        const auto [entry, fresh] = known.try_emplace(std::minmax(a, b), network.interfaces.size());
        if (fresh)
          network.interfaces.push_back({.lower = a, .upper = b, .position = node.at, .line = seam.line});
        Interface<dim>& interface = network.interfaces[entry->second];
        ligament.nodes.back().interface = entry->second;
        // Two crack faces that meet at a node may list its two copies in opposite order.
        Share<dim>& share = ligament.nodes.back().share;
        if (interface.lower != a) share.normal *= -1;
        if (seam.open)
          add(interface.of_crack, share);
        else
          interface.touches_ligament = true;
      }
      if (!seam.open) network.ligaments.push_back(std::move(ligament));
    });
  }
  return network;
}

/// Chooses the independent interfaces, a spanning tree of the copies at each place, and adds the shares of
/// the dependent interfaces to them.
template<int dim> void choose_independent(Network<dim>& network, std::size_t dofs) {
  DisjointSets tied(dofs);
  for (const bool ligament : {true, false})
    for (Interface<dim>& interface : network.interfaces)
      if (interface.touches_ligament == ligament)
        interface.independent = tied.join(interface.lower, interface.upper);
  std::map<Dof, std::vector<std::size_t>> at_place;
  for (std::size_t i = 0; i < network.interfaces.size(); ++i)
    at_place[tied(network.interfaces[i].lower)].push_back(i);
  for (const LigamentFace<dim>& face : network.ligaments)
    for (const auto& node : face.nodes) {
      if (node.interface == face.whole) continue;
      // The share belongs to the node's own interface if that is independent; else to another one of its line
      // at the same place, which carries its load; else to the nearest one of the face; else to the nearest
      // one of the line.
      Interface<dim>* nearest = &network.interfaces[node.interface];
      const int line = nearest->line;
      double distance = std::numeric_limits<double>::infinity();
      const auto offer = [&](Interface<dim>& other, const dealii::Point<dim>& at) {
        if (!other.independent || at.distance(node.at) >= distance) return;
        nearest = &other;
        distance = at.distance(node.at);
      };
      if (!nearest->independent) {
        for (const std::size_t other : at_place[tied(nearest->lower)])
          if (network.interfaces[other].line == line && network.interfaces[other].touches_ligament)
            offer(network.interfaces[other], node.at);
        for (const auto& other : face.nodes)
          if (other.interface != face.whole) offer(network.interfaces[other.interface], other.at);
        for (Interface<dim>& other : network.interfaces)
          if (!nearest->independent && other.line == line && other.touches_ligament)
            offer(other, other.position);
      }
      add(nearest->of_ligament, node.share);
    }
}

} // namespace

template<int dim>
std::vector<CrackPair<dim>> crack_pairs(const dealii::DoFHandler<dim>& dofs,
                                        const std::vector<Seam<dim>>& seams, Boundary boundary) {
  const FacesOf<dim> faces = boundary_faces(dofs);
  const DisjointSets same = same_dofs(dofs, faces, seams, boundary, false);
  const DisjointSets place = same_dofs(dofs, faces, seams, boundary, true);
  Network<dim> network = find_interfaces(faces, seams, boundary, same);
  choose_independent(network, dofs.n_dofs());
  const std::vector<Interface<dim>>& interfaces = network.interfaces;

  // Collect the nodes at each place, and the places that cannot open.
  std::map<Dof, std::vector<std::array<Dof, dim>>> copies;
  std::set<Dof> fixed, seen;
  for (const auto& [id, list] : faces)
    for (const BoundaryFace<dim>& face : list)
      for (const FaceNode<dim>& node : face.nodes) {
        const Dof where = place(node.dofs[0]);
        if (seams[id / 2].border && boundary == Boundary::linear_displacement) fixed.insert(where);
        if (seen.insert(node.dofs[0]).second) copies[where].push_back(node.dofs);
      }
  std::map<Dof, std::vector<std::size_t>> at_place;
  for (std::size_t i = 0; i < interfaces.size(); ++i)
    if (interfaces[i].independent) at_place[place(interfaces[i].lower)].push_back(i);

  std::vector<CrackPair<dim>> pairs;
  for (std::size_t i = 0; i < interfaces.size(); ++i) {
    const Interface<dim>& interface = interfaces[i];
    const Dof where = place(interface.lower);
    if (!interface.independent || fixed.contains(where)) continue;
    const bool open = !interface.touches_ligament;
    const Share<dim>& share = open ? interface.of_crack : interface.of_ligament;
    pairs.push_back({.position = interface.position,
                     .weight = share.weight,
                     .initially_open = open,
                     .line = interface.line,
                     .normal = share.normal / share.normal.norm(),
                     .moved = {}});
    // Without this interface the spanning tree has two parts; an opening moves the part of the upper node.
    std::set<Dof> moving = {interface.upper};
    for (std::size_t size = 0; size != moving.size();) {
      size = moving.size();
      for (const std::size_t other : at_place.at(where))
        if (other != i &&
            moving.contains(interfaces[other].lower) != moving.contains(interfaces[other].upper)) {
          moving.insert(interfaces[other].lower);
          moving.insert(interfaces[other].upper);
        }
    }
    for (const auto& node : copies.at(where))
      if (moving.contains(same(node[0]))) pairs.back().moved.push_back(node);
  }
  return pairs;
}

template<int dim>
dealii::AffineConstraints<double> closed_constraints(const dealii::DoFHandler<dim>& dofs,
                                                     const std::vector<Seam<dim>>& seams, Boundary boundary) {
  const FacesOf<dim> faces = boundary_faces(dofs);
  const DisjointSets same = same_dofs(dofs, faces, seams, boundary, true);
  std::set<Dof> held;
  if (boundary == Boundary::linear_displacement) {
    for (const auto& [id, list] : faces)
      for (const BoundaryFace<dim>& face : list)
        for (const FaceNode<dim>& node : face.nodes)
          for (int c = 0; seams[id / 2].border && c < dim; ++c) held.insert(same(node.dofs[c]));
  } else {
    // One node of the border is held to exclude translations.
    std::vector<FaceNode<dim>> border;
    for (const auto& [id, list] : faces)
      for (const BoundaryFace<dim>& face : list)
        if (seams[id / 2].border) border.insert(border.end(), face.nodes.begin(), face.nodes.end());
    const FaceNode<dim>& first = border.front();
    for (int c = 0; c < dim; ++c) held.insert(same(first.dofs[c]));
    if (boundary == Boundary::uniform_traction) {
      // Rotations are excluded too: the node farthest to the side must not rotate about the first one, and in
      // 3D a third one must not rotate about the line through both.
      const auto farthest = [&](const auto& distance) {
        return *std::max_element(border.begin(), border.end(), [&](const auto& a, const auto& b) {
          return distance(a.at - first.at) < distance(b.at - first.at);
        });
      };
      const FaceNode<dim> second =
          farthest([](const dealii::Tensor<1, dim>& from) { return std::abs(from[0]); });
      for (int c = 1; c < dim; ++c) held.insert(same(second.dofs[c]));
      if constexpr (dim == 3) {
        const dealii::Tensor<1, dim> line = second.at - first.at;
        const FaceNode<dim> third = farthest([&](const dealii::Tensor<1, dim>& from) {
          return std::abs(line[0] * from[1] - line[1] * from[0]);
        });
        held.insert(same(third.dofs[2]));
      }
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

template std::vector<CrackPair<2>> crack_pairs(const dealii::DoFHandler<2>&, const std::vector<Seam<2>>&,
                                               Boundary);
template std::vector<CrackPair<3>> crack_pairs(const dealii::DoFHandler<3>&, const std::vector<Seam<3>>&,
                                               Boundary);
template dealii::AffineConstraints<double> closed_constraints(const dealii::DoFHandler<2>&,
                                                              const std::vector<Seam<2>>&, Boundary);
template dealii::AffineConstraints<double> closed_constraints(const dealii::DoFHandler<3>&,
                                                              const std::vector<Seam<3>>&, Boundary);

} // namespace spall
