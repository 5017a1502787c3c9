#include "macro/integration/ring_operators.h"

#include <algorithm>
#include <limits>

namespace spall {
namespace {

/// The rings that the points of a stencil belong to.
struct Rings {
  std::vector<std::uint32_t> stencil; ///< owners of the rings, ascending
  std::vector<std::uint16_t> column;  ///< of each point of the old stencil: place of its ring in `stencil`
  std::vector<double> cosine, sine;   ///< of each point of the old stencil: its angle
};

Rings find_rings(const std::vector<std::uint32_t>& stencil, const Ghosts& ghosts, const Points& points) {
  Rings rings;
  for (const std::uint32_t j : stencil) {
    rings.stencil.push_back(ghosts.owner(points, j));
    const Vec3 radial = ghosts.is_remote(points, j) ? Vec3{1, 0, 0} : ghosts.mirror(points, j, {1, 0, 0});
    rings.cosine.push_back(radial[0]);
    rings.sine.push_back(radial[1]);
  }
  const std::vector<std::uint32_t> owners = rings.stencil;
  std::sort(rings.stencil.begin(), rings.stencil.end());
  rings.stencil.erase(std::unique(rings.stencil.begin(), rings.stencil.end()), rings.stencil.end());
  for (const std::uint32_t owner : owners)
    rings.column.push_back(static_cast<std::uint16_t>(
        std::lower_bound(rings.stencil.begin(), rings.stencil.end(), owner) - rings.stencil.begin()));
  return rings;
}

/// Joins the records of one width, in place: a row has as many rings as pairs at most, but longer records.
template<int Width, class T> void join(GradientOperators<T>& operators, const Rings& rings) {
  using Record = RingRecord<T, Width>;
  const auto old = std::move(operators.template records<Width>());
  std::vector<typename Record::Vector> joined;
  std::vector<std::uint16_t> column;
  std::vector<std::uint32_t> start{0};
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(rings.stencil.size(), none); // of a ring among the pairs
  for (std::size_t row = 0; row + 1 < operators.start.size(); ++row) {
    for (std::uint32_t p = operators.start[row]; p < operators.start[row + 1]; ++p) {
      const std::uint16_t image = operators.column[p], ring = rings.column[image];
      if (place[ring] == none) {
        place[ring] = static_cast<std::uint32_t>(column.size());
        column.push_back(ring);
        joined.resize(joined.size() + Record::size);
      }
      Record::add(&joined[Record::size * place[ring]], &old[Record::size_of_image * p],
                  T(rings.cosine[image]), T(rings.sine[image]));
    }
    for (std::uint32_t p = start.back(); p < column.size(); ++p) place[column[p]] = none;
    start.push_back(static_cast<std::uint32_t>(column.size()));
  }
  operators.template records<Width>() = joined; // without excess capacity
  operators.column = column;
  operators.start = start;
}

} // namespace

template<class T>
void join_images(GradientOperators<T>& operators, const Ghosts& ghosts, const Points& points) {
  const Rings rings = find_rings(operators.stencil, ghosts, points);
  switch (operators.layout.width) {
  case 1:
    join<1>(operators, rings);
    break;
  case 4:
    join<4>(operators, rings);
    break;
  default:
    join<8>(operators, rings);
  }
  operators.stencil = rings.stencil;
  operators.rings = true;
}

template void join_images(GradientOperators<float>&, const Ghosts&, const Points&);
template void join_images(GradientOperators<double>&, const Ghosts&, const Points&);

} // namespace spall
