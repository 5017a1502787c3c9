#include "macro/output/debris_cone.h"

#include "macro/output/quantile.h"
#include "shared/input/quantity.h"
#include "shared/output_directory.h"

#include <algorithm>
#include <cmath>

namespace spall {

DebrisCone debris_cone(const Solid& solid, const Fragments& fragments) {
  const Points& points = solid.points;
  const Ranks& ranks = solid.ghosts.processes();
  const double copies = solid.ghosts.symmetry().multiplicity();
  DebrisCone cone;
  std::vector<double> angles, energies;
  double total = 0;
  for (std::size_t i = 0; i < points.owned; ++i) {
    if (fragments.list[fragments.of_point[i]].place != FragmentPlace::debris) continue;
    const Vec3 v = points.velocity[i];
    const double mass = copies * points.mass[i], energy = 0.5 * mass * dot(v, v);
    const double angle = std::atan2(std::hypot(v[0], v[1]), v[2]);
    const std::size_t bin =
        std::min(DebrisCone::bins - 1, static_cast<std::size_t>(angle / DebrisCone::width));
    cone.mass[bin] += mass, cone.momentum[bin] += mass * v[2], cone.kinetic_energy[bin] += energy;
    angles.push_back(angle), energies.push_back(energy);
    total += energy;
  }
  Reduction sums{.sums = {&total}};
  for (auto* of_bins : {&cone.mass, &cone.momentum, &cone.kinetic_energy})
    for (double& sum : *of_bins) sums.sums.push_back(&sum);
  ranks.reduce(sums);
  if (total > 0) {
    cone.half_of_energy = weighted_quantile(angles, energies, 0.5 * total, ranks);
    cone.most_of_energy = weighted_quantile(angles, energies, 0.9 * total, ranks);
  }
  return cone;
}

void write_debris_cone(const std::filesystem::path& file, const DebrisCone& cone) {
  std::string text = "angle_from,angle_to,mass,momentum,kinetic_energy\n";
  for (std::size_t i = 0; i < DebrisCone::bins; ++i) {
    const double from = static_cast<double>(i) * DebrisCone::width;
    text += format_quantity(from, Dimension::none);
    for (const double value :
         {from + DebrisCone::width, cone.mass[i], cone.momentum[i], cone.kinetic_energy[i]})
      text += "," + format_quantity(value, Dimension::none);
    text += "\n";
  }
  write_atomically(file, text);
}

} // namespace spall
