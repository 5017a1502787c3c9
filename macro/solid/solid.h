#pragma once

#include "macro/approximation/approximation.h"
#include "macro/contact/carried_surface.h"
#include "macro/integration/conforming_cells.h"
#include "macro/integration/integration.h"
#include "macro/material/materials.h"
#include "macro/points/ghosts.h"
#include "macro/solid/detectors.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace spall {

/// Points per block: small enough that a block's velocities, forces and rows stay in the second-level cache,
/// large enough that the rim of touched points is not most of it. The shares of ranks begin at blocks.
constexpr std::size_t block_size = 128;

/// Work done by the stresses or energy stored in them, J: in all, and of it that of the mean stress on the
/// change of volume, apart for compression and tension. The rest is shear. Of work, what is not stored has
/// crushed concrete (compression), opened cracks (tension) or flowed (shear).
struct StressEnergy {
  double total = 0, compression = 0, tension = 0;

  double shear() const { return total - compression - tension; }
  /// Adds energy of the mean stress.
  void add_volumetric(double mean_stress, double energy) {
    (mean_stress < 0 ? compression : tension) += energy;
  }
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

/// Sums over this rank's points of one step, and what the step's controls need.
struct SolidReport {
  StressEnergy work;             ///< V sigma : D dt of this step
  double stabilization_work = 0; ///< the same of the stress moments, J
  double largest_change = 0;     ///< largest |F - 1| since the last refresh
  std::string failure;           ///< where a cell has inverted or is not finite; empty if none has

  void list(Reduction& of_ranks) {
    work.list(of_ranks);
    of_ranks.sums.push_back(&stabilization_work);
    of_ranks.largest.push_back(&largest_change);
  }
};

/// Which regions a refresh rebuilds.
struct RefreshChoice {
  double least_change =
      0; ///< those that have changed (|F - 1|) at least this much since their own last refresh,
  int most_skipped = 0; ///< and those left out so many times
};

/// Counts of a refresh, over all points.
struct RefreshReport {
  std::size_t rebuilt = 0; ///< points whose rows are new
  std::size_t pairs = 0, regularized = 0, isolated = 0;
  double smallest_fraction = 1; ///< of the bulk's determinant of moments, over the points
  double stable_step =
      0; ///< smallest h / c over the points, s (h: current smallest extent of the nodal cell)
};

/// One deformable body, or this rank's part of it. Where not said otherwise, sums, smallest and largest
/// values are those of the whole body, and all ranks must make the calls together. Holds its points, their
/// material states, the approximation and the internal force. Phases are virtual, points are not: each call
/// below loops over all points with the concrete material inlined.
class Solid {
public:
  virtual ~Solid() = default;

  /// Finds neighbours again and rebuilds ghosts and shape functions in the present configuration
  /// (semi-Lagrangian re-association, paper Eq. 8), of all points or of the regions chosen: gradients refer
  /// to the positions at their own region's last refresh. In the Lagrangian configuration neighbours and
  /// shape functions stay as they are; their gradients are pushed forward.
  virtual RefreshReport refresh(const RefreshChoice& choice = {}) = 0;
  /// Strain increment from the velocities at midstep (positions are at the end of the step already),
  /// objective stress update, internal force (paper Eq. 11). Ghosts get the velocities of their owners, and
  /// keep their positions: follow() brings those. @return of this rank only
  virtual SolidReport update(double dt, double time) = 0;
  /// Largest stable time step of central differences in the present configuration, s: 2 / sqrt(largest
  /// eigenvalue of M^-1 K), with the stiffness of the gradients in use and the elastic moduli of the present
  /// state. Plastic flow and damage only lower the stiffness; what the stress itself adds to it is left out
  /// (a part of stress over modulus). Lanczos estimate with its residual on the safe side. Call between
  /// steps.
  virtual double critical_step() = 0;
  /// Brings ghosts to where their owners are. Refreshes do so by themselves.
  void follow() { ghosts.refresh(points, {&points.position}); }
  /// High-frequency parts of fields that are smooth in a sound solution, in the present configuration.
  Roughness roughness() {
    follow();
    return measure_roughness(points, ghosts, neighbor_lists(), field("plastic_strain"));
  }
  /// Neighbours of this rank's points in the present approximation; none before the first refresh.
  virtual NeighborLists neighbor_lists() const = 0;
  /// Of all ranks, which must call it together: what unloading would give back at the elastic moduli of the
  /// present states: s : s / 4G + p^2 / 2K.
  virtual StressEnergy elastic_energy() const = 0;
  /// Names of the history fields, and their values over the owned points.
  virtual std::vector<std::string> field_names() const = 0;
  virtual std::vector<double> field(const std::string& name) const = 0;
  virtual std::size_t memory_bytes() const = 0;
  /// Processor time of each block of this rank's points, in their order, since the last call, s; measured
  /// with several ranks only.
  virtual std::vector<double> take_costs() = 0;
  /// All that the next steps depend on, rows of gradients included. Loading wants a solid made from the same
  /// inputs.
  virtual void transfer(Archive& archive) = 0;
  /// Elastic moduli of the undamaged material, Pa.
  virtual double bulk_modulus() const = 0;
  virtual double shear_modulus() const = 0;

  std::string label = "body";          ///< in files and messages
  std::optional<KnownSurface> surface; ///< of one that stays whole
  /// Points that each rank is to have when what is transferred next is loaded; empty: as now.
  std::vector<std::uint64_t> next_shares;
  Points points;
  Ghosts ghosts;

protected:
  Solid(SymmetryPlanes planes, const Ranks& ranks) : ghosts(planes, ranks) {}
};

/// Smallest and largest spacing of its points, m; all ranks must ask together.
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
  std::shared_ptr<const ConformingCells> cells; ///< of the points, for conforming schemes
  Ranks ranks = {};                             ///< over which the points are spread
  bool double_precision = false;                ///< shape functions and pair sums in double instead of float
};

/// Takes the points (filled, with mass, volume and spacing; with several ranks each takes its part of them).
/// Law: one of the list of laws (materials.h).
template<MaterialLaw Law>
std::unique_ptr<Solid> make_solid(const Law& law, Points points, SymmetryPlanes planes, SolidInputs inputs);
/// The same of whichever law a material has.
std::unique_ptr<Solid> make_solid(const Material& material, Points points, SymmetryPlanes planes,
                                  SolidInputs inputs);

} // namespace spall
