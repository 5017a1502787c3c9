#include "macro/restart/rebalance.h"

#include "macro/restart/byte_archives.h"

#include <deal.II/base/mpi.h>

#include <map>
#include <numeric>

namespace spall {
namespace {

using Bytes = std::vector<char>; // the type that deal.II's message functions take

/// The pieces that this rank has of a list that is distributed over the ranks, from number `first` on.
struct Pieces {
  std::uint64_t first = 0;
  std::vector<Bytes> here;
};

/// Saves a state in memory.
class MemorySaver final : public Archive {
public:
  explicit MemorySaver(const Ranks& ranks_) : ranks(ranks_) {}
  bool loading() const override { return false; }
  void pieces(const std::string& name, std::size_t count, const Piece& piece) override {
    Pieces& list = lists[name];
    list.first = ranks.share(count).first;
    for (std::size_t k = 0; k < count; ++k) {
      ByteWriter writer;
      piece(k, writer);
      const auto* bytes = reinterpret_cast<const char*>(writer.bytes.data());
      list.here.emplace_back(bytes, bytes + writer.bytes.size());
    }
  }
  bool of_rank(const std::function<void(Archive&)>&) override { return true; }
  void item(const char* name, void* value, std::size_t count) override { common.item(name, value, count); }
  void array(const char* name, Sequence& values) override { common.array(name, values); }

  std::map<std::string, Pieces> lists;
  ByteWriter common;

private:
  const Ranks& ranks;
};

/// Loads the saved state. Each rank gets as many pieces as it asks for, in the order of the pieces.
class MemoryLoader final : public Archive {
public:
  MemoryLoader(MemorySaver& saved, const Ranks& ranks_)
      : lists(saved.lists), common(std::move(saved.common.bytes)), ranks(ranks_) {}
  bool loading() const override { return true; }
  void pieces(const std::string& name, std::size_t count, const Piece& piece) override {
    std::size_t k = 0;
    for (const Bytes& piece_bytes : exchange(lists.at(name), count)) {
      const auto* bytes = reinterpret_cast<const std::byte*>(piece_bytes.data());
      ByteReader reader({bytes, bytes + piece_bytes.size()});
      piece(k++, reader);
      reader.finish();
    }
  }
  bool of_rank(const std::function<void(Archive&)>&) override { return false; }
  void item(const char* name, void* value, std::size_t count) override { common.item(name, value, count); }
  void array(const char* name, Sequence& values) override { common.array(name, values); }

private:
  /// Exchanges pieces of a list between the ranks. @return the `count` pieces of this rank
  std::vector<Bytes> exchange(Pieces& list, std::size_t count) const {
    std::vector<std::uint64_t> counts = ranks.join(std::vector<std::uint64_t>{count});
    std::map<unsigned int, std::vector<Bytes>> leaving, arrived;
    std::uint64_t end = 0, next = list.first;
    const auto last = list.first + list.here.size(), mine = static_cast<std::uint64_t>(ranks.rank());
    for (unsigned int r = 0; r < counts.size(); ++r) {
      end += counts[r];
      for (; next < std::min<std::uint64_t>(end, last); ++next)
        (r == mine ? arrived : leaving)[r].push_back(std::move(list.here[next - list.first]));
    }
    if (ranks.several()) arrived.merge(dealii::Utilities::MPI::some_to_some(MPI_COMM_WORLD, leaving));
    std::vector<Bytes> all; // the order of the ranks is that of the pieces
    for (auto& [rank, part] : arrived)
      for (Bytes& bytes : part) all.push_back(std::move(bytes));
    return all;
  }

  std::map<std::string, Pieces>& lists;
  ByteReader common;
  const Ranks& ranks;
};

} // namespace

void move_points(Simulation& run, const std::vector<std::vector<std::uint64_t>>& cuts) {
  const Ranks ranks = run.ranks();
  for (std::size_t s = 0; s < run.bodies.solids.size(); ++s) {
    const std::uint64_t all = ranks.share(run.bodies.solids[s]->points.owned).all;
    std::vector<std::uint64_t>& shares = run.bodies.solids[s]->next_shares;
    const std::uint64_t block_size = run.bodies.solids[s]->block_size;
    for (std::size_t r = 0; r + 1 < cuts[s].size(); ++r)
      shares.push_back(std::min(all, cuts[s][r + 1] * block_size) - std::min(all, cuts[s][r] * block_size));
  }
  MemorySaver saver(ranks);
  run.transfer(saver);
  for (const auto& solid : run.bodies.solids) solid->next_shares.clear();
  MemoryLoader loader(saver, ranks);
  run.transfer(loader);
}

void Balancer::look(Simulation& run) {
  const Ranks& ranks = run.ranks();
  if (!ranks.several() || inputs.tolerance == 0 || run.steps % static_cast<std::size_t>(inputs.interval) != 0)
    return;
  const auto count = static_cast<std::size_t>(ranks.count());
  std::vector<double> of_rank(count);
  std::vector<std::vector<std::uint64_t>> next;
  bool better = false;
  for (const auto& solid : run.bodies.solids) {
    const std::vector<double> own = solid->take_costs(), costs = ranks.join(own);
    std::vector<std::uint64_t> cuts = {0};
    for (const std::uint64_t blocks : ranks.join(std::vector<std::uint64_t>{own.size()}))
      cuts.push_back(cuts.back() + blocks);
    for (std::size_t r = 0; r < count; ++r)
      of_rank[r] += std::accumulate(costs.begin() + static_cast<std::ptrdiff_t>(cuts[r]),
                                    costs.begin() + static_cast<std::ptrdiff_t>(cuts[r + 1]), 0.0);
    // Blocks are not divided, so a small number of them cannot be distributed evenly.
    const std::vector<std::uint64_t> even = balanced_cuts(costs, count);
    const double now = imbalance_of(costs, cuts);
    const bool worth = now > inputs.tolerance && imbalance_of(costs, even) < 0.5 * now;
    better = better || worth;
    next.push_back(worth ? even : cuts);
  }
  std::vector<std::uint64_t> each(count + 1);
  std::iota(each.begin(), each.end(), std::uint64_t{0});
  last = imbalance_of(of_rank, each);
  if (!better) return;
  move_points(run, next);
  ++movements;
}

} // namespace spall
