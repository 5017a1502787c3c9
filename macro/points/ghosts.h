#pragma once

#include "macro/points/points.h"

#include <cstdint>
#include <vector>

namespace spall {

/// Symmetry planes through the origin; only the half with positive coordinates is modelled.
struct SymmetryPlanes {
  std::array<bool, 3> normal{false, false, false}; ///< plane x = 0, y = 0, z = 0

  /// How many copies of the model make the whole body.
  double multiplicity() const {
    double copies = 1;
    for (const bool present : normal) copies *= present ? 2 : 1;
    return copies;
  }
};

/// Mirror images of owned points behind symmetry planes. They make the approximation near a plane that of the
/// whole body, so the plane needs no boundary condition of its own.
class Ghosts {
public:
  explicit Ghosts(SymmetryPlanes planes_ = {}) : planes(planes_) {}

  /// Chooses the images within `reach[c]` behind each plane and appends them to position, velocity and force.
  /// With `keep`, images there are keep their places and only new ones are added.
  void rebuild(Points& points, const Vec3& reach, bool keep = false);
  /// Copies positions and velocities of the owners to the images, with the mirrored sign.
  void refresh(Points& points) const;
  /// Adds the forces gathered by the images to their owners, mirrored back, in a fixed order.
  void add_back(Points& points) const;

  std::size_t size() const { return images.size(); }
  /// The owned point that point i (owned or image) moves with, and the signs that mirror its components.
  std::uint32_t owner(const Points& points, std::uint32_t i) const {
    return i < points.owned ? i : images[i - points.owned].owner;
  }
  Vec3 mirror(const Points& points, std::uint32_t i, const Vec3& a) const {
    if (i < points.owned) return a;
    const auto& sign = images[i - points.owned].sign;
    return {sign[0] * a[0], sign[1] * a[1], sign[2] * a[2]};
  }
  const SymmetryPlanes& symmetry() const { return planes; }
  void transfer(Archive& archive) {
    archive("images", images);
    archive("images_present", present);
  }

private:
  struct Image {
    std::uint32_t owner;
    std::array<std::int8_t, 3> sign;
  };
  SymmetryPlanes planes;
  std::vector<Image> images;
  std::vector<std::uint8_t> present; ///< bit per mask of mirrored axes, per owned point
};

} // namespace spall
