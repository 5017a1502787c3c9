#include "macro/points/parallel.h"
#include "macro/shape/cells.h"

#include <map>
#include <stdexcept>

namespace spall {
namespace {

/// How often a cell that the surface cuts is halved along each axis. Parts of a quarter of the cell are cut
/// by planes, which leaves an error of about 1/100 of the cell where the surface is curved on the scale of
/// the cell.
constexpr int halvings = 2;

/// Largest and smallest factor between the volume of the body and that of its cells.
constexpr double largest_factor = 2;

/// Returns the part of a cube that is inside a surface.
/// @param half of its edges, m, @param halve how often it may be halved
double part_inside(const ClosedSurface& surface, const Vec3& centre, const Vec3& half, int halve) {
  const double distance = surface.surface(centre).distance, reach = norm(half);
  if (std::abs(distance) >= reach) return distance < 0 ? 1 : 0;
  if (halve == 0) return std::clamp(0.5 - 0.5 * distance / (reach / std::sqrt(3)), 0.0, 1.0);
  double sum = 0;
  for (int k = 0; k < 8; ++k) {
    Vec3 part = centre;
    for (int c = 0; c < 3; ++c) part[c] += ((k >> c & 1) - 0.5) * half[c];
    sum += part_inside(surface, part, 0.5 * half, halve - 1);
  }
  return sum / 8;
}

/// The lattice of the box around a surface.
struct Lattice {
  const ClosedSurface& surface;
  std::array<Division, 3> along;
  std::vector<double> part = {}; ///< of each cell: what is inside, 0 where the centre is outside

  Lattice(const ClosedSurface& surface_, const Filling& filling)
      : surface(surface_), along{divide_evenly(size(0), filling), divide_evenly(size(1), filling),
                                 divide(size(2), nearest_count(size(2), filling.spacing), filling.boundary)},
        part(along[0].size() * along[1].size() * along[2].size()) {
    const Vec3 half = 0.5 * cell();
    for_each_index(part.size(), [&](std::size_t n) {
      const Vec3 x = centre(n);
      if (surface.surface(x).distance < 0) part[n] = part_inside(surface, x, half, halvings);
    });
  }
  double size(int c) const { return surface.high()[c] - surface.low()[c]; }
  Vec3 cell() const { return {along[0].width[0], along[1].width[0], along[2].width[0]}; }
  std::array<std::size_t, 3> place(std::size_t n) const {
    const std::size_t nx = along[0].size(), ny = along[1].size();
    return {n % nx, n / nx % ny, n / (nx * ny)};
  }
  Vec3 centre(std::size_t n) const {
    const std::array<std::size_t, 3> i = place(n);
    Vec3 x = surface.low();
    for (int c = 0; c < 3; ++c) x[c] += along[c].position[i[c]];
    return x;
  }
  /// Whether the neighbour of a cell along axis c is no point of the body.
  bool ends(std::size_t n, int c, bool up) const {
    const std::size_t i = place(n)[c];
    if (i == (up ? along[c].size() - 1 : 0)) return true;
    const std::size_t stride = c == 0 ? 1 : c == 1 ? along[0].size() : along[0].size() * along[1].size();
    return part[up ? n + stride : n - stride] == 0;
  }
  std::uint8_t faces(std::size_t n) const {
    const bool side = ends(n, 0, false) || ends(n, 0, true) || ends(n, 1, false) || ends(n, 1, true);
    return static_cast<std::uint8_t>((ends(n, 2, false) ? low_face : 0) | (ends(n, 2, true) ? high_face : 0) |
                                     (side ? rim_face : 0));
  }
};

} // namespace

Points fill_surface(const ClosedSurface& surface, const Filling& filling, const SymmetryPlanes& planes,
                    double density) {
  if (planes.axis) throw std::invalid_argument("a surface of triangles has no rotational symmetry");
  const Lattice lattice(surface, filling);
  const Vec3 cell = lattice.cell();
  const double whole = cell[0] * cell[1] * cell[2];
  std::vector<Vec3> positions;
  std::vector<Cell> cells;
  double full = 0, cut = 0; // m^3
  for (std::size_t n = 0; n < lattice.part.size(); ++n) {
    const Vec3 x = lattice.centre(n);
    const double part = lattice.part[n];
    if (part == 0 || !is_modelled(planes, x[0], x[1])) continue;
    positions.push_back(x);
    cells.push_back({.volume = part * whole, .spacing = std::cbrt(whole), .faces = lattice.faces(n)});
    (part < 1 ? cut : full) += part * whole;
  }
  const double rest = surface.mass_properties().volume / planes.multiplicity() - full;
  const double factor = cut > 0 ? rest / cut : 1;
  if (cells.empty() || !(factor < largest_factor && factor > 1 / largest_factor))
    throw std::invalid_argument(
        "the spacing is too coarse for the surface: cells with their centre inside hold " +
        std::to_string(static_cast<int>(std::lround(100 * (full + cut) / (rest + full)))) +
        " % of its volume");
  for (Cell& c : cells)
    if (c.volume < whole) c.volume *= factor;
  return points_of(positions, cells, density, 0.5);
}

} // namespace spall
