#include "macro/points/halo.h"

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/partitioner.h>

#include <array>
#include <map>

namespace spall {

namespace mpi = dealii::Utilities::MPI;

namespace {

/// A box as numbers, for messages.
using Corners = std::array<double, 6>;

Corners corners(const Bounds& b) { return {b.low[0], b.low[1], b.low[2], b.high[0], b.high[1], b.high[2]}; }
Bounds bounds(const Corners& c) { return {{c[0], c[1], c[2]}, {c[3], c[4], c[5]}}; }

/// Points that are tested together: consecutive ones are near each other.
constexpr std::size_t chunk_size = 128;

Bounds box_around(const Points& points, std::size_t begin, std::size_t end) {
  Bounds box;
  for (std::size_t i = begin; i < end; ++i) box.add(points.position[i]);
  return box;
}

} // namespace

struct Halo::Exchange {
  mpi::Partitioner partitioner;
  // Working memory, per component of the fields.
  std::vector<std::vector<double>> ghost, staged;
  std::vector<std::vector<MPI_Request>> requests;

  void make_room(std::size_t components) {
    if (ghost.size() >= components) return;
    ghost.resize(components), staged.resize(components), requests.resize(components);
    for (auto& g : ghost) g.resize(partitioner.n_ghost_indices());
    for (auto& s : staged) s.resize(partitioner.n_import_indices());
  }
  dealii::ArrayView<double> ghosts(std::size_t k) { return {ghost[k].data(), ghost[k].size()}; }
  dealii::ArrayView<double> stage(std::size_t k) { return {staged[k].data(), staged[k].size()}; }
};

Halo::Halo(const Ranks& ranks_) : ranks(ranks_) {}
Halo::Halo(Halo&&) noexcept = default;
Halo& Halo::operator=(Halo&&) noexcept = default;
Halo::~Halo() = default;

void Halo::count(std::size_t owned) {
  offset = all = 0;
  const auto counts = mpi::all_gather(MPI_COMM_WORLD, static_cast<std::uint64_t>(owned));
  for (int r = 0; r < ranks.count(); ++r) {
    if (r < ranks.rank()) offset += counts[r];
    all += counts[r];
  }
}

std::vector<std::uint64_t> Halo::find(const Points& points, const std::vector<Bounds>& boxes) const {
  const auto territories = mpi::all_gather(MPI_COMM_WORLD, corners(box_around(points, 0, points.owned)));
  std::map<unsigned int, std::vector<Corners>> questions;
  for (int r = 0; r < ranks.count(); ++r)
    if (r != ranks.rank())
      for (const Bounds& box : boxes)
        if (box.overlaps(bounds(territories[r]))) questions[r].push_back(corners(box));

  std::vector<Bounds> chunks;
  for (std::size_t begin = 0; begin < points.owned; begin += chunk_size)
    chunks.push_back(box_around(points, begin, std::min(points.owned, begin + chunk_size)));
  std::map<unsigned int, std::vector<std::uint64_t>> answers;
  for (const auto& [rank, asked] : mpi::some_to_some(MPI_COMM_WORLD, questions)) {
    std::vector<bool> wanted(points.owned, false);
    for (const Corners& c : asked) {
      const Bounds box = bounds(c);
      for (std::size_t k = 0; k < chunks.size(); ++k)
        if (box.overlaps(chunks[k]))
          for (std::size_t i = k * chunk_size; i < std::min(points.owned, (k + 1) * chunk_size); ++i)
            if (!wanted[i] && box.holds(points.position[i])) wanted[i] = true;
    }
    auto& numbers = answers[rank];
    for (std::size_t i = 0; i < points.owned; ++i)
      if (wanted[i]) numbers.push_back(offset + i);
  }
  std::vector<std::uint64_t> found;
  for (const auto& [rank, numbers] : mpi::some_to_some(MPI_COMM_WORLD, answers))
    found.insert(found.end(), numbers.begin(), numbers.end());
  return found;
}

std::size_t Halo::rebuild(const Points& points, const std::vector<Bounds>& boxes, std::uint32_t next,
                          bool keep) {
  if (!keep) remote.clear();
  if (!ranks.several()) return 0;
  count(points.owned);
  const auto by_number = [](const Remote& a, const Remote& b) { return a.number < b.number; };
  std::vector<std::uint64_t> found = find(points, boxes);
  std::sort(found.begin(), found.end());
  std::vector<Remote> added;
  for (const std::uint64_t number : found)
    if (!std::binary_search(remote.begin(), remote.end(), Remote{number, 0}, by_number))
      added.push_back({number, next++});
  remote.insert(remote.end(), added.begin(), added.end());
  std::sort(remote.begin(), remote.end(), by_number);
  connect(points.owned);
  return added.size();
}

void Halo::transfer(Archive& archive, std::size_t owned) {
  if (!ranks.several()) return;
  archive("remote_points", remote);
  if (!archive.loading()) return;
  count(owned);
  connect(owned);
}

void Halo::connect(std::size_t owned) {
  dealii::IndexSet own(all), others(all);
  own.add_range(offset, offset + owned);
  for (const Remote& r : remote) others.add_index(r.number);
  own.compress(), others.compress();
  exchange.reset(new Exchange{mpi::Partitioner(own, others, MPI_COMM_WORLD), {}, {}, {}});
}

void Halo::update(const std::vector<VectorField*>& fields, std::size_t owned) const {
  if (!ranks.several()) return;
  Exchange& e = *exchange;
  e.make_room(3 * fields.size());
  const auto each = [&](const auto& action) {
    for (std::size_t k = 0; k < 3 * fields.size(); ++k) action(k, fields[k / 3]->component[k % 3]);
  };
  each([&](std::size_t k, std::vector<double>& values) {
    e.partitioner.export_to_ghosted_array_start<double>(static_cast<unsigned int>(k),
                                                        dealii::ArrayView<const double>(values.data(), owned),
                                                        e.stage(k), e.ghosts(k), e.requests[k]);
  });
  each([&](std::size_t k, std::vector<double>& values) {
    e.partitioner.export_to_ghosted_array_finish<double>(e.ghosts(k), e.requests[k]);
    for (std::size_t g = 0; g < remote.size(); ++g) values[remote[g].place] = e.ghost[k][g];
  });
}

void Halo::add_back(VectorField& field, std::size_t owned) const {
  if (!ranks.several()) return;
  Exchange& e = *exchange;
  e.make_room(3);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t g = 0; g < remote.size(); ++g) e.ghost[k][g] = field.component[k][remote[g].place];
    e.partitioner.import_from_ghosted_array_start<double>(
        dealii::VectorOperation::add, static_cast<unsigned int>(k), e.ghosts(k), e.stage(k), e.requests[k]);
  }
  for (std::size_t k = 0; k < 3; ++k)
    e.partitioner.import_from_ghosted_array_finish<double>(
        dealii::VectorOperation::add, dealii::ArrayView<const double>(e.staged[k].data(), e.staged[k].size()),
        dealii::ArrayView<double>(field.component[k].data(), owned), e.ghosts(k), e.requests[k]);
}

HaloTraffic Halo::traffic() const {
  if (!exchange) return {};
  HaloTraffic t{.messages = 3 * exchange->partitioner.import_targets().size(), .bytes = 0};
  t.bytes = 3 * sizeof(double) * exchange->partitioner.n_import_indices();
  return t;
}

} // namespace spall
