#include "macro/output/fragments.h"

#include "macro/output/clusters.h"
#include "shared/input/quantity.h"
#include "shared/output_directory.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>
#include <unordered_map>

namespace spall {
namespace {

Mirror mirror_of(const Solid& solid, std::uint32_t i) {
  if (solid.ghosts.symmetry().multiplicity() == 1) return 0;
  const Vec3 sign = solid.ghosts.mirror(solid.points, i, {1, 1, 1});
  Mirror m = 0;
  for (int c = 0; c < 3; ++c)
    if (sign[c] < 0) m |= static_cast<Mirror>(1 << c);
  return m;
}

/// Returns the rotation R of the polar decomposition F = R U, by Newton's iteration R <- (R + R^-T) / 2
/// (Higham 1986), which converges quadratically from any F with a positive determinant.
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

/// The fields by which two points are compared, ghosts included.
struct Placed {
  VectorField now, initial; ///< present and initial positions, m
  VectorField spacing;      ///< spacing of each point in component 2, m

  explicit Placed(const Solid& solid) : now(solid.points.position), initial(solid.points.initial_position) {
    const Points& points = solid.points;
    spacing.component[2] = points.spacing;
    for (VectorField* field : {&now, &initial, &spacing}) field->resize(points.owned + solid.ghosts.size());
    solid.ghosts.refresh(points, {&now, &initial, &spacing});
  }
  /// Returns the displacement of point j (owned or ghost) relative to point i since the start, without the
  /// rotation of i, m.
  double slip(std::uint32_t i, std::uint32_t j, const Mat3& rotation) const {
    const Vec3 to = initial[j], from = initial[i];
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
      double moved = now.component[c][j] - now.component[c][i];
      for (int d = 0; d < 3; ++d) moved -= rotation[3 * c + d] * (to[d] - from[d]);
      sum += moved * moved;
    }
    return std::sqrt(sum);
  }
};

/// Finds the clusters of this rank's points and of the remote points that are connected to them.
Clusters connected_here(const Solid& solid, const NeighborLists& lists, const FragmentInputs& inputs) {
  const Points& points = solid.points;
  const Placed placed(solid);
  Clusters clusters(points.owned + solid.ghosts.size());
  for (std::uint32_t i = 0; i < points.owned; ++i) {
    const Mat3 rotation = rotation_of(points.deformation(i));
    for (std::uint32_t p = lists.start[i]; p < lists.start[i + 1]; ++p) {
      const std::uint32_t j = lists.index[p];
      const double spacing = 0.5 * (points.spacing[i] + std::abs(placed.spacing.component[2][j]));
      if (j != i && placed.slip(i, j, rotation) < inputs.gap * spacing)
        clusters.connect(i, solid.ghosts.owner(points, j), mirror_of(solid, j));
    }
  }
  return clusters;
}

/// Returns a single cluster: before the first step a body has no neighbour lists and is undamaged.
Clusters all_connected(const Solid& solid) {
  Clusters clusters(solid.points.owned);
  if (solid.points.owned == 0) return clusters;
  for (std::uint32_t i = 1; i < solid.points.owned; ++i) clusters.connect(0, i, 0);
  for (int c = 0; c < 3; ++c)
    if (solid.ghosts.symmetry().normal[c]) clusters.connect(0, 0, static_cast<Mirror>(1 << c));
  return clusters;
}

/// States that the cluster of one point and a mirror image of the cluster of another point (or of its own)
/// are the same. Clusters are given by their numbers.
struct Link {
  std::uint64_t a, b;
  Mirror image;
};

/// Clusters of points that are distributed over the ranks. Each rank finds the clusters of its points; the
/// links between clusters, and between clusters and their own images, are known to all ranks. The number of a
/// cluster is that of its first point.
class SpreadClusters {
public:
  SpreadClusters(const Solid& solid, const FragmentInputs& inputs)
      : share(solid.ghosts.processes().share(solid.points.owned)), here(0), all(0) {
    const Ranks& ranks = solid.ghosts.processes();
    const NeighborLists lists = solid.neighbor_lists();
    const bool whole = !ranks.any(!lists.index.empty());
    here = whole ? all_connected(solid) : connected_here(solid, lists, inputs);
    std::vector<Link> links = meetings();
    if (whole && share.count > 0)
      links.push_back({share.first, 0, 0});
    else if (!whole && ranks.several())
      add_links(solid, links);
    links = ranks.join(links);
    for (const Link& link : links) nodes.insert(nodes.end(), {link.a, link.b});
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    all = Clusters(nodes.size());
    for (const Link& link : links) all.connect(node(link.a), node(link.b), link.image);
  }

  struct Place {
    std::uint64_t root; ///< number of the cluster
    Mirror image;       ///< image of the point that belongs to the cluster
  };
  Place find(std::uint32_t i) {
    const Clusters::Place place = here.find(i);
    const std::uint64_t number = share.first + place.root;
    const std::uint32_t n = node(number);
    if (n == nodes.size() || nodes[n] != number) return {number, place.image};
    const Clusters::Place joined = all.find(n);
    return {nodes[joined.root], static_cast<Mirror>(place.image ^ joined.image)};
  }
  /// Returns the images that are the same cluster as a bit set, with one bit per image.
  std::uint8_t same(std::uint64_t root) const {
    const std::uint32_t n = node(root);
    return n == nodes.size() || nodes[n] != root ? std::uint8_t{1} : all.same(n);
  }
  double points() const { return static_cast<double>(share.all); }

private:
  std::uint32_t node(std::uint64_t number) const {
    return static_cast<std::uint32_t>(std::lower_bound(nodes.begin(), nodes.end(), number) - nodes.begin());
  }
  /// Returns the links of this rank's clusters with their own images.
  std::vector<Link> meetings() {
    std::vector<Link> links;
    for (std::uint32_t i = 0; i < share.count; ++i)
      for (int m = 1; m < 8; ++m)
        if (here.find(i).root == i && here.same(i) >> m & 1)
          links.push_back({share.first + i, share.first + i, static_cast<Mirror>(m)});
    return links;
  }
  /// Adds the links between this rank's clusters and those of the remote points on their own ranks.
  void add_links(const Solid& solid, std::vector<Link>& links) {
    const Points& points = solid.points;
    VectorField label; // number of the cluster, image
    label.resize(points.owned + solid.ghosts.size());
    for (std::uint32_t i = 0; i < points.owned; ++i) {
      const Clusters::Place place = here.find(i);
      label.set(i, {static_cast<double>(share.first + place.root), static_cast<double>(place.image), 0});
    }
    solid.ghosts.remote_points().update({&label});
    std::set<std::array<std::uint64_t, 3>> distinct;
    for (std::size_t r = points.owned; r < points.owned + solid.ghosts.size(); ++r) {
      if (!solid.ghosts.is_remote(points, r)) continue;
      const Clusters::Place place = here.find(static_cast<std::uint32_t>(r));
      if (place.root >= points.owned) continue; // no point of this rank is connected to it
      const auto there = static_cast<std::uint64_t>(label.component[0][r]);
      const auto image = static_cast<Mirror>(label.component[1][r]);
      distinct.insert({share.first + place.root, there, static_cast<std::uint64_t>(place.image ^ image)});
    }
    for (const auto& [a, b, image] : distinct) links.push_back({a, b, static_cast<Mirror>(image)});
  }

  Share share;
  Clusters here, all;               ///< clusters of this rank's points by place; clusters of `nodes`
  std::vector<std::uint64_t> nodes; ///< numbers of the clusters that are linked, ascending
};

/// Adds a point to the sums from which finish() computes means.
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

/// Computes means from sums, and the whole fragment from its modelled part. With rotational symmetry a point
/// represents a ring, whose centre is on the axis. @param same images that are the same fragment, as a bit
/// set
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

/// Extent of a fragment along z, cells included.
struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

FragmentPlace place_of(const Fragment& f, const Extent& extent, double front, double back) {
  if (f.velocity[2] > 0 && extent.high > back) return FragmentPlace::debris;
  if (f.velocity[2] < 0 && extent.low < front) return FragmentPlace::ejecta;
  return FragmentPlace::loose;
}

/// The part of a cluster on one rank.
struct Part {
  std::uint64_t root;
  Fragment sums;
  Extent extent;
};

/// Sums over this rank's points by cluster. @param root_of cluster of each point
std::vector<Part> parts_here(const Solid& solid, SpreadClusters& clusters,
                             std::vector<std::uint64_t>& root_of) {
  const Points& points = solid.points;
  const std::vector<double> shear = solid.field_or_zero("shear_damage"),
                            tensile = solid.field_or_zero("tensile_damage");
  std::vector<Part> parts;
  std::unordered_map<std::uint64_t, std::size_t> part_of;
  for (std::uint32_t i = 0; i < points.owned; ++i) {
    const auto [root, image] = clusters.find(i);
    root_of[i] = root;
    const auto [entry, is_new] = part_of.try_emplace(root, parts.size());
    if (is_new) parts.push_back({root, {}, {}});
    Part& part = parts[entry->second];
    add(part.sums, points, i, image, shear[i], tensile[i]);
    const double z = points.position.component[2][i], half = 0.5 * points.spacing[i];
    part.extent.low = std::min(part.extent.low, z - half),
    part.extent.high = std::max(part.extent.high, z + half);
  }
  return parts;
}

/// Merges the parts of all ranks into one for each cluster, in the order of the clusters.
std::vector<Part> merge(std::vector<Part> parts) {
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.root < b.root; });
  std::vector<Part> merged;
  for (const Part& part : parts) {
    if (merged.empty() || merged.back().root != part.root) {
      merged.push_back(part);
      continue;
    }
    merged.back().sums += part.sums;
    merged.back().extent.low = std::min(merged.back().extent.low, part.extent.low);
    merged.back().extent.high = std::max(merged.back().extent.high, part.extent.high);
  }
  return merged;
}

} // namespace

Fragment& Fragment::operator+=(const Fragment& other) {
  points += other.points;
  mass += other.mass;
  size += other.size;
  for (int c = 0; c < 3; ++c) centre[c] += other.centre[c], velocity[c] += other.velocity[c];
  kinetic_energy += other.kinetic_energy;
  shear_damage += other.shear_damage, tensile_damage += other.tensile_damage;
  return *this;
}

void FragmentInputs::declare(Parameters& parameters) {
  auto output = parameters.section("Output");
  output.number("Fragment gap", gap, {1e-3, 2},
                "largest relative displacement of connected points since the start, in spacings and without "
                "rotation; parts of a body that no chain of connected points joins are fragments");
  output.quantity(
      "Loose opening", loose, Dimension::length, {1e-6, 1},
      "opening of cracks below a face of the target from which on the concrete above them counts as "
      "missing in craters; in addition to fragments and to what has moved by half its spacing");
}

const char* name_of(FragmentPlace place) {
  constexpr std::array<const char*, 4> names = {"remainder", "debris", "ejecta", "loose"};
  return names[static_cast<std::size_t>(place)];
}

Fragments find_fragments(const Solid& solid, const FragmentInputs& inputs, double front, double back) {
  const Points& points = solid.points;
  SpreadClusters clusters(solid, inputs);
  std::vector<std::uint64_t> root_of(points.owned);
  Fragments found{.list = {}, .of_point = {}, .modelled_points = clusters.points()};
  std::vector<Part> parts = merge(solid.ghosts.processes().join(parts_here(solid, clusters, root_of)));
  for (Part& part : parts) {
    finish(part.sums, clusters.same(part.root), solid.ghosts.symmetry());
    part.sums.place = place_of(part.sums, part.extent, front, back);
  }
  std::vector<std::uint32_t> order(parts.size()), rank(parts.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return parts[a].sums.mass > parts[b].sums.mass; });
  for (const std::uint32_t f : order) {
    rank[f] = static_cast<std::uint32_t>(found.list.size());
    found.list.push_back(parts[f].sums);
  }
  if (!found.list.empty()) found.list.front().place = FragmentPlace::remainder;
  for (const std::uint64_t root : root_of) {
    const auto part = std::lower_bound(parts.begin(), parts.end(), root,
                                       [](const Part& p, std::uint64_t number) { return p.root < number; });
    found.of_point.push_back(rank[static_cast<std::size_t>(part - parts.begin())]);
  }
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

void add_fragments(Summary& summary, const Fragments& fragments, const SymmetryPlanes& planes,
                   const std::string& prefix) {
  const auto set = [&](const std::string& key, double value) { summary.set(prefix + key, value); };
  double count = 0, lone = 0, points = 0;
  for (const Fragment& f : fragments.list) {
    if (f.place != FragmentPlace::remainder) count += f.copies;
    if (f.points == 1) lone += f.copies;
    if (std::isfinite(dot(f.centre, f.centre) + f.kinetic_energy)) points += f.copies * f.points;
  }
  set("fragments", count);
  set("lone_points", lone);
  set("lost_points", fragments.modelled_points * planes.multiplicity() - points);
  for (const FragmentPlace place :
       {FragmentPlace::remainder, FragmentPlace::debris, FragmentPlace::ejecta, FragmentPlace::loose}) {
    const FragmentSums sum = sum_of(fragments, place);
    const std::string name = name_of(place);
    if (place != FragmentPlace::remainder) {
      set(name + "_fragments", sum.count);
      set(name + "_heaviest", sum.heaviest);
    }
    set(name + "_mass", sum.mass);
    set(name + "_momentum", sum.momentum);
    set(name + "_kinetic_energy", sum.kinetic_energy);
  }
}

} // namespace spall
