#pragma once

#include "macro/reinforcement/bar_chain.h"
#include "macro/reinforcement/bond_law.h"
#include "macro/reinforcement/point_interpolation.h"

#include <string>
#include <vector>

namespace spall {

/// The bars of one deformable body and how they are bonded to it.
struct ReinforcementDesign {
  std::vector<BarLine> lines;
  double diameter = BarSteel::unset;     ///< m
  double node_spacing = BarSteel::unset; ///< m
  BarSteel steel;
  BondLaw bond;
};

/// Reinforcing bars in a body of points. Bars are chains of nodes with their own mass (BarChain). Every node
/// is bonded to the place of the concrete where it is: springs with the law BondLaw act between the node and
/// the velocity that the concrete's points have there (PointInterpolation), along and across the bar. Force
/// and counterforce act at one place, so linear and angular momentum are kept exactly, also where the
/// concrete is in pieces. A node that has no concrete around it is free. The concrete that the bars displace
/// is not taken out.
///
/// Every rank holds all bars and does the same with them; each gives the forces to its own points.
class Reinforcement {
public:
  /// @param radius of the support of the concrete's points about every node, m
  /// @param velocity of bars and body at the start, m/s
  Reinforcement(const ReinforcementDesign& design, const std::vector<double>& radius, Profile profile,
                const SymmetryPlanes& planes, const Ranks& ranks, const Vec3& velocity = {});
  /// Places of the nodes of such bars, m: where `radius` is asked for.
  static VectorField places(const ReinforcementDesign& design, const SymmetryPlanes& planes);

  /// Finds the concrete around the nodes: before the first step, and after points or bars have been loaded.
  /// All ranks must call it.
  void connect(const Points& points);
  /// The largest step, s, at most `step`, with which bars and bond are stable too. With the bond k between
  /// node and concrete 2 k of either alone bounds its part of the largest eigenvalue; that of the bars is
  /// bounded by row sums, and that of the points, 4 / step^2, grows by the bond's row sums.
  double stable_step(double step) const;
  /// Velocities of the nodes over a step of velocities, as for the points.
  void kick(double duration);
  void drift(double dt);
  /// Forces at the end of a step of length dt: on the nodes, and added to those of the points. All ranks must
  /// call it.
  void update(Points& points, double dt);

  // Of all bars, the same on all ranks. Energies are those of the middle of the last step, J.
  double kinetic_energy() const;
  double steel_work() const { return steel_done + steel_step.before; } ///< stored and dissipated
  double bond_work() const { return bond_done + bond_step.before; }    ///< stored and dissipated
  double momentum() const;                                             ///< along z, N s
  double mass() const;                                                 ///< kg
  std::size_t unbonded() const; ///< number of nodes without concrete around them
  double largest_slip() const;  ///< over bars and time, m

  const BarChain& bars() const { return chain; }
  Points& nodes() { return chain.nodes; }
  const Points& nodes() const { return chain.nodes; }
  const std::vector<BondState>& bonds() const { return states; }

  void transfer(Archive& archive);

  std::size_t solid = 0; ///< number of the body
  std::string name;      ///< in files and messages

private:
  using Work = BarChain::Work;
  /// Turns the bond's forces with the bars, and takes the states over the displacements of a step.
  void advance_bond(const std::vector<Vec3>& displacements, const std::vector<Vec3>& last_tangents);
  /// Displacement of the nodes against the concrete over dt, by the present weights, m.
  void relative_to_concrete(const Points& points, double dt, std::vector<Vec3>& displacements);
  /// Sum of bond forces on the nodes times displacements, J.
  double power_of_bond(const std::vector<Vec3>& displacements) const;

  BarChain chain;
  BondLaw bond;
  PointInterpolation concrete;
  std::vector<BondState> states;
  std::vector<Vec3> bond_forces;        ///< on the nodes, N
  double bond_rows = 0;                 ///< row sum of the bond over the masses of points, 1/s^2
  double steel_done = 0, bond_done = 0; ///< to the end of the last step but one, J
  Work steel_step, bond_step;           ///< of the last step
};

} // namespace spall
