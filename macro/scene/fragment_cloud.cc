#include "macro/scene/fragment_cloud.h"

#include "shared/error.h"
#include "shared/input/number_rows.h"

#include <cmath>
#include <numbers>

namespace spall {

std::vector<CloudFragment> read_fragments(const std::filesystem::path& file) {
  const std::vector<std::string> columns = {"mass", "x", "y", "z", "vx", "vy", "vz"};
  std::vector<CloudFragment> fragments;
  for (const NumberRow& row : read_number_rows(file, columns)) {
    const std::vector<double>& v = row.values;
    const auto check = [&](std::size_t c, bool allowed, const char* range) {
      if (!allowed)
        throw InputError(file.string() + ":" + std::to_string(row.line) + ": column '" + columns[c] +
                         "': found " + format_quantity(v[c], Dimension::none) + ", allowed: " + range);
    };
    check(0, v[0] >= 1e-12 && v[0] <= 1e6, "1e-12 to 1e6 kg");
    for (const std::size_t c : {1, 2, 3}) check(c, std::abs(v[c]) <= 1e3, "-1000 to 1000 m");
    for (const std::size_t c : {4, 5, 6}) check(c, std::abs(v[c]) <= 1e4, "-10000 to 10000 m/s");
    fragments.push_back({v[0], {v[1], v[2], v[3]}, {v[4], v[5], v[6]}});
  }
  if (fragments.empty() || fragments.size() > most_fragments)
    throw InputError(file.string() + ": found " + std::to_string(fragments.size()) +
                     " fragments, allowed: 1 to " + std::to_string(most_fragments));
  return fragments;
}

std::vector<BodyInputs> fragments_of(const BodyInputs& cloud, const SymmetryPlanes& planes,
                                     const std::string& file) {
  const auto refuse = [&](const std::string& key, const std::string& why) {
    throw InputError(file + ": key '" + cloud.name + "/" + key + "': " + why);
  };
  if (planes.multiplicity() > 1 || planes.axis)
    throw InputError(file + ": key 'Scene/Symmetry planes': found planes, allowed with the cloud '" +
                     cloud.name + "': none");
  if (cloud.shape.kind != ShapeKind::unset && cloud.shape.kind != ShapeKind::sphere)
    refuse("Shape", "allowed with Fragments: sphere, or not set");
  if (std::isnan(cloud.mass.density)) refuse("Mean density", "must be set with Fragments");
  if (!std::isnan(cloud.mass.mass))
    refuse("Mass", "allowed with Fragments: not set; the file has the masses");
  if (cloud.held || cloud.motion.velocity != 0 || cloud.motion.spin != 0 || !cloud.motion.is_normal())
    refuse("Fragments", "allowed with it: neither Held nor Velocity, Spin, Obliquity, Angle of attack; the "
                        "file has the velocities");
  std::vector<BodyInputs> bodies;
  for (const CloudFragment& fragment : read_fragments(cloud.fragments)) {
    BodyInputs body(cloud.name + "_" + std::to_string(bodies.size() + 1));
    const double diameter = std::cbrt(6 * fragment.mass / (std::numbers::pi * cloud.mass.density));
    body.model = BodyModel::rigid;
    body.shape.kind = ShapeKind::sphere, body.shape.diameter = diameter;
    body.mass.mass = fragment.mass;
    body.place.offset_x = fragment.place[0], body.place.offset_y = fragment.place[1];
    body.place.lowest = fragment.place[2] - 0.5 * diameter;
    body.motion.velocity = norm(fragment.velocity), body.motion.of_fragment = fragment.velocity;
    bodies.push_back(std::move(body));
  }
  return bodies;
}

} // namespace spall
