#include "micro/cell/crack_lines.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>

namespace spall {
namespace {

constexpr int largest_denominator = 4; ///< largest denominator of the tangent of an aligned crack's angle
/// Largest angle of a joined crack, degrees, because elements are sheared with the crack.
constexpr double steepest_angle = 75;
/// Smallest ligament between tips of one line, as a fraction of the edge.
constexpr double smallest_ligament = 0.005;
/// Largest vertical shift of random cracks, in units of the distance between lines.
constexpr double vertical_scatter = 0.2;
constexpr double closest_lines = 0.15; ///< smallest distance between lines, in units of their mean distance

/// Returns a number uniform in [-1, 1], the same on every machine, unlike std::uniform_real_distribution.
double uniform(std::mt19937& random) { return random() * (2.0 / 4294967295.0) - 1; }

[[noreturn]] void refuse(const char* format, double a, double b = 0) {
  char text[200];
  std::snprintf(text, sizeof text, format, a, b);
  throw std::invalid_argument(text);
}

/// Makes straight lines at one angle: a line with the slope p / q closes on itself after q passes through the
/// cell.
CrackLines aligned(const CellGeometry& g) {
  const double tangent = std::tan(g.angle * std::numbers::pi / 180);
  int p = 0, q = 1;
  for (; q <= largest_denominator; ++q)
    if (p = static_cast<int>(std::lround(tangent * q)); std::abs(tangent * q - p) < 1e-6) break;
  if (q > largest_denominator)
    refuse(
        "angle %g degrees with aligned ligaments: allowed are angles whose tangent is p / q with q up to 4 "
        "(14.0362, 18.4349, 26.5651, 33.6901, 36.8699, 45, 63.4349, ... degrees)",
        g.angle);
  const double half = 0.5 * g.crack_ratio * std::cos(std::atan(tangent));
  CrackLines result{.lines = {}, .rise = static_cast<double>(p) / q};
  for (int k = 0; k < q; ++k) {
    const double start = (k + 0.5) / q;
    CrackLine line;
    const auto knot = [&](double x) { line.knots.push_back({x, start + result.rise * x}); };
    knot(0);
    if (k == q / 2 && half > 0) {
      knot(0.5 - half);
      knot(0.5 + half);
      line.open = {false, true};
    }
    knot(1);
    line.open.push_back(false);
    result.lines.push_back(line);
  }
  return result;
}

struct Crack {
  double x, y, half_width, half_rise;
};

CrackLine join(const std::vector<Crack>& cracks) {
  CrackLine line;
  if (cracks.empty() || cracks.front().half_width == 0) {
    const double y = cracks.front().y;
    return {.knots = {{0, y}, {1, y}}, .open = {false}};
  }
  const Crack &first = cracks.front(), &last = cracks.back();
  const CrackLine::Knot in{first.x - first.half_width, first.y - first.half_rise},
      out{last.x + last.half_width, last.y + last.half_rise};
  // The ligament from the last crack to the periodic image of the first one crosses the edge at this height.
  const double share = (1 - out.x) / (in.x + 1 - out.x);
  const double edge = out.y + share * (in.y - out.y);
  line.knots.push_back({0, edge});
  for (const Crack& crack : cracks) {
    line.knots.push_back({crack.x - crack.half_width, crack.y - crack.half_rise});
    line.knots.push_back({crack.x + crack.half_width, crack.y + crack.half_rise});
    line.open.push_back(false);
    line.open.push_back(true);
  }
  line.knots.push_back({1, edge});
  line.open.push_back(false);
  return line;
}

CrackLines joined(const CellGeometry& g) {
  std::mt19937 random(static_cast<std::uint32_t>(g.random.seed));
  CrackLines result;
  const double share = 1.0 / g.cracks_per_line, distance = 1.0 / g.lines;
  for (int k = 0; k < g.lines; ++k) {
    std::vector<Crack> cracks;
    for (int j = 0; j < g.cracks_per_line; ++j) {
      const double length = g.crack_ratio * (1 + g.random.length * uniform(random));
      const double angle = g.angle + g.random.angle * uniform(random);
      if (std::abs(angle) > steepest_angle)
        refuse("a crack at %g degrees: allowed up to %g", angle, steepest_angle);
      const double radians = angle * std::numbers::pi / 180;
      Crack crack{.x = (j + 0.5) * share + g.offset_x,
                  .y = (k + 0.5) * distance + g.offset_y,
                  .half_width = 0.5 * length * std::cos(radians),
                  .half_rise = 0.5 * length * std::sin(radians)};
      const double room = 0.5 * (share - smallest_ligament) - crack.half_width;
      if (room < 0) refuse("cracks of length %g do not fit on their line: allowed at most %g", length, share);
      crack.x += g.random.position * room * uniform(random);
      crack.y += g.random.position * vertical_scatter * distance * uniform(random);
      if (crack.half_width > 0 && (crack.x - crack.half_width < 0.25 * smallest_ligament ||
                                   crack.x + crack.half_width > 1 - 0.25 * smallest_ligament))
        refuse("a crack of length %g at x = %g leaves the cell", length, crack.x);
      cracks.push_back(crack);
    }
    result.lines.push_back(join(cracks));
  }
  return result;
}

/// Checks that lines do not cross, and that they keep a distance from each other and from the images above
/// and below.
void check_distance(const CrackLines& set) {
  const double least = closest_lines / static_cast<double>(set.lines.size());
  for (std::size_t k = 0; k < set.lines.size(); ++k) {
    const bool top = k + 1 == set.lines.size();
    const CrackLine &line = set.lines[k], &above = set.lines[top ? 0 : k + 1];
    for (const CrackLine* knots : {&line, &above})
      for (const auto& [x, y] : knots->knots) {
        if (above.y(x) + (top ? 1 : 0) - line.y(x) < least)
          refuse("crack lines touch: %g of the edge apart, allowed at least %g",
                 above.y(x) + (top ? 1 : 0) - line.y(x), least);
        if (set.rise == 0 && (line.y(x) < 0.5 * least || line.y(x) > 1 - 0.5 * least))
          refuse("a crack line leaves the cell at height %g: allowed within %g of the edges", line.y(x),
                 0.5 * least);
      }
  }
}

} // namespace

const std::vector<std::pair<std::string, Ligament>>& ligament_words() {
  static const std::vector<std::pair<std::string, Ligament>> words = {{"joined", Ligament::joined},
                                                                      {"aligned", Ligament::aligned}};
  return words;
}

const std::vector<std::pair<std::string, CrackShape>>& shape_words() {
  static const std::vector<std::pair<std::string, CrackShape>> words = {{"through", CrackShape::through},
                                                                        {"penny", CrackShape::penny}};
  return words;
}

bool CellGeometry::is_single_centred() const {
  return vertical.count == 0 && offset_x == 0 && offset_y == 0 && angle == 0 && lines == 1 &&
         cracks_per_line == 1 && random.length == 0 && random.angle == 0 && random.position == 0;
}

double CrackLine::y(double x) const {
  std::size_t i = 1;
  while (i + 1 < knots.size() && knots[i].x < x) ++i;
  const Knot &a = knots[i - 1], &b = knots[i];
  return x == b.x ? b.y : a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
}

bool CrackLine::is_open(double x) const {
  std::size_t i = 1;
  while (i + 1 < knots.size() && knots[i].x < x) ++i;
  return open[i - 1];
}

CrackLines crack_lines(const CellGeometry& geometry) {
  CrackLines result =
      geometry.ligament == Ligament::aligned && geometry.angle != 0 ? aligned(geometry) : joined(geometry);
  check_distance(result);
  for (int k = 0; k < geometry.vertical.count; ++k)
    result.vertical.push_back((k + 0.5) / geometry.vertical.count);
  return result;
}

} // namespace spall
