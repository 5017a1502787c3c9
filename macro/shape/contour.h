#pragma once

#include "macro/shape/mass_properties.h"
#include "macro/shape/surface_point.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace spall {

/// A place in the half plane through the axis of a body of revolution.
struct ContourPoint {
  double z = 0, r = 0; ///< along the axis and off it, m
};

/// A straight line or a circular arc (less than half a turn) of a contour.
class ContourPiece {
public:
  /// Where the foot of the perpendicular from a point lies: before the start of the piece, on the piece, or
  /// after its end. A line owns both of its ends, an arc its start only, so that a tangent joint from an arc
  /// to a line belongs to the line.
  enum class Foot { before, on_piece, after };
  /// Signed distance in the half plane and its normal.
  struct Distance {
    double distance, nr, nz;
  };

  static ContourPiece line(const ContourPoint& from, const ContourPoint& to);
  /// @param radius of the arc, m. An arc that runs clockwise (z upwards, r to the right) is convex.
  static ContourPiece arc(const ContourPoint& from, const ContourPoint& to, const ContourPoint& centre,
                          double radius);

  Foot foot(double r, double z) const {
    if (is_line()) {
      if (tr * (r - start.r) + tz * (z - start.z) < 0) return Foot::before;
      return tr * (r - end.r) + tz * (z - end.z) > 0 ? Foot::after : Foot::on_piece;
    }
    return foot_of_direction(r - centre.r, z - centre.z);
  }
  /// Signed distance from the endless line that holds the piece, m.
  double offset(double r, double z) const { return -tz * (r - start.r) + tr * (z - start.z); }
  /// Distance of a point whose foot is on the piece.
  Distance distance(double r, double z) const {
    if (is_line()) return {offset(r, z), -tz, tr};
    const double dr = r - centre.r, dz = z - centre.z, d = std::sqrt(dr * dr + dz * dz);
    if (!(d > 0)) return {-side * radius, side, 0}; // every direction is normal to the arc
    return side > 0 ? Distance{d - radius, dr / d, dz / d} : Distance{radius - d, -dr / d, -dz / d};
  }

  /// Radius of the section at z, between the ends of the piece, m.
  double section_radius(double z) const {
    if (is_line()) return section + slope * (z - start.z);
    const double dz = z - centre.z;
    return centre.r + side * std::sqrt(std::max(0.0, radius * radius - dz * dz));
  }
  /// Largest r nr + z nz of the piece for a unit normal (nr >= 0, nz), m.
  double extent(double nr, double nz) const {
    const double ends = std::max(start.r * nr + start.z * nz, end.r * nr + end.z * nz);
    const bool bulges = !is_line() && side > 0 && foot_of_direction(nr, nz) == Foot::on_piece;
    return bulges ? std::max(ends, radius + centre.r * nr + centre.z * nz) : ends;
  }

  bool is_line() const { return radius == 0; }
  const ContourPoint& from() const { return start; }
  const ContourPoint& to() const { return end; }
  double arc_radius() const { return radius; } ///< m; 0: a line
  bool has_section_at(double z) const {
    return start.z != end.z && z >= std::min(start.z, end.z) && z <= std::max(start.z, end.z);
  }
  /// Whether the section radius of an arc off the axis changes infinitely fast with z at one of its ends.
  bool is_steep_at(const ContourPoint& p) const;
  /// Unit tangents in the direction of the contour.
  ContourPoint start_tangent() const { return tangent(start); }
  ContourPoint end_tangent() const { return tangent(end); }
  /// Place at a part (0 to 1) of the way along the piece.
  ContourPoint at(double part) const;
  double turning_angle() const; ///< of an arc, rad; 0 for a line
  double length() const;        ///< m
  /// Makes the section radius of a line along the axis continue a tangent arc to the last bit.
  void continue_section(const ContourPiece& arc) { section = arc.section_radius(start.z); }

private:
  Foot foot_of_direction(double dr, double dz) const {
    const bool before = to_start.r * dz - to_start.z * dr > 0, after = !(to_end.r * dz - to_end.z * dr > 0);
    if (!before && !after) return Foot::on_piece;
    if (before && after) { // beyond the centre: the nearer end
      const double nearer_start = (start.r - end.r) * dr + (start.z - end.z) * dz;
      return nearer_start > 0 ? Foot::before : Foot::after;
    }
    return before ? Foot::before : Foot::after;
  }
  ContourPoint tangent(const ContourPoint& p) const;

  ContourPoint start, end;
  double tr = 0, tz = 0;         ///< line: unit tangent
  double section = 0, slope = 0; ///< line: section radius at its start, m, and its change with z
  ContourPoint centre;           ///< arc
  ContourPoint to_start, to_end; ///< arc: from the centre to its ends, times `side`, m
  double radius = 0, side = 1;   ///< arc: radius, m; 1 if the body is on the side of the centre, else -1
};

/// The contour of a solid body of revolution about z: pieces from the tip (largest z, on the axis) to the
/// tail (smallest z, on the axis), with the body on the right (z upwards, r to the right).
class Contour {
public:
  Contour() = default;
  /// @throws std::invalid_argument if the contour does not begin and end on the axis
  explicit Contour(std::vector<ContourPiece> pieces);

  /// Signed distance to the nearest place of the surface and its normal; exact inside and outside.
  SurfacePoint surface(const Vec3& x) const {
    const double r = from_axis(x);
    // A point on the axis has no radial direction; any will do.
    const double ux = r > 0 ? x[0] / r : 1, uy = r > 0 ? x[1] / r : 0;
    const ContourPiece::Distance d = nearest(r, x[2]);
    return {d.distance, {d.nr * ux, d.nr * uy, d.nz}};
  }
  /// Bound of the distance from below, cheap: for skipping points that are far away.
  double lower_bound(const Vec3& x) const {
    return std::max({from_axis(x) - widest, x[2] - top, bottom - x[2]});
  }
  /// Radius of the section at z, m; 0 beyond the ends. At a step the larger one.
  double section_radius(double z) const {
    double radius = 0;
    for (const ContourPiece& piece : pieces)
      if (piece.has_section_at(z)) radius = std::max(radius, piece.section_radius(z));
    return radius;
  }
  /// Largest projection of a point of the body on a unit vector of its frame, m.
  double extent(const Vec3& direction) const {
    const double across = from_axis(direction);
    double largest = -std::numeric_limits<double>::infinity();
    for (const ContourPiece& piece : pieces) largest = std::max(largest, piece.extent(across, direction[2]));
    return largest;
  }
  MassProperties mass_properties() const {
    return revolve([this](double z) { return section_radius(z); }, breaks());
  }

  double smallest_z() const { return bottom; }     ///< m
  double largest_z() const { return top; }         ///< m
  double largest_radius() const { return widest; } ///< m
  /// The places of z, ascending, from end to end, where the body changes its shape: a nose ends, a step. Two
  /// lines that meet at less than 10 degrees (of a table) do not count.
  std::vector<double> kinks() const;
  /// Ascending places of z between which the section radius is smooth enough for quadrature: where pieces
  /// meet, and more and more closely where an arc ends square to the axis.
  std::vector<double> breaks() const;
  /// The contour as a polyline, with steps of at most the length given, m.
  std::vector<ContourPoint> outline(double step = std::numeric_limits<double>::infinity()) const;
  const std::vector<ContourPiece>& all_pieces() const { return pieces; }

private:
  /// Where two pieces meet, or the contour meets the axis.
  struct Corner {
    ContourPoint at;
    double turn = 0;       ///< sine of the turn, 1 to -1: convex, 0 (tangent), concave
    double nr = 0, nz = 1; ///< mean of the two normals
  };
  static Corner corner(const ContourPoint& at, const ContourPoint& arriving, const ContourPoint& leaving);

  ContourPiece::Distance nearest(double r, double z) const {
    ContourPiece::Distance best{std::numeric_limits<double>::infinity(), 0, 1};
    // A corner is nearest where the foot is after the end of the one piece and before the start of the next.
    bool after = true;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const ContourPiece& piece = pieces[k];
      // Neither the line nor its ends can be nearer.
      if (piece.is_line() && std::abs(piece.offset(r, z)) > std::abs(best.distance)) {
        after = false;
        continue;
      }
      const ContourPiece::Foot foot = piece.foot(r, z);
      if (foot == ContourPiece::Foot::on_piece) {
        const ContourPiece::Distance d = piece.distance(r, z);
        if (std::abs(d.distance) <= std::abs(best.distance)) best = d;
        // For a line that goes on from here along the tangent this place lies before its start.
        if (corners[k + 1].turn == 0 && k + 1 < pieces.size() && pieces[k + 1].is_line()) ++k;
      } else if (after && foot == ContourPiece::Foot::before) {
        take_corner(best, corners[k], r, z);
      }
      after = foot == ContourPiece::Foot::after;
    }
    if (after && !pieces.empty()) take_corner(best, corners.back(), r, z);
    return best;
  }
  static void take_corner(ContourPiece::Distance& best, const Corner& corner, double r, double z) {
    const double dr = r - corner.at.r, dz = z - corner.at.z, d = std::sqrt(dr * dr + dz * dz);
    if (!(d < std::abs(best.distance))) return;
    const bool outside = corner.turn > 0 || (corner.turn == 0 && dr * corner.nr + dz * corner.nz >= 0);
    if (!(d > 0))
      best = {0, corner.nr, corner.nz};
    else if (outside)
      best = {d, dr / d, dz / d};
    else
      best = {-d, -dr / d, -dz / d};
  }

  std::vector<ContourPiece> pieces;
  std::vector<Corner> corners; ///< before every piece, and after the last one
  double top = 0, bottom = 0, widest = 0;
};

/// Number of equal parts of a length that are at most `spacing` long.
inline int segments(double length, double spacing) {
  return std::max(1, static_cast<int>(std::ceil(length / spacing)));
}
/// Points on the surface that an outline makes when it is turned about z, at most about `spacing` apart.
std::vector<Vec3> turned(const std::vector<ContourPoint>& outline, double spacing);

/// Puts a contour together, from the tip to the tail.
class ContourBuilder {
public:
  explicit ContourBuilder(const ContourPoint& tip) : here(tip) {}
  /// Lines without length are left out.
  ContourBuilder& line_to(const ContourPoint& there);
  ContourBuilder& arc_to(const ContourPoint& there, const ContourPoint& centre, double radius);
  /// @throws std::invalid_argument if the contour does not begin and end on the axis
  Contour contour() const { return Contour(pieces); }

private:
  ContourPoint here;
  std::vector<ContourPiece> pieces;
};

} // namespace spall
