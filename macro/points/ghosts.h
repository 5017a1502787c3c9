#pragma once

#include "macro/points/points.h"

#include <cstdint>
#include <vector>

namespace spall {

/// Symmetry of a scene about the z axis or planes through it: of what is equal only one part is modelled.
struct SymmetryPlanes {
  std::array<bool, 3> normal{false, false,
                             false}; ///< plane x = 0, y = 0, z = 0: the positive half is modelled
  /// Rotation about z: the points lie in the half plane y = 0 < x and stand for rings. Their masses and
  /// volumes are those of the rings. Excludes the planes.
  bool axis = false;

  /// Whether a body that shares the symmetry can move along an axis, or turn about it, and keep it.
  bool moves_along(int c) const { return !normal[c] && !(axis && c < 2); }
  bool turns_about(int c) const { return !normal[(c + 1) % 3] && !normal[(c + 2) % 3] && !axis; }

  /// How many copies of the model make the whole body.
  double multiplicity() const {
    double copies = 1;
    for (const bool present : normal) copies *= present ? 2 : 1;
    return copies;
  }
};

/// Number of points that make a ring of radius r, a multiple of four: images at equal gaps of about one
/// spacing, with one opposite of each. Chosen anew at every refresh of the shape functions: a ring that grows
/// gets more of them, as its neighbours in the half plane keep their distance.
int points_on_ring(double radius, double spacing);
/// Arc between them, m.
double gap_on_ring(double radius, double spacing);

/// Images of owned points behind symmetry planes or around the axis. They make the approximation near a plane
/// that of the whole body, so the plane needs no boundary condition of its own; around the axis they make a
/// meridian plane of points the whole body, with the same kernels, gradients and stresses as in three
/// dimensions.
class Ghosts {
public:
  explicit Ghosts(SymmetryPlanes planes_ = {}) : planes(planes_) {}

  /// Chooses the images that are in reach of the owned points and appends them to position, velocity and
  /// force: those within `reach[c]` behind each plane; around the axis those within reach[1] of the half
  /// plane. With `keep` (planes only), images there are keep their places and only new ones are added.
  void rebuild(Points& points, const Vec3& reach, bool keep = false);
  /// Copies positions and velocities of the owners to the images.
  void refresh(Points& points) const;
  /// Adds the forces gathered by the images to their owners, turned back, in a fixed order. Around the axis
  /// the forces along y cancel; what rounding leaves of them is dropped.
  void add_back(Points& points) const;

  std::size_t size() const { return images.size(); }
  /// The owned point that point i (owned or image) moves with.
  std::uint32_t owner(const Points& points, std::uint32_t i) const {
    return i < points.owned ? i : images[i - points.owned].owner;
  }
  /// A vector of the owner of point i, as it is at i.
  Vec3 mirror(const Points& points, std::uint32_t i, const Vec3& a) const {
    return i < points.owned ? a : images[i - points.owned].at_image(a);
  }
  /// A vector at point i, as it is at its owner.
  Vec3 mirror_back(const Points& points, std::uint32_t i, const Vec3& a) const {
    return i < points.owned ? a : images[i - points.owned].at_owner(a);
  }
  const SymmetryPlanes& symmetry() const { return planes; }
  void transfer(Archive& archive) {
    archive("images", images);
    archive("images_present", present);
  }

private:
  /// An owned point seen in a mirror, or turned about the axis: an orthogonal map (xx, xy; yx, yy) in x and y
  /// and a sign in z.
  struct Image {
    std::uint32_t owner;
    double xx = 1, xy = 0, yx = 0, yy = 1, z = 1;

    Vec3 at_image(const Vec3& a) const { return {xx * a[0] + xy * a[1], yx * a[0] + yy * a[1], z * a[2]}; }
    Vec3 at_owner(const Vec3& a) const { return {xx * a[0] + yx * a[1], xy * a[0] + yy * a[1], z * a[2]}; }
  };
  void add_reflections(const Points& points, const Vec3& reach);
  void add_rotations(const Points& points, double reach);

  SymmetryPlanes planes;
  std::vector<Image> images;
  std::vector<std::uint8_t> present; ///< bit per mask of mirrored axes, per owned point
};

} // namespace spall
