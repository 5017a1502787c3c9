#pragma once

#include "macro/points/points.h"
#include "shared/archive.h"
#include "shared/ranks.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace spall {

/// A steel ring around a slab, such as a corrugated culvert.
struct RingInputs {
  bool present = false;
  double thickness = std::numeric_limits<double>::quiet_NaN();      ///< m
  double youngs_modulus = std::numeric_limits<double>::quiet_NaN(); ///< Pa
  double yield_stress = std::numeric_limits<double>::quiet_NaN();   ///< Pa
  double density = std::numeric_limits<double>::quiet_NaN();        ///< kg/m^3
};

/// The ring as a membrane that moves along its radius: at the displacement w its hoop strain is w / R, its
/// hoop stress sigma elastic-perfectly plastic, and it pulls inwards with sigma t / R per area. Each point of
/// the rim has its own segment of the ring, with the mass of that area, so that a ring without bending and
/// shear stiffness between its strips is computed (they reach sqrt(R t) far, less than the thickness of the
/// slabs). Concrete and ring push but do not pull, and slide on each other without friction.
class ElasticRing {
public:
  ElasticRing() = default;
  /// @param area of the rim between the symmetry planes, m^2; it is distributed over the points of the rim by
  /// their volume. @param radius of the slab, m. @param ranks over which the points are spread: each has the
  /// segments of its own points, and all make it together; energies are those of this rank's segments
  ElasticRing(const RingInputs& inputs, const Points& points, double radius, double area,
              const Ranks& ranks = {});

  /// Velocities of the ring by its own force; impulses where points would push through it at the end of the
  /// step. As in push_points, the points have got their `kick` (s) by internal forces already.
  /// @return the energy lost where points meet the ring (they are stopped without rebound), J
  double apply(Points& points, double dt, double kick);
  /// The ring's displacement and stress at the end of the step.
  void move(double dt);

  double kinetic_energy() const; ///< kinetic energy at the present velocities, J
  /// Work of the hoop stress up to the middle of the last step, stored and dissipated, J.
  double work() const { return last_work + 0.5 * step_work; }
  /// Displacement and hoop stress of this rank's segments, in order of the points of the rim.
  const std::vector<double>& displacement() const { return displacements; }
  const std::vector<double>& hoop_stress() const { return stresses; }

  void transfer(Archive& archive);
  /// Segments for other points of this rank, still without a state.
  void find_rim(const Points& points);

  std::string name = "ring"; ///< name in files and messages
  std::size_t solid = 0;     ///< number of the solid that it surrounds

private:
  double pull(std::size_t s) const {
    return stresses[s] * inputs.thickness / middle_radius * areas[s];
  } ///< N
  RingInputs inputs;
  Ranks ranks;
  double middle_radius = 1;   ///< m
  double area_per_volume = 0; ///< area of the rim per volume of its points, 1/m
  double last_work = 0, step_work = 0;
  std::vector<std::uint32_t> rim; ///< points
  std::vector<double> areas, displacements, velocities, stresses;
};

} // namespace spall
