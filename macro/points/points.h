#pragma once

#include "macro/points/tensor.h"
#include "shared/archive.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace spall {

/// A vector field as three arrays.
struct VectorField {
  std::array<std::vector<double>, 3> component;

  void resize(std::size_t n) {
    for (auto& c : component) c.resize(n, 0.0);
  }
  Vec3 operator[](std::size_t i) const { return {component[0][i], component[1][i], component[2][i]}; }
  void set(std::size_t i, const Vec3& a) {
    for (int c = 0; c < 3; ++c) component[c][i] = a[c];
  }
  void add(std::size_t i, const Vec3& a) {
    for (int c = 0; c < 3; ++c) component[c][i] += a[c];
  }
  /// Transfers the first `count` vectors.
  void transfer(Archive& archive, const char* name, std::size_t count) {
    for (auto& c : component) {
      FirstItems<double> first(c, count);
      archive.array(name, first);
    }
  }
};

/// The cell of a point does not grow with its deformation gradient beyond this: the gradient of a fragment is
/// not related to its size. The foot of a Taylor bar reaches 3.
inline constexpr double largest_cell_stretch = 3;

/// Extent of a deformed cell along a unit vector, m, but not above the limit: |edges^T direction|, exact for
/// a cell between two planes across it. @param edges undeformed edge length (m) times deformation gradient
inline double cell_extent(const Mat3& edges, const Vec3& direction, double limit) {
  return std::min(limit, norm(times_transposed(edges, direction)));
}

/// Bits for the surfaces of a body that the cell of a point lies on: the end at the smaller z, the end at the
/// larger z, the side.
enum Face : std::uint8_t { low_face = 1, high_face = 2, rim_face = 4 };

/// All material points of this process as arrays: the owned ones first, then ghosts. Only `position`,
/// `velocity` and `force` reach into the ghosts. SI units.
struct Points {
  std::size_t owned = 0;
  VectorField position, velocity, force; ///< force: internal force, N
  VectorField initial_position;
  std::vector<double> mass;    ///< lumped, constant: density times initial volume
  std::vector<double> volume;  ///< initial volume
  std::vector<double> spacing; ///< initial edge h of the nodal cell, m
  std::vector<Mat3> reference; ///< deformation gradient F at the last refresh of the shape functions
  std::vector<Mat3> relative;  ///< deformation since then; F now = relative * reference
  std::vector<Sym3> stress;    ///< Cauchy stress, tension positive, Pa
  /// Initial surfaces of the point's cell, bits of Face.
  std::vector<std::uint8_t> faces;
  /// Distance from the outermost points to the surface, in spacings; 0.5 with whole cells.
  double surface_offset = 0.5;

  const Sym3& cauchy(std::size_t i) const { return stress[i]; }
  Mat3 deformation(std::size_t i) const { return multiply(relative[i], reference[i]); }
  /// Distance from a point to the face of its cell against a unit vector, m: half of the present extent of
  /// the cell, or nothing for a point that lies on the surface of its body.
  double distance_to_face(std::size_t i, const Vec3& normal) const {
    if (surface_offset == 0 && faces[i] != 0) return 0;
    return 0.5 * cell_extent(spacing[i] * deformation(i), normal, largest_cell_stretch * spacing[i]);
  }

  /// Area of the face of a point's cell across a unit vector, m^2: its present volume over its extent. A
  /// point on the surface of its body has the inner half of a cell.
  double face_area(std::size_t i, const Vec3& normal) const {
    const bool half = surface_offset == 0 && faces[i] != 0;
    const double extent = cell_extent(spacing[i] * deformation(i), normal, largest_cell_stretch * spacing[i]);
    return volume[i] * determinant(deformation(i)) / (half ? 0.5 * extent : extent);
  }

  std::size_t memory_bytes() const {
    return sizeof(double) * (mass.capacity() + volume.capacity() + spacing.capacity()) + faces.capacity() +
           sizeof(Mat3) * (reference.capacity() + relative.capacity()) + sizeof(Sym3) * stress.capacity() +
           4 * 3 * sizeof(double) * position.component[0].capacity();
  }

  /// Transfers the owned points. Ghosts are left out: they follow their owners.
  void transfer(Archive& archive) {
    archive("owned", owned);
    position.transfer(archive, "position", owned);
    velocity.transfer(archive, "velocity", owned);
    force.transfer(archive, "force", owned);
    initial_position.transfer(archive, "initial_position", owned);
    archive("mass", mass);
    archive("volume", volume);
    archive("spacing", spacing);
    archive("faces", faces);
    archive("reference", reference);
    archive("relative", relative);
    archive("stress", stress);
  }

  /// Makes room for n owned points at rest, undeformed, without ghosts.
  void resize(std::size_t n) {
    owned = n;
    for (VectorField* field : {&position, &velocity, &force, &initial_position}) field->resize(n);
    mass.resize(n);
    volume.resize(n);
    spacing.resize(n);
    faces.resize(n);
    reference.assign(n, identity3);
    relative.assign(n, identity3);
    stress.assign(n, Sym3{});
  }
};

} // namespace spall
