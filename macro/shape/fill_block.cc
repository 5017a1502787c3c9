#include "macro/shape/cells.h"

#include <stdexcept>

namespace spall {
Points fill_block(const Block& block, const Filling& filling, const SymmetryPlanes& planes, double density) {
  if (planes.axis) throw std::invalid_argument("a block has no rotational symmetry");
  Filler filler(0, filling);
  const int more = filling.boundary == Boundary::on_surface ? 1 : 0;
  const Division along_x = divide_evenly(block.width, filling), along_y = divide_evenly(block.depth, filling),
                 along_z = divide(block.height, nearest_count(block.height, filling.spacing) + more,
                                  filling.boundary);
  const auto is_end = [](const Division& d, std::size_t i) { return i == 0 || i + 1 == d.size(); };
  for (std::size_t i = 0; i < along_x.size(); ++i)
    for (std::size_t j = 0; j < along_y.size(); ++j) {
      const double x = along_x.position[i] - 0.5 * block.width, y = along_y.position[j] - 0.5 * block.depth;
      if (!is_modelled(planes, x, y)) continue;
      const double base = (along_x.end[i] - along_x.begin[i]) * (along_y.end[j] - along_y.begin[j]);
      filler.add_column(along_z, base, std::sqrt(along_x.width[i] * along_y.width[j]),
                        is_end(along_x, i) || is_end(along_y, j), [&]() -> std::array<double, 2> {
                          const double u = x + filler.shift(along_x, i);
                          return {u, y + filler.shift(along_y, j)};
                        });
    }
  return filler.points(density);
}

} // namespace spall
