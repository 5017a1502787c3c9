#pragma once

#include "macro/points/halo.h"

#include <cstdint>
#include <vector>

namespace spall {

/// Symmetry of a scene about the z axis or about coordinate planes: only one of its equal parts is modelled.
struct SymmetryPlanes {
  /// For x = 0, y = 0 and z = 0: whether it is a plane of symmetry, of which the positive half is modelled.
  std::array<bool, 3> normal{false, false, false};
  /// Rotation about z: the points lie in the half plane y = 0 < x and represent rings. Their masses and
  /// volumes are those of the rings. Excludes the planes.
  bool axis = false;

  /// Return whether a body with the symmetry keeps it when it moves along an axis, or rotates about it.
  bool moves_along(int c) const { return !normal[c] && !(axis && c < 2); }
  bool turns_about(int c) const { return !normal[(c + 1) % 3] && !normal[(c + 2) % 3] && !axis; }

  /// Returns the number of copies of the model in the whole body.
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
/// Arc between neighbouring images of a ring, m.
double gap_on_ring(double radius, double spacing);

/// Names of points, ghosts included, that do not depend on their places in the arrays of a rank: the number
/// of the owner through all ranks, and the map of the image (entries xx, xy, yx, yy, z of Ghosts).
struct PointNames {
  using Map = std::array<double, 5>;
  static constexpr Map itself = {1, 0, 0, 1, 1};

  std::vector<std::uint64_t> number;
  std::vector<std::uint16_t> map; ///< index into `maps`
  std::vector<Map> maps;

  void transfer(Archive& archive) {
    archive("point_numbers", number);
    archive("point_maps", map);
    archive("maps", maps);
  }
};

/// Ghosts are points that this process does not move itself: images behind symmetry planes or around the
/// axis, and copies of the points of other ranks (remote points). Images make the approximation near a plane
/// that of the whole body, so the plane needs no boundary condition of its own; around the axis they make a
/// meridian plane of points the whole body, with the same kernels, gradients and stresses as in three
/// dimensions.
class Ghosts {
public:
  explicit Ghosts(SymmetryPlanes planes_ = {}, const Ranks& ranks = {}) : planes(planes_), halo(ranks) {}

  /// Chooses the ghosts that are in reach of the owned points and appends them to position, velocity and
  /// force. All ranks must call it.
  /// @param reach images are those within reach[c] behind plane c, m; around the axis those within reach[1]
  /// of the half plane, the largest of all ranks
  /// @param keep leaves the ghosts there are in their places and only adds new ones; around the axis only
  /// remote points are kept
  /// @param boxes around the supports of this rank's points: the points of other ranks in them are fetched,
  /// and around the axis only rings that meet one of them get images; none: all rings do
  void rebuild(Points& points, const Vec3& reach, bool keep = false, std::vector<Bounds> boxes = {});
  /// Leaves only the remote points: nothing refers to the images any more.
  void drop_images(Points& points);
  bool is_remote(const Points& points, std::size_t i) const {
    return i >= points.owned && images[i - points.owned].owner == i;
  }
  /// Copies positions and velocities of the owners to remote points and images. All ranks must call it.
  void refresh(Points& points) const;
  /// Does the same for any vector fields, whose length must include the ghosts.
  void refresh(const Points& points, const std::vector<VectorField*>& fields) const;
  /// Adds the forces gathered by images and remote points to their owners, turned back, in a fixed order.
  /// Around the axis the forces along y cancel; what rounding leaves of them is dropped. All ranks must call
  /// it.
  void add_back(Points& points) const;

  std::size_t size() const { return images.size(); }
  std::size_t memory_bytes() const {
    return sizeof(Image) * images.capacity() + present.capacity() + halo.memory_bytes();
  }
  /// The owned or remote point that point i (an image, or itself) moves with.
  std::uint32_t owner(const Points& points, std::uint32_t i) const {
    return i < points.owned ? i : images[i - points.owned].owner;
  }
  /// A vector of the owner of point i, turned to where i is.
  Vec3 mirror(const Points& points, std::uint32_t i, const Vec3& a) const {
    return i < points.owned ? a : images[i - points.owned].at_image(a);
  }
  /// A vector at point i, turned to where its owner is.
  Vec3 mirror_back(const Points& points, std::uint32_t i, const Vec3& a) const {
    return i < points.owned ? a : images[i - points.owned].at_owner(a);
  }
  const SymmetryPlanes& symmetry() const { return planes; }
  const Halo& remote_points() const { return halo; }
  const Ranks& processes() const { return halo.processes(); }
  /// Numbers, through all ranks, of the points in the arrays; a ghost has the number of its owner.
  std::vector<std::uint64_t> numbers(const Points& points) const;
  /// Names of the points at some places. @param numbers as above
  PointNames names(const Points& points, const std::vector<std::uint64_t>& numbers,
                   const std::vector<std::uint32_t>& places) const;
  /// Places, in the arrays of this rank, of the points with these names. @throws std::runtime_error if one is
  /// missing
  std::vector<std::vector<std::uint32_t>> places(const Points& points,
                                                 const std::vector<PointNames>& names) const;
  /// Makes the ghosts that have these names, and no others. All ranks must call it.
  void rebuild(Points& points, const std::vector<PointNames>& names);
  void transfer(Archive& archive, std::size_t owned) {
    archive("images", images);
    archive("images_present", present);
    halo.transfer(archive, owned);
  }

private:
  /// The image of an owned or remote point by reflection, or by rotation about the axis: an orthogonal map
  /// (xx, xy; yx, yy) in x and y and a sign in z. One that is its own owner is no image but a remote point.
  struct Image {
    std::uint32_t owner;
    double xx = 1, xy = 0, yx = 0, yy = 1, z = 1;

    Vec3 at_image(const Vec3& a) const { return {xx * a[0] + xy * a[1], yx * a[0] + yy * a[1], z * a[2]}; }
    PointNames::Map map() const { return {xx, xy, yx, yy, z}; }
    Vec3 at_owner(const Vec3& a) const { return {xx * a[0] + yx * a[1], xy * a[0] + yy * a[1], z * a[2]}; }
  };
  PointNames::Map map_of(const Points& points, std::size_t i) const {
    return i < points.owned ? PointNames::itself : images[i - points.owned].map();
  }
  void add_remote(Points& points, std::vector<Bounds> boxes, bool keep);
  void add_reflections(const Points& points, const Vec3& reach);
  void add_rotations(const Points& points, double reach, const std::vector<Bounds>& boxes);

  SymmetryPlanes planes;
  Halo halo;
  std::vector<Image> images;
  std::vector<std::uint8_t> present; ///< bit per mask of mirrored axes, per point
};

} // namespace spall
