#pragma once

#include "macro/points/points.h"
#include "macro/reinforcement/bar_steel.h"

#include <cstdint>
#include <vector>

namespace spall {

/// A straight bar at the start, from one end to the other, m.
struct BarLine {
  Vec3 from{}, to{};
  /// Part of its section that is modelled: half of it if it lies in a plane of symmetry.
  double share = 1;
};

/// Bars as chains of nodes: segments between two nodes that carry an axial force, and hinges at the nodes
/// between two segments, which resist bending.
///
/// A segment has N = A sigma of its nominal strain. A hinge has the angle phi between its two segments and
/// the moment M = E I phi / l (l: mean length of the segments), up to the plastic moment f_y d^3 / 6, beyond
/// which it turns plastically (discrete elastic rods, Bergou et al. 2008, with the angle itself). The
/// forces on the nodes are the gradients of l and phi with respect to their positions, which do not change in
/// a rigid motion: they keep linear and angular momentum exactly. The direction in which a hinge has been
/// bent is not remembered, only how far. Torsion is left out.
///
/// At a plane of symmetry a bar ends with a node in the plane, which has the half of its mass that is
/// modelled; its hinge is that of the bar and its mirror image.
class BarChain {
public:
  /// Makes bars at rest. @param spacing of the nodes, m: bars are divided into an even number of equal
  /// segments of at most this length @param planes with their normals (Ghosts): nodes in them stay in them
  BarChain(const std::vector<BarLine>& lines, double diameter, double spacing, const BarSteel& steel,
           const std::array<bool, 3>& planes);

  struct Segment {
    std::uint32_t a, b;
    double length; ///< at the start, m
    double area;   ///< that is modelled, m^2
    SteelState steel{};
  };
  struct HingeState {
    double plastic = 0; ///< plastic angle, rad
    double moment = 0;  ///< N m
    double angle = 0;   ///< rad
  };
  struct Hinge {
    std::uint32_t a, middle, c; ///< a: the mirror image of c if a == c
    double length;              ///< mean length of its segments at the start, m
    double share;               ///< that is modelled
    int plane;                  ///< normal of the plane of the image; -1: none
    HingeState state{};
  };

  /// Stresses and moments at the present positions of the nodes; sets the nodes' forces, N, to those of the
  /// chain. @return its work on the way from the last positions, J, by the forces before and after
  struct Work {
    double before = 0, after = 0;
  };
  Work update();
  /// Keeps nodes that lie in a plane of symmetry in it: removes the forces across it.
  void hold_in_planes();
  /// Unit vectors along the bar at the nodes.
  const std::vector<Vec3>& tangents() const { return directions; }
  /// Row sums of the stiffness at a node over its mass, which bound its largest eigenvalue, 1/s^2, for every
  /// node.
  void add_stiffness(std::vector<double>& over_mass) const;
  std::size_t ruptured() const; ///< number of segments
  bool ruptured(const Segment& segment) const { return steel.ruptured(segment.steel); }

  const std::vector<Segment>& segments() const { return links; }
  const std::vector<Hinge>& hinges() const { return joints; }
  const BarSteel& material() const { return steel; }
  double bar_diameter() const { return diameter; }
  /// Length of the bar that belongs to a node, times the part of its section that is modelled, m.
  const std::vector<double>& lengths() const { return tributary; }

  void transfer(Archive& archive);

  /// The nodes: mass, position, velocity, force; as wide as the bar where they touch other bodies.
  Points nodes;

private:
  /// For every node whether a segment that ends there has ruptured.
  std::vector<std::uint8_t> cut_nodes() const;
  void add_line(const BarLine& line, double spacing, const std::array<bool, 3>& planes);
  void find_directions();
  Work advance(Segment& segment);
  Work advance(Hinge& hinge, bool cut);

  double diameter;
  BarSteel steel;
  std::vector<Segment> links;
  std::vector<Hinge> joints;
  std::vector<double> tributary;
  std::vector<Vec3> directions;
  std::vector<std::array<bool, 3>> in_plane; ///< of every node: the planes of symmetry it lies in
};

} // namespace spall
