#include "macro/points/decomposition.h"

#include <algorithm>
#include <cstring>

namespace spall {
namespace {

/// An archive that reduces every array to the items [begin, end).
class KeepRange final : public Archive {
public:
  KeepRange(std::size_t begin_, std::size_t end_) : begin(begin_), end(end_) {}
  bool loading() const override { return false; }

protected:
  void item(const char*, void*, std::size_t) override {}
  void array(const char*, Sequence& values) override {
    auto* data = static_cast<std::byte*>(values.data());
    std::memmove(data, data + begin * values.item_bytes, (end - begin) * values.item_bytes);
    values.resize(end - begin);
  }

private:
  std::size_t begin, end;
};

} // namespace

Share share_of(std::size_t points, const Ranks& ranks, std::size_t granule) {
  const std::size_t granules = (points + granule - 1) / granule,
                    count = static_cast<std::size_t>(ranks.count()),
                    mine = static_cast<std::size_t>(ranks.rank());
  const auto cut_before = [&](std::size_t rank) {
    return std::min(points, (granules * rank + count - 1) / count * granule);
  };
  const std::size_t first = cut_before(mine);
  return {.first = first, .count = cut_before(mine + 1) - first, .all = points};
}

Points part_of(Points points, const Share& share) {
  if (share.count == share.all) return points;
  KeepRange range(share.first, share.first + share.count);
  points.transfer(range);
  points.owned = share.count;
  const Points& part = points;
  return part; // returns a copy, as the arrays still have the capacity of the whole body
}

} // namespace spall
