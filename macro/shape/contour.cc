#include "macro/shape/contour.h"

#include <numbers>
#include <stdexcept>
#include <utility>

namespace spall {
namespace {

double distance(const ContourPoint& a, const ContourPoint& b) { return std::hypot(a.r - b.r, a.z - b.z); }

/// Sines below this are round-off: the joint is tangent.
constexpr double tangent_tolerance = 1e-9;

/// Sorts, and keeps one of places that differ by round-off only.
std::vector<double> distinct(std::vector<double> places) {
  if (places.empty()) return places;
  std::sort(places.begin(), places.end());
  const double tolerance = 1e-12 * (places.back() - places.front());
  std::vector<double> kept;
  for (const double z : places)
    if (kept.empty() || z - kept.back() > tolerance) kept.push_back(z);
  return kept;
}

} // namespace

ContourPiece ContourPiece::line(const ContourPoint& from, const ContourPoint& to) {
  ContourPiece p;
  p.start = from, p.end = to;
  const double length = spall::distance(from, to);
  p.tr = (to.r - from.r) / length, p.tz = (to.z - from.z) / length;
  p.section = from.r;
  p.slope = to.z != from.z ? (to.r - from.r) / (to.z - from.z) : 0;
  return p;
}

ContourPiece ContourPiece::arc(const ContourPoint& from, const ContourPoint& to, const ContourPoint& centre,
                               double radius) {
  ContourPiece p;
  p.start = from, p.end = to, p.centre = centre, p.radius = radius;
  const double clockwise = (from.z - centre.z) * (to.r - centre.r) - (from.r - centre.r) * (to.z - centre.z);
  p.side = clockwise > 0 ? 1 : -1;
  p.to_start = {p.side * (from.z - centre.z), p.side * (from.r - centre.r)};
  p.to_end = {p.side * (to.z - centre.z), p.side * (to.r - centre.r)};
  return p;
}

bool ContourPiece::is_steep_at(const ContourPoint& p) const {
  return !is_line() && std::abs(std::abs(p.z - centre.z) - radius) < 1e-6 * radius &&
         std::abs(centre.r) > tangent_tolerance * radius;
}

ContourPoint ContourPiece::tangent(const ContourPoint& p) const {
  if (is_line()) return {tz, tr};
  return {-side * (p.r - centre.r) / radius, side * (p.z - centre.z) / radius};
}

double ContourPiece::turning_angle() const {
  if (is_line()) return 0;
  const double ar = start.r - centre.r, az = start.z - centre.z, br = end.r - centre.r, bz = end.z - centre.z;
  return std::atan2(std::abs(az * br - ar * bz), ar * br + az * bz);
}

double ContourPiece::length() const {
  return is_line() ? spall::distance(start, end) : radius * turning_angle();
}

ContourPoint ContourPiece::at(double part) const {
  if (part <= 0) return start;
  if (part >= 1) return end;
  if (is_line()) return {start.z + part * (end.z - start.z), start.r + part * (end.r - start.r)};
  const double angle = -side * part * turning_angle(), c = std::cos(angle), s = std::sin(angle);
  const double ar = start.r - centre.r, az = start.z - centre.z;
  return {centre.z + s * ar + c * az, centre.r + c * ar - s * az};
}

Contour::Corner Contour::corner(const ContourPoint& at, const ContourPoint& arriving,
                                const ContourPoint& leaving) {
  Corner c{.at = at};
  c.turn = arriving.z * leaving.r - arriving.r * leaving.z;
  if (std::abs(c.turn) < tangent_tolerance) c.turn = 0;
  // The outward normal of a tangent (tr, tz) is (-tz, tr).
  const double nr = -arriving.z - leaving.z, nz = arriving.r + leaving.r, n = std::hypot(nr, nz);
  c.nr = n > tangent_tolerance ? nr / n : -leaving.z;
  c.nz = n > tangent_tolerance ? nz / n : leaving.r;
  return c;
}

Contour::Contour(std::vector<ContourPiece> pieces_) : pieces(std::move(pieces_)) {
  if (pieces.empty() || pieces.front().from().r != 0 || pieces.back().to().r != 0)
    throw std::invalid_argument("the contour does not begin and end on the axis");
  // At the axis the contour goes on as its own mirror image.
  const auto mirrored = [](const ContourPoint& tangent) { return ContourPoint{-tangent.z, tangent.r}; };
  ContourPoint arriving = mirrored(pieces.front().start_tangent());
  top = bottom = pieces.front().from().z;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    ContourPiece& piece = pieces[k];
    corners.push_back(corner(piece.from(), arriving, piece.start_tangent()));
    const bool along_axis = piece.is_line() && piece.from().r == piece.to().r;
    if (k > 0 && along_axis && corners.back().turn == 0 && !pieces[k - 1].is_line())
      piece.continue_section(pieces[k - 1]);
    arriving = piece.end_tangent();
    widest = std::max(widest, piece.extent(1, 0));
    top = std::max(top, piece.extent(0, 1));
    bottom = std::min(bottom, -piece.extent(0, -1));
  }
  corners.push_back(corner(pieces.back().to(), arriving, mirrored(arriving)));
}

std::vector<double> Contour::kinks() const {
  const double sharp = std::sin(10 * std::numbers::pi / 180);
  std::vector<double> places = {bottom, top};
  for (std::size_t k = 0; k + 1 < pieces.size(); ++k)
    if (!pieces[k].is_line() || !pieces[k + 1].is_line() || std::abs(corners[k + 1].turn) > sharp)
      places.push_back(pieces[k].to().z);
  return distinct(places);
}

std::vector<double> Contour::breaks() const {
  std::vector<double> places = {bottom, top};
  for (const ContourPiece& piece : pieces) {
    places.push_back(piece.from().z), places.push_back(piece.to().z);
    for (const ContourPoint* p : {&piece.from(), &piece.to()}) {
      if (!piece.is_steep_at(*p)) continue;
      double away = (p == &piece.from() ? piece.to() : piece.from()).z - p->z;
      for (int n = 0; n < 12; ++n) places.push_back(p->z + (away *= 0.25));
    }
  }
  return distinct(places);
}

std::vector<ContourPoint> Contour::outline(double step) const {
  constexpr double angle = 3 * std::numbers::pi / 180;
  std::vector<ContourPoint> points;
  for (const ContourPiece& piece : pieces) {
    const int n = 1 + static_cast<int>(std::max(piece.turning_angle() / angle, piece.length() / step));
    for (int i = 0; i < n; ++i) points.push_back(piece.at(static_cast<double>(i) / n));
  }
  if (!pieces.empty()) points.push_back(pieces.back().to());
  return points;
}

std::vector<Vec3> turned(const std::vector<ContourPoint>& outline, double spacing) {
  std::vector<Vec3> samples;
  const auto add_ring = [&](double z, double r) {
    const int around = r > 0 ? 4 * segments(0.5 * std::numbers::pi * r, spacing) : 1;
    for (int j = 0; j < around; ++j) {
      const double angle = 2 * std::numbers::pi * j / around;
      samples.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
  };
  for (std::size_t k = 0; k + 1 < outline.size(); ++k) {
    const ContourPoint a = outline[k], b = outline[k + 1];
    const int n = segments(std::hypot(b.z - a.z, b.r - a.r), spacing);
    for (int i = 0; i < n; ++i) add_ring(a.z + (b.z - a.z) * i / n, a.r + (b.r - a.r) * i / n);
  }
  if (!outline.empty()) add_ring(outline.back().z, outline.back().r);
  return samples;
}

ContourBuilder& ContourBuilder::line_to(const ContourPoint& there) {
  const double size = std::abs(there.r) + std::abs(there.z) + std::abs(here.r) + std::abs(here.z);
  if (distance(here, there) > 1e-14 * size) pieces.push_back(ContourPiece::line(here, there));
  here = there;
  return *this;
}

ContourBuilder& ContourBuilder::arc_to(const ContourPoint& there, const ContourPoint& centre, double radius) {
  pieces.push_back(ContourPiece::arc(here, there, centre, radius));
  here = there;
  return *this;
}

} // namespace spall
