#pragma once

#include "macro/approximation/approximation.h"
#include "macro/contact/carried_surface.h"
#include "macro/integration/conforming_cells.h"
#include "macro/integration/integration.h"
#include "macro/material/materials.h"
#include "macro/points/ghosts.h"
#include "macro/solid/hourglass_indicators.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace spall {

/// Points per block: small enough that a block's velocities, forces and gradient operators stay in the
/// second-level cache, large enough that most of its stencil are its own points. Around the axis, where a
/// point has fewer neighbours, small blocks cost little, and refresh and subcycling choose by block: three
/// slabs took 0.56 to 0.75 of the time with 32 points that they took with 128. The shares of ranks begin at
/// blocks.
constexpr std::size_t points_per_block(const SymmetryPlanes& planes) { return planes.axis ? 32 : 128; }

/// Work done by the stresses, or energy stored in them, J. `compression` and `tension` are the parts of the
/// mean stress on the change of volume; the rest is shear. Work that is not stored has crushed concrete
/// (compression), opened cracks (tension) or made it flow (shear).
struct StressEnergy {
  double total = 0, compression = 0, tension = 0;

  double shear() const { return total - compression - tension; }
  /// Adds energy of the mean stress.
  void add_volumetric(double mean_stress, double energy) {
    (mean_stress < 0 ? compression : tension) += energy;
  }
  /// Adds the parts to what the ranks sum up.
  void list(Reduction& of_ranks) {
    for (double* part : {&total, &compression, &tension}) of_ranks.sums.push_back(part);
  }
  StressEnergy& operator+=(const StressEnergy& other) {
    total += other.total, compression += other.compression, tension += other.tension;
    return *this;
  }
  friend StressEnergy operator*(double factor, const StressEnergy& a) {
    return {factor * a.total, factor * a.compression, factor * a.tension};
  }
};

/// Subcycling: the place of a step in a cycle of steps. A block whose cells allow steps m times as long as
/// the smallest cell (m a power of two) computes its stresses in every m-th step only, from the displacements
/// of the m steps, and its forces act as m-fold impulses at the beginning of the next m steps. That is
/// central differences with the step m dt for the block (impulse method: Grubmueller et al. 1991; Tuckerman,
/// Berne and Martyna 1992); forces between points stay opposite, so momentum is kept. At the end of a cycle
/// all blocks are at the same time.
struct Subcycle {
  int step = 0;           ///< number of the step in its cycle, from 0
  int steps = 1;          ///< steps of a cycle, the largest m
  double stable_step = 0; ///< h / c of the smallest cell, s

  /// Whether a period of m steps begins or ends with this step.
  bool begins(int m) const { return step % m == 0; }
  bool ends(int m) const { return (step + 1) % m == 0; }
  /// The ratio m for a block of this h / c, s.
  int ratio(double stable_step_of_block) const {
    int m = 1;
    while (2 * m <= steps && stable_step_of_block >= 2 * m * stable_step) m *= 2;
    return m;
  }
};

/// One step's sums over this rank's points, and what the controls of the step need.
struct SolidReport {
  StressEnergy work;             ///< V sigma : D dt of this step
  double stabilization_work = 0; ///< work of the stress moments, J
  double largest_change = 0;     ///< largest |F - 1| since the last refresh
  double updates = 0;            ///< points whose stress has been computed
  std::string failure; ///< message on a cell that has inverted or is not finite; empty if there is none

  void list(Reduction& of_ranks) {
    work.list(of_ranks);
    of_ranks.sums.push_back(&stabilization_work);
    of_ranks.sums.push_back(&updates);
    of_ranks.largest.push_back(&largest_change);
  }
};

/// Which blocks of points a refresh rebuilds: those that have changed enough, and those that have been left
/// out too often.
struct RefreshChoice {
  double least_change = 0; ///< largest |F - 1| since the block's own last refresh
  int most_skipped = 0;    ///< consecutive refreshes that a block may be left out of
};

/// Counts of a refresh, over all points of the body.
struct RefreshReport {
  std::size_t rebuilt = 0;      ///< points whose gradient operators are new
  std::size_t pairs = 0;        ///< number of pairs of points and neighbours
  std::size_t regularized = 0;  ///< number of points whose neighbours do not resolve the basis
  std::size_t isolated = 0;     ///< points with too few neighbours for a gradient
  double smallest_fraction = 1; ///< smallest determinant of moments over that in the bulk, over the points
  /// Smallest h / c over the points, s (h: current smallest extent of the nodal cell).
  double smallest_step = 0;
  double stable_step = 0;        ///< the same over the present ratios of subcycling: unit of the time step, s
  int correction_iterations = 0; ///< iterations of the linear correction
  double correction_residual = 0; ///< residual of the linear correction at its end over that at its start
};

/// One deformable body, or this rank's part of it: its points, their material states, the approximation and
/// the internal force. Unless a function says otherwise, all ranks must call it together, and sums, smallest
/// and largest values are those of the whole body. The phases of a step are virtual functions; each loops
/// over all points with the concrete material inlined.
class Solid {
public:
  virtual ~Solid() = default;

  /// Finds neighbours again and rebuilds ghosts and shape functions in the present configuration
  /// (semi-Lagrangian re-association, paper Eq. 8), of all points or of the regions chosen: gradients refer
  /// to the positions at their own region's last refresh. In the Lagrangian configuration neighbours and
  /// shape functions stay as they are; their gradients are pushed forward.
  /// @throws ComputationError on all ranks, if a block has too many neighbours on any of them, or if the
  /// linear correction does not converge
  virtual RefreshReport refresh(const RefreshChoice& choice = {}) = 0;
  /// Strain increment from the velocities at midstep (positions are at the end of the step already),
  /// objective stress update, internal force (paper Eq. 11). Ghosts get the velocities of their owners, and
  /// keep their positions: follow() brings those. With subcycling, of the blocks whose period ends; forces
  /// are then multiples of the internal forces (Subcycle). @return of this rank only
  virtual SolidReport update(double dt, double time, const Subcycle& subcycle = {}) = 0;
  /// Largest stable time step of central differences in the present configuration, s: 2 / sqrt(largest
  /// eigenvalue of M^-1 K), with the stiffness of the gradients in use and the elastic moduli of the present
  /// state. Plastic flow and damage only lower the stiffness; the geometric stiffness of the stress is
  /// neglected (its relative size is stress over modulus). Lanczos estimate with its residual on the safe
  /// side. Call between steps.
  virtual double critical_step() = 0;
  /// Updates the positions of the ghosts from their owners. A refresh includes this.
  void follow() { ghosts.refresh(points, {&points.position}); }
  /// Indicators of hourglassing in the present configuration.
  HourglassIndicators hourglass_indicators() {
    follow();
    return measure_hourglassing(points, ghosts, neighbor_lists(), field_or_zero("plastic_strain"));
  }
  /// Neighbours of this rank's points in the present approximation; none before the first refresh. Needs no
  /// other rank.
  virtual NeighborLists neighbor_lists() const = 0;
  /// Energy that unloading would release at the elastic moduli of the present states, J: the integral of s
  /// : s / 4G + p^2 / 2K.
  virtual StressEnergy elastic_energy() const = 0;
  /// Names of the material's history fields. Needs no other rank.
  virtual std::vector<std::string> field_names() const = 0;
  /// Their units in the same order, "1" for none. Needs no other rank.
  virtual std::vector<std::string> field_units() const = 0;
  /// Values of a history field over the owned points, in SI units. Needs no other rank.
  /// @throws std::invalid_argument if the material has no such field; the message lists those it has
  virtual std::vector<double> field(const std::string& name) const = 0;
  /// Returns the values of a history field, or zeros if the material has no such field.
  std::vector<double> field_or_zero(const std::string& name) const {
    const std::vector<std::string> names = field_names();
    const bool known = std::find(names.begin(), names.end(), name) != names.end();
    return known ? field(name) : std::vector<double>(points.owned);
  }
  /// Bytes of memory on this rank.
  virtual std::size_t memory_bytes() const = 0;
  /// Processor time of each block of this rank's points, in their order, since the last call, s. It is
  /// measured with several ranks only. Needs no other rank.
  virtual std::vector<double> take_costs() = 0;
  /// Writes or reads all that the next steps depend on, gradient operators included. Reading needs a solid
  /// made from the same inputs.
  virtual void transfer(Archive& archive) = 0;
  /// Elastic moduli of the undamaged material, Pa.
  virtual double bulk_modulus() const = 0;
  virtual double shear_modulus() const = 0;

  const std::size_t block_size;        ///< points_per_block
  std::string label = "body";          ///< name in files and messages
  std::optional<KnownSurface> surface; ///< known surface of a body that stays whole
  /// Number of points that each rank gets when the next archive is read; empty: the present numbers.
  std::vector<std::uint64_t> next_shares;
  Points points;
  Ghosts ghosts;

protected:
  Solid(SymmetryPlanes planes, const Ranks& ranks)
      : block_size(points_per_block(planes)), ghosts(planes, ranks) {}
};

/// Smallest and largest spacing of the points of a body, m. All ranks must call it together.
inline std::pair<double, double> spacings_of(const Solid& solid) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const double spacing : solid.points.spacing)
    least = std::min(least, spacing), most = std::max(most, spacing);
  const Ranks& ranks = solid.ghosts.processes();
  return {ranks.min(least), ranks.max(most)};
}

/// Numerical choices of a solid.
struct SolidInputs {
  ApproximationInputs approximation;
  IntegrationInputs integration;
  std::shared_ptr<const ConformingCells> cells; ///< cells of the points, for conforming schemes
  Ranks ranks = {};                             ///< ranks over which the points are distributed
  bool double_precision = false;                ///< shape functions and pair sums in double instead of float
};

/// Makes a deformable body of points that have mass, volume and spacing. All ranks call it with the points of
/// the whole body, and each keeps its part of them. Law: one of the list of laws (materials.h).
template<MaterialLaw Law>
std::unique_ptr<Solid> make_solid(const Law& law, Points points, SymmetryPlanes planes, SolidInputs inputs);
/// Makes a solid with the law of a material.
std::unique_ptr<Solid> make_solid(const Material& material, Points points, SymmetryPlanes planes,
                                  SolidInputs inputs);

} // namespace spall
