#include "macro/points/ghosts.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace spall {
namespace {

/// The name of one point: the number of its owner and the map to its image.
using Name = std::pair<std::uint64_t, PointNames::Map>;

/// Returns all names in ascending order without duplicates.
std::vector<Name> distinct(const std::vector<PointNames>& names) {
  std::vector<Name> list;
  for (const PointNames& some : names)
    for (std::size_t k = 0; k < some.number.size(); ++k)
      list.emplace_back(some.number[k], some.maps[some.map[k]]);
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

} // namespace

std::vector<std::uint64_t> Ghosts::numbers(const Points& points) const {
  const std::uint64_t first = halo.processes().share(points.owned).first;
  std::vector<std::uint64_t> numbers(points.owned + images.size());
  for (std::size_t i = 0; i < points.owned; ++i) numbers[i] = first + i;
  for (const auto& [number, place] : halo.points()) numbers[place] = number;
  for (std::size_t g = 0; g < images.size(); ++g) numbers[points.owned + g] = numbers[images[g].owner];
  return numbers;
}

PointNames Ghosts::names(const Points& points, const std::vector<std::uint64_t>& numbers,
                         const std::vector<std::uint32_t>& places) const {
  PointNames names;
  for (const std::uint32_t i : places) {
    const PointNames::Map map = map_of(points, i);
    auto known = std::find(names.maps.begin(), names.maps.end(), map);
    if (known == names.maps.end()) known = names.maps.insert(known, map);
    names.number.push_back(numbers[i]);
    names.map.push_back(static_cast<std::uint16_t>(known - names.maps.begin()));
  }
  return names;
}

std::vector<std::vector<std::uint32_t>> Ghosts::places(const Points& points,
                                                       const std::vector<PointNames>& names) const {
  const std::vector<std::uint64_t> number = numbers(points);
  const std::uint64_t first = number.empty() ? 0 : number.front();
  std::vector<std::pair<Name, std::uint32_t>> known; // names of the ghosts and their places
  for (std::size_t i = points.owned; i < number.size(); ++i)
    known.push_back({{number[i], map_of(points, i)}, static_cast<std::uint32_t>(i)});
  std::sort(known.begin(), known.end());
  std::vector<std::vector<std::uint32_t>> places;
  for (const PointNames& some : names) {
    std::vector<std::uint32_t>& here = places.emplace_back();
    for (std::size_t k = 0; k < some.number.size(); ++k) {
      const Name name = {some.number[k], some.maps[some.map[k]]};
      // The difference is unsigned: for a number below the first one it is larger than any number of points.
      if (const std::uint64_t own = name.first - first;
          own < points.owned && name.second == PointNames::itself) {
        here.push_back(static_cast<std::uint32_t>(own));
        continue;
      }
      const auto found = std::lower_bound(known.begin(), known.end(), std::pair{name, std::uint32_t{0}});
      if (found == known.end() || found->first != name)
        throw std::runtime_error("a neighbour is missing: point " + std::to_string(name.first));
      here.push_back(found->second);
    }
  }
  return places;
}

void Ghosts::rebuild(Points& points, const std::vector<PointNames>& names) {
  const std::uint64_t first = halo.processes().share(points.owned).first;
  const auto is_own = [&](std::uint64_t number) { return number - first < points.owned; };
  const std::vector<Name> wanted = distinct(names);
  std::vector<std::uint64_t> remote;
  for (const auto& [number, map] : wanted)
    if (!is_own(number) && (remote.empty() || remote.back() != number)) remote.push_back(number);
  images.clear(), present.clear();
  halo.fetch(points.owned, remote);
  for (std::size_t k = 0; k < remote.size(); ++k)
    images.push_back({.owner = static_cast<std::uint32_t>(points.owned + k)});
  present.resize(points.owned + remote.size());
  for (const auto& [number, map] : wanted) {
    if (map == PointNames::itself) continue;
    const std::uint64_t owner =
        is_own(number)
            ? number - first
            : points.owned + static_cast<std::uint64_t>(
                                 std::lower_bound(remote.begin(), remote.end(), number) - remote.begin());
    images.push_back({static_cast<std::uint32_t>(owner), map[0], map[1], map[2], map[3], map[4]});
    const int mask = (map[0] < 0 ? 1 : 0) | (map[3] < 0 ? 2 : 0) | (map[4] < 0 ? 4 : 0);
    present[owner] |= static_cast<std::uint8_t>(1 << mask);
  }
  for (VectorField* field : {&points.position, &points.velocity, &points.force})
    field->resize(points.owned + images.size());
  refresh(points);
}

} // namespace spall
