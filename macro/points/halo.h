#pragma once

#include "macro/points/bounds.h"
#include "shared/ranks.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace spall {

/// The remote points of this rank: copies of the points of other ranks that lie in the supports of its own.
/// They follow their owners, and the forces gathered on them are added to their owners. Points are numbered
/// through all ranks, those of a rank consecutively. deal.II's Partitioner passes the messages.
class Halo {
public:
  explicit Halo(const Ranks& ranks_ = {});
  Halo(Halo&&) noexcept;
  Halo& operator=(Halo&&) noexcept;
  ~Halo();

  /// Finds the remote points inside the boxes. All ranks must call it.
  /// @param next place of the first new remote point in the arrays; the others follow it
  /// @param keep leaves the remote points there are in their places
  /// @return how many are new
  std::size_t rebuild(const Points& points, const std::vector<Bounds>& boxes, std::uint32_t next, bool keep);

  /// Makes the points with these numbers (ascending) the remote points, in the places after the owned ones.
  /// All ranks must call it.
  void fetch(std::size_t owned, const std::vector<std::uint64_t>& numbers);

  /// Halo exchange: copies fields of the owners to their remote points. All ranks must call it.
  void update(const std::vector<VectorField*>& fields) const;
  /// Adds the values of the remote points to their owners (a reduction), in the order of the ranks.
  void add_back(VectorField& field) const;

  /// Reading needs the same ranks with the same points.
  void transfer(Archive& archive, std::size_t owned);

  const Ranks& processes() const { return ranks; }
  std::size_t size() const { return remote.size(); }
  std::size_t memory_bytes() const; ///< without the buffers of MPI
  /// Number, through all ranks, of this rank's first point.
  std::uint64_t first() const { return offset; }

  struct Remote {
    std::uint64_t number; ///< number of the point through all ranks
    std::uint32_t place;  ///< place in the arrays of this rank
  };
  const std::vector<Remote>& points() const { return remote; } ///< ascending by number

private:
  struct Exchange;
  /// Numbers of the points of other ranks inside the boxes, in any order.
  std::vector<std::uint64_t> find(const Points& points, const std::vector<Bounds>& boxes) const;
  void count(std::size_t owned);
  /// Prepares the messages for the remote points there are.
  void connect(std::size_t owned);

  Ranks ranks;
  std::uint64_t offset = 0, all = 0; ///< points on the ranks before this one, and on all
  std::vector<Remote> remote;        ///< ascending by number
  std::unique_ptr<Exchange> exchange;
};

} // namespace spall
