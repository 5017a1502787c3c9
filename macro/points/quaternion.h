#pragma once

#include "macro/points/points.h"

#include <cmath>
#include <numbers>

namespace spall {

/// Unit quaternion of a rotation.
struct Quaternion {
  double w = 1, x = 0, y = 0, z = 0;
};

/// The rotation b followed by the rotation a.
inline Quaternion operator*(const Quaternion& a, const Quaternion& b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

/// The rotation back.
inline Quaternion conjugate(const Quaternion& q) { return {q.w, -q.x, -q.y, -q.z}; }

/// Rotation by an angle, rad, about a coordinate axis.
inline Quaternion about_axis(int axis, double angle) {
  const double s = std::sin(0.5 * angle);
  return {std::cos(0.5 * angle), axis == 0 ? s : 0, axis == 1 ? s : 0, axis == 2 ? s : 0};
}

/// Normalises a quaternion, which removes the round-off of many products.
inline Quaternion normalized(const Quaternion& q) {
  const double f = 1 / std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {f * q.w, f * q.x, f * q.y, f * q.z};
}

/// The matrix of the rotation: its columns are the turned axes.
inline Mat3 matrix_of(const Quaternion& q) {
  const auto [w, x, y, z] = q;
  return {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
          2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
          2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
}

/// The vector along the axis of a rotation that is as long as its angle, at most pi, rad.
inline Vec3 rotation_vector(const Quaternion& q) {
  const Vec3 v = {q.x, q.y, q.z};
  const double sine = norm(v);
  if (!(sine > 0)) return {};
  const double angle = 2 * (q.w < 0 ? std::atan2(-sine, -q.w) : std::atan2(sine, q.w));
  return angle / sine * v;
}

/// The shortest rotation that turns the z axis into a unit vector.
inline Quaternion from_z_to(const Vec3& a) {
  if (!(a[2] > -1)) return about_axis(1, std::numbers::pi);
  return normalized({1 + a[2], -a[1], a[0], 0});
}

/// a + s b
inline Vec3 add(const Vec3& a, double s, const Vec3& b) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}

} // namespace spall
