#include "macro/shape/revolution.h"

namespace spall {
namespace {

/// Adds places to ascending ones, except those that differ from one of them by round-off only.
void merge(std::vector<double>& places, const std::vector<double>& more, double shift) {
  const double tolerance = 1e-9 * (places.back() - places.front());
  const std::vector<double> first = places;
  for (const double z : more)
    if (std::none_of(first.begin(), first.end(),
                     [&](double a) { return std::abs(a - (z + shift)) <= tolerance; }))
      places.push_back(z + shift);
  std::sort(places.begin(), places.end());
}

} // namespace

Sections Revolution::sections() const {
  Sections s{.outer = [this](double z) { return outer_radius(z); },
             .inner = [this](double z) { return inner_radius(z); },
             .kinks = outer.kinks(),
             .breaks = outer.breaks()};
  if (inner) {
    merge(s.kinks, inner->kinks(), inner_z);
    merge(s.breaks, inner->breaks(), inner_z);
  }
  return s;
}

} // namespace spall
