#include "macro/solid/force_reduction.h"

#include "macro/points/parallel.h"

#include <algorithm>

namespace spall {

void ForceReduction::rebuild(const std::vector<const std::vector<std::uint32_t>*>& stencils,
                             std::size_t count, std::size_t block_size) {
  size = count;
  range = block_size;
  incoming.resize((count + range - 1) / range);
  for (auto& list : incoming) list.clear();
  for (std::uint32_t b = 0; b < stencils.size(); ++b) {
    const std::vector<std::uint32_t>& index = *stencils[b];
    for (std::uint32_t first = 0; first < index.size();) {
      const std::size_t destination = index[first] / range;
      std::uint32_t last = first + 1;
      while (last < index.size() && index[last] / range == destination) ++last;
      incoming[destination].push_back({b, first, last});
      first = last;
    }
  }
}

template<class T>
void ForceReduction::sum(const std::vector<const std::vector<std::uint32_t>*>& stencils,
                         const std::vector<const Lanes<T>*>& contributions, Points& points) const {
  for_each_index(incoming.size(), [&](std::size_t d) {
    double *fx = points.force.component[0].data(), *fy = points.force.component[1].data(),
           *fz = points.force.component[2].data();
    for (std::size_t i = d * range; i < std::min(size, (d + 1) * range); ++i) fx[i] = fy[i] = fz[i] = 0;
    for (const Segment& s : incoming[d]) {
      const std::uint32_t* index = stencils[s.source]->data();
      const Lanes<T>* force = contributions[s.source];
      if (force == nullptr) continue;
      for (std::uint32_t e = s.first; e < s.last; ++e) {
        fx[index[e]] += force[e][0];
        fy[index[e]] += force[e][1];
        fz[index[e]] += force[e][2];
      }
    }
  });
}

template void ForceReduction::sum<float>(const std::vector<const std::vector<std::uint32_t>*>&,
                                         const std::vector<const Lanes<float>*>&, Points&) const;
template void ForceReduction::sum<double>(const std::vector<const std::vector<std::uint32_t>*>&,
                                          const std::vector<const Lanes<double>*>&, Points&) const;

} // namespace spall
