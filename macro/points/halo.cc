#include "macro/points/halo.h"

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/partitioner.h>

#include <array>
#include <map>

namespace spall {

namespace mpi = dealii::Utilities::MPI;

namespace {

/// A box as an array of numbers, which MPI messages can hold.
using Corners = std::array<double, 6>;

Corners corners(const Bounds& b) { return {b.low[0], b.low[1], b.low[2], b.high[0], b.high[1], b.high[2]}; }
Bounds bounds(const Corners& c) { return {{c[0], c[1], c[2]}, {c[3], c[4], c[5]}}; }

/// Number of consecutive points that are tested together against a box; they are near each other in space.
constexpr std::size_t chunk_size = 128;

Bounds box_around(const Points& points, std::size_t begin, std::size_t end) {
  Bounds box;
  for (std::size_t i = begin; i < end; ++i) box.add(points.position[i]);
  return box;
}

} // namespace

/// The halo exchange of fields. The components of a vector are stored side by side, so that a field is sent
/// to a neighbour in one message.
struct Halo::Exchange {
  Exchange(const dealii::IndexSet& own_, const dealii::IndexSet& others)
      : partitioner(own_, others, MPI_COMM_WORLD), own(own_.n_elements()) {}

  mpi::Partitioner partitioner; ///< partitioner of the vector components 3 i + c
  std::vector<double> own; ///< components of owned points; only those that other ranks have copies of are set
  /// Buffers of a message.
  struct Buffers {
    std::vector<double> staged, ghost;
    std::vector<MPI_Request> requests;
  };
  std::vector<Buffers> buffers;

  template<class T = double> static dealii::ArrayView<T> view(std::vector<double>& values) {
    return {values.data(), values.size()};
  }

  void make_room(std::size_t fields) {
    while (buffers.size() < fields) {
      Buffers& b = buffers.emplace_back();
      b.staged.resize(partitioner.n_import_indices());
      b.ghost.resize(partitioner.n_ghost_indices());
    }
  }
  /// Calls action(value in `own`, value in the field) for all components that other ranks have copies of.
  template<class Action> void for_each_shared(VectorField& field, const Action& action) {
    for (const auto& [begin, end] : partitioner.import_indices())
      for (unsigned int k = begin; k < end; ++k) action(own[k], field.component[k % 3][k / 3]);
  }
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

void Halo::fetch(std::size_t owned, const std::vector<std::uint64_t>& numbers) {
  remote.clear();
  if (!ranks.several()) return;
  for (const std::uint64_t number : numbers)
    remote.push_back({number, static_cast<std::uint32_t>(owned + remote.size())});
  count(owned);
  connect(owned);
}

void Halo::transfer(Archive& archive, std::size_t owned) {
  if (!ranks.several()) return;
  archive("remote_points", remote);
  if (!archive.loading()) return;
  count(owned);
  connect(owned);
}

void Halo::connect(std::size_t owned) {
  dealii::IndexSet own(3 * all), others(3 * all);
  own.add_range(3 * offset, 3 * (offset + owned));
  for (const Remote& r : remote) others.add_range(3 * r.number, 3 * r.number + 3);
  own.compress(), others.compress();
  exchange = std::make_unique<Exchange>(own, others);
}

void Halo::update(const std::vector<VectorField*>& fields) const {
  if (!ranks.several()) return;
  Exchange& e = *exchange;
  e.make_room(fields.size());
  for (std::size_t f = 0; f < fields.size(); ++f) {
    Exchange::Buffers& b = e.buffers[f];
    e.for_each_shared(*fields[f], [](double& own, double value) { own = value; });
    e.partitioner.export_to_ghosted_array_start<double>(static_cast<unsigned int>(f),
                                                        e.view<const double>(e.own), e.view(b.staged),
                                                        e.view(b.ghost), b.requests);
  }
  for (std::size_t f = 0; f < fields.size(); ++f) {
    Exchange::Buffers& b = e.buffers[f];
    e.partitioner.export_to_ghosted_array_finish<double>(e.view(b.ghost), b.requests);
    for (std::size_t g = 0; g < remote.size(); ++g)
      for (int c = 0; c < 3; ++c) fields[f]->component[c][remote[g].place] = b.ghost[3 * g + c];
  }
}

void Halo::add_back(VectorField& field) const {
  if (!ranks.several()) return;
  Exchange& e = *exchange;
  e.make_room(1);
  Exchange::Buffers& b = e.buffers.front();
  for (std::size_t g = 0; g < remote.size(); ++g)
    for (int c = 0; c < 3; ++c) b.ghost[3 * g + c] = field.component[c][remote[g].place];
  e.for_each_shared(field, [](double& own, double value) { own = value; });
  constexpr auto sum = dealii::VectorOperation::add;
  e.partitioner.import_from_ghosted_array_start<double>(sum, 0, e.view(b.ghost), e.view(b.staged),
                                                        b.requests);
  e.partitioner.import_from_ghosted_array_finish<double>(sum, e.view<const double>(b.staged), e.view(e.own),
                                                         e.view(b.ghost), b.requests);
  e.for_each_shared(field, [](double own, double& value) { value = own; });
}

std::size_t Halo::memory_bytes() const {
  std::size_t bytes = sizeof(Remote) * remote.capacity();
  if (!exchange) return bytes;
  bytes += sizeof(double) * exchange->own.capacity();
  for (const auto& [staged, ghost, requests] : exchange->buffers)
    bytes += sizeof(double) * (staged.capacity() + ghost.capacity());
  return bytes;
}

} // namespace spall
