#pragma once

#include "macro/approximation/approximation.h"
#include "macro/points/ghosts.h"

#include <cstdint>
#include <vector>

namespace spall {

/// Values of a body's fields at places that are not its points, and forces at such places given to its
/// points: the shape functions of the linear basis (paper Eqs. 6-8) of the present positions.
///
/// The support of a place is a ball with the radius of the supports of the points about it at the start; it
/// does not follow the deformation. Sum of the weights is 1 and sum of weights times positions is the place,
/// so that a force at the place and its parts on the points have the same sum and the same moment. A place
/// about which the points do not hold a linear field, or lie to one side, has no weights: no concrete is left
/// there to hold a bar.
///
/// Every rank has all places, and computes the parts of its own points: sums over the points are summed up
/// over the ranks. Sums go over the points in their order, so results do not depend on the number of threads,
/// nor on when the lists of near points were made.
class PointInterpolation {
public:
  /// @param radius of the support of every place, m
  PointInterpolation(std::vector<double> radius, Profile profile, const SymmetryPlanes& planes,
                     const Ranks& ranks);

  /// Weights at the present places and positions. All ranks must call it.
  void evaluate(const VectorField& places, const Points& points);
  /// The field at the places, 0 where there are no weights; of the points of all ranks, who must call it
  /// together.
  void interpolate(const VectorField& field, std::vector<Vec3>& at_places) const;
  /// Gives forces at the places to the points of this rank.
  void distribute(const std::vector<Vec3>& at_places, VectorField& force) const;
  bool held(std::size_t place) const { return holds[place] != 0; } ///< whether a place has weights
  /// Largest row sum, over the points of all ranks, of the stiffness that springs between the places and the
  /// interpolated displacement give to the points, over their mass, 1/s^2. @param stiffness of each, N/m
  double stiffness_over_mass(const std::vector<double>& stiffness, const std::vector<double>& mass) const;

  /// The bodies may have moved by so much more, m, against each other since evaluate() was called.
  void moved(double distance) { travelled += distance; }
  /// The points are others now.
  void forget() { known = false; }

private:
  /// A point near a place, or its mirror image: bit c of the mask stands for the plane across axis c.
  struct Near {
    std::uint32_t point;
    std::uint32_t mask;
  };
  /// A point in the support of a place.
  struct Part {
    Near of;
    Vec3 at;       ///< from the place, in radii of the support
    double weight; ///< kernel, then weight
  };
  static constexpr std::size_t sums = 10; ///< moments of the kernel about a place up to the second ones
  void find_near(const VectorField& places, const Points& points);
  template<class Kernel> void evaluate_with(const VectorField& places, const Points& points);
  template<class Kernel> void add_moments(std::size_t k, const Vec3& place, const Points& points);
  template<class Kernel> void set_weights(std::size_t k);
  Vec3 value_at(std::size_t k, const VectorField& field) const;

  std::vector<double> radius;
  Profile profile;
  SymmetryPlanes planes;
  Ranks ranks;
  std::vector<std::vector<Near>> near;  ///< by place, in the order of the points
  std::vector<std::vector<Part>> parts; ///< those of them in the support now, in the same order
  std::vector<double> moments;          ///< `sums` of every place
  std::vector<double> sizes;            ///< of every place: sum of the magnitudes of its weights
  std::vector<std::uint8_t> holds;
  double travelled = 0; ///< since the near points were found, m
  bool known = false;
};

} // namespace spall
