#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace spall {

/// A rank's part of a list that is distributed over the ranks: it holds `count` of `all` items, from number
/// `first` on.
struct Share {
  std::uint64_t first = 0, count = 0, all = 0;
};

/// Numbers that the ranks reduce in one message: each becomes the sum, the largest or the smallest value over
/// all ranks.
struct Reduction {
  std::vector<double*> sums = {}, largest = {}, smallest = {};
  std::vector<std::size_t*> counts = {}; ///< become sums
};

/// The processes that mpirun (or srun) started together. MPI is initialised only if there are several,
/// because that takes longer than a single microcell. Copies of an object refer to the same processes.
class Ranks {
public:
  Ranks() = default; ///< this process is the only one
  Ranks(int& argc, char**& argv);

  int rank() const { return mine; }
  int count() const { return all; }
  bool first() const { return mine == 0; }
  bool several() const { return all > 1; }
  int threads() const {
    return cores;
  } ///< threads per rank, such that the ranks on a machine use all its cores

  // All ranks must call these together. The order of a sum depends on the number of ranks only, and all ranks
  // get the same bits. With one rank nothing is sent.
  double sum(double value) const;
  void sum(std::vector<double>& values) const;
  double min(double value) const;
  double max(double value) const;
  void max(std::vector<double>& values) const;
  bool any(bool value) const;
  void reduce(const Reduction& numbers) const;
  /// Returns the lines of all ranks, in the order of the ranks.
  std::vector<std::string> gather(const std::vector<std::string>& lines) const;
  /// Returns the items of all ranks, in the order of the ranks, on every rank.
  template<class T>
  requires std::is_trivially_copyable_v<T> std::vector<T> join(const std::vector<T>& items)
  const {
    if (!several()) return items;
    const auto* bytes = reinterpret_cast<const char*>(items.data());
    const std::vector<char> all_bytes = join_bytes({bytes, bytes + items.size() * sizeof(T)});
    std::vector<T> together(all_bytes.size() / sizeof(T));
    if (!together.empty()) std::memcpy(together.data(), all_bytes.data(), all_bytes.size());
    return together;
  }
  /// Returns the position of this rank's `count` items in the list of all items, which is in the order of the
  /// ranks.
  Share share(std::size_t count) const;
  /// Runs `action` on every rank, without messages in it. An exception on any rank is thrown on all ranks,
  /// with the message of the first one; otherwise the other ranks would wait forever in their next message.
  void on_all(const std::function<void()>& action) const;
  /// Runs `action` on one rank. An exception that it throws is thrown on all ranks.
  void on_one(int rank, const std::function<void()>& action) const;
  void on_first(const std::function<void()>& action) const { on_one(0, action); }
  /// Ends all processes at once if there are several: for an error that only one of them can see.
  void abort(int code) const;

private:
  struct Session;
  std::vector<char> join_bytes(const std::vector<char>& bytes) const;

  std::shared_ptr<Session> session;
  int mine = 0, all = 1, cores = 1;
};

} // namespace spall
