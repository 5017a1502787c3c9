#include "macro/output/fragments.h"

#include "shared/input/quantity.h"
#include "shared/output_directory.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>

namespace spall {
namespace {

/// Mirror images of the modelled part, as bits: the axes whose sign changes. Two in succession: a ^ b.
using Mirror = std::uint8_t;

/// Clusters of points of the whole body, found among the modelled ones: each point belongs to its cluster
/// with a mirror image, and a cluster that meets its own image is the same as it.
class Clusters {
public:
  explicit Clusters(std::size_t points) : parent(points), image(points, 0), own(points, 1) {
    std::iota(parent.begin(), parent.end(), 0u);
  }

  struct Place {
    std::uint32_t root;
    Mirror image; ///< of the point that belongs to the root's cluster
  };
  Place find(std::uint32_t i) {
    Place p{i, 0};
    while (parent[p.root] != p.root) {
      // Halves the path: the next jump goes two steps.
      const std::uint32_t next = parent[p.root];
      image[p.root] ^= image[next];
      parent[p.root] = parent[next];
      p.image ^= image[p.root];
      p.root = parent[p.root];
    }
    return p;
  }

  /// Point i and the mirror image m of point j are connected.
  void connect(std::uint32_t i, std::uint32_t j, Mirror m) {
    Place a = find(i), b = find(j);
    const Mirror between = a.image ^ b.image ^ m;
    if (a.root == b.root) {
      if (between != 0) own[a.root] = product(own[a.root], 1u | 1u << between);
      return;
    }
    if (b.root < a.root) std::swap(a, b);
    parent[b.root] = a.root;
    image[b.root] = between;
    own[a.root] = product(own[a.root], own[b.root]);
  }

  /// Set of the images that are the same cluster, bit per image.
  std::uint8_t same(std::uint32_t root) const { return own[root]; }

private:
  static std::uint8_t product(std::uint8_t a, std::uint8_t b) {
    unsigned result = 0;
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 8; ++j)
        if ((a >> i & 1) && (b >> j & 1)) result |= 1u << (i ^ j);
    return static_cast<std::uint8_t>(result);
  }
  std::vector<std::uint32_t> parent;
  std::vector<Mirror> image;     ///< of the point with respect to its parent
  std::vector<std::uint8_t> own; ///< of the roots
};

std::vector<double> field_or_zero(const Solid& solid, const std::string& name) {
  const auto names = solid.field_names();
  if (std::find(names.begin(), names.end(), name) == names.end())
    return std::vector<double>(solid.points.owned, 0.0);
  return solid.field(name);
}

Mirror mirror_of(const Solid& solid, std::uint32_t i) {
  if (solid.ghosts.symmetry().multiplicity() == 1) return 0;
  const Vec3 sign = solid.ghosts.mirror(solid.points, i, {1, 1, 1});
  Mirror m = 0;
  for (int c = 0; c < 3; ++c)
    if (sign[c] < 0) m |= static_cast<Mirror>(1 << c);
  return m;
}

/// Rotation of the polar decomposition F = R U: Newton's iteration R <- (R + R^-T) / 2 (Higham 1986), which
/// doubles the digits from any F with a positive determinant.
Mat3 rotation_of(const Mat3& deformation) {
  Mat3 r = deformation;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Mat3 other = transpose(inverse(r));
    double change = 0;
    for (int c = 0; c < 9; ++c) {
      const double mean = 0.5 * (r[c] + other[c]);
      change = std::max(change, std::abs(mean - r[c]));
      r[c] = mean;
    }
    if (change < 1e-6) break;
  }
  return r;
}

/// How far point j (owned or image) has moved against point i since the start, beyond the rotation of i, m.
double slip(const Solid& solid, std::uint32_t i, std::uint32_t j, const Mat3& rotation) {
  const Points& points = solid.points;
  const Vec3 to = solid.ghosts.mirror(points, j, points.initial_position[solid.ghosts.owner(points, j)]),
             from = points.initial_position[i];
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    double moved = points.position.component[c][j] - points.position.component[c][i];
    for (int d = 0; d < 3; ++d) moved -= rotation[3 * c + d] * (to[d] - from[d]);
    sum += moved * moved;
  }
  return std::sqrt(sum);
}

Clusters connected_points(const Solid& solid, const FragmentInputs& inputs) {
  const Points& points = solid.points;
  const NeighborLists lists = solid.neighbor_lists();
  Clusters clusters(points.owned);
  if (lists.index.empty()) {
    for (std::uint32_t i = 1; i < points.owned; ++i) clusters.connect(0, i, 0);
    for (int c = 0; c < 3; ++c)
      if (solid.ghosts.symmetry().normal[c]) clusters.connect(0, 0, static_cast<Mirror>(1 << c));
    return clusters;
  }
  for (std::uint32_t i = 0; i < points.owned; ++i) {
    const Mat3 rotation = rotation_of(points.deformation(i));
    for (std::uint32_t p = lists.start[i]; p < lists.start[i + 1]; ++p) {
      const std::uint32_t j = lists.index[p], owner = solid.ghosts.owner(points, j);
      const double spacing = 0.5 * (points.spacing[i] + points.spacing[owner]);
      if (j != i && slip(solid, i, j, rotation) < inputs.gap * spacing)
        clusters.connect(i, owner, mirror_of(solid, j));
    }
  }
  return clusters;
}

/// Adds a point to the sums that are to become means.
void add(Fragment& f, const Points& points, std::size_t i, Mirror image, double shear, double tensile) {
  const double mass = points.mass[i];
  const Vec3 x = points.position[i], v = points.velocity[i];
  f.points += 1;
  f.mass += mass;
  f.size += points.volume[i];
  for (int c = 0; c < 3; ++c) {
    const double sign = image >> c & 1 ? -mass : mass;
    f.centre[c] += sign * x[c], f.velocity[c] += sign * v[c];
  }
  f.kinetic_energy += 0.5 * mass * dot(v, v);
  f.shear_damage += mass * shear, f.tensile_damage += mass * tensile;
}

/// Means from sums, and one whole fragment from its modelled part. same: images that are the same fragment.
/// With rotational symmetry a point is a ring: its centre is on the axis.
void finish(Fragment& f, std::uint8_t same, const SymmetryPlanes& planes) {
  for (Vec3* a : {&f.centre, &f.velocity})
    for (double& x : *a) x /= f.mass;
  f.shear_damage /= f.mass, f.tensile_damage /= f.mass;
  const double parts = std::popcount(same);
  f.copies = planes.multiplicity() / parts;
  f.points *= parts, f.mass *= parts, f.kinetic_energy *= parts;
  f.size = std::cbrt(6 * parts * f.size / std::numbers::pi);
  for (int c = 0; c < 3; ++c) {
    bool across = false;
    for (int m = 0; m < 8; ++m) across = across || ((same >> m & 1) && (m >> c & 1));
    if (across || (planes.axis && c < 2)) f.centre[c] = f.velocity[c] = 0;
    if (planes.normal[c] && f.centre[c] < 0) f.centre[c] *= -1, f.velocity[c] *= -1;
  }
}

/// How far a fragment reaches along z, cells included.
struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

FragmentPlace place_of(const Fragment& f, const Extent& extent, double height) {
  if (f.velocity[2] > 0 && extent.high > height) return FragmentPlace::debris;
  if (f.velocity[2] < 0 && extent.low < 0) return FragmentPlace::ejecta;
  return FragmentPlace::loose;
}

} // namespace

void FragmentInputs::declare(Parameters& parameters) {
  auto output = parameters.section("Output");
  output.number(
      "Fragment gap", gap, {1e-3, 2},
      "spacings that interacting points may have moved against each other since the start, rotation "
      "aside, and still hold together: pieces that no chain of such points joins are fragments");
}

const char* name_of(FragmentPlace place) {
  constexpr std::array<const char*, 4> names = {"remainder", "debris", "ejecta", "loose"};
  return names[static_cast<std::size_t>(place)];
}

Fragments find_fragments(const Solid& solid, const FragmentInputs& inputs, double height) {
  const Points& points = solid.points;
  const std::vector<double> shear = field_or_zero(solid, "shear_damage"),
                            tensile = field_or_zero(solid, "tensile_damage");
  Clusters clusters = connected_points(solid, inputs);
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(points.owned, none), roots;
  Fragments found;
  found.of_point.resize(points.owned);
  std::vector<Extent> extents;
  for (std::uint32_t i = 0; i < points.owned; ++i) {
    const auto [root, image] = clusters.find(i);
    if (number[root] == none) {
      number[root] = static_cast<std::uint32_t>(roots.size());
      roots.push_back(root);
      found.list.emplace_back();
      extents.emplace_back();
    }
    const std::uint32_t f = found.of_point[i] = number[root];
    add(found.list[f], points, i, image, shear[i], tensile[i]);
    const double z = points.position.component[2][i], half = 0.5 * points.spacing[i];
    extents[f].low = std::min(extents[f].low, z - half),
    extents[f].high = std::max(extents[f].high, z + half);
  }
  for (std::size_t f = 0; f < roots.size(); ++f) {
    finish(found.list[f], clusters.same(roots[f]), solid.ghosts.symmetry());
    found.list[f].place = place_of(found.list[f], extents[f], height);
  }
  std::vector<std::uint32_t> order(roots.size()), rank(roots.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return found.list[a].mass > found.list[b].mass; });
  std::vector<Fragment> sorted;
  for (const std::uint32_t f : order) {
    rank[f] = static_cast<std::uint32_t>(sorted.size());
    sorted.push_back(found.list[f]);
  }
  sorted.front().place = FragmentPlace::remainder;
  for (std::uint32_t& f : found.of_point) f = rank[f];
  found.list = std::move(sorted);
  return found;
}

FragmentSums sum_of(const Fragments& fragments, FragmentPlace place) {
  FragmentSums sum;
  for (const Fragment& f : fragments.list) {
    if (f.place != place) continue;
    sum.count += f.copies;
    if (f.points == 1) sum.lone += f.copies;
    sum.mass += f.copies * f.mass;
    sum.momentum += f.copies * f.mass * f.velocity[2];
    sum.kinetic_energy += f.copies * f.kinetic_energy;
    sum.heaviest = std::max(sum.heaviest, f.mass);
  }
  return sum;
}

void write_fragments(const std::filesystem::path& file, const Fragments& fragments) {
  std::string text = "id,place,copies,points,mass,size,x,y,z,velocity_x,velocity_y,velocity_z,kinetic_energy,"
                     "shear_damage,tensile_damage\n";
  for (std::size_t i = 0; i < fragments.list.size(); ++i) {
    const Fragment& f = fragments.list[i];
    text += std::to_string(i) + "," + name_of(f.place);
    for (const double value :
         {f.copies, f.points, f.mass, f.size, f.centre[0], f.centre[1], f.centre[2], f.velocity[0],
          f.velocity[1], f.velocity[2], f.kinetic_energy, f.shear_damage, f.tensile_damage})
      text += "," + format_quantity(value, Dimension::none);
    text += "\n";
  }
  write_atomically(file, text);
}

void add_fragments(Summary& summary, const Fragments& fragments, const Solid& solid) {
  double count = 0, lone = 0, points = 0;
  for (const Fragment& f : fragments.list) {
    if (f.place != FragmentPlace::remainder) count += f.copies;
    if (f.points == 1) lone += f.copies;
    if (std::isfinite(dot(f.centre, f.centre) + f.kinetic_energy)) points += f.copies * f.points;
  }
  summary.set("fragments", count);
  summary.set("lone_points", lone);
  summary.set("lost_points",
              static_cast<double>(solid.points.owned) * solid.ghosts.symmetry().multiplicity() - points);
  for (const FragmentPlace place :
       {FragmentPlace::remainder, FragmentPlace::debris, FragmentPlace::ejecta, FragmentPlace::loose}) {
    const FragmentSums sum = sum_of(fragments, place);
    const std::string name = name_of(place);
    if (place != FragmentPlace::remainder) {
      summary.set(name + "_fragments", sum.count);
      summary.set(name + "_heaviest", sum.heaviest);
    }
    summary.set(name + "_mass", sum.mass);
    summary.set(name + "_momentum", sum.momentum);
    summary.set(name + "_kinetic_energy", sum.kinetic_energy);
  }
}

} // namespace spall
