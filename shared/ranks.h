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

/// A rank's part of a list that is spread over the ranks: `count` items from number `first` on, of `all`.
struct Share {
  std::uint64_t first = 0, count = 0, all = 0;
};

/// Numbers that the ranks put together in one message: each becomes the sum, the largest or the smallest of
/// all ranks.
struct Reduction {
  std::vector<double*> sums = {}, largest = {}, smallest = {};
  std::vector<std::size_t*> counts = {}; ///< added up
};

/// The processes that mpirun (or srun) started together. MPI itself is started only if there are several: a
/// single microcell takes less time than that. Copies speak of the same processes.
class Ranks {
public:
  Ranks() = default; ///< this process alone
  Ranks(int& argc, char**& argv);

  int rank() const { return mine; }
  int count() const { return all; }
  bool first() const { return mine == 0; }
  bool several() const { return all > 1; }
  int threads() const { return cores; } ///< so that the ranks on a machine use all of it

  // All ranks must call these together. Sums are taken in an order that depends on the number of ranks only,
  // and all ranks get the same bits. With one rank nothing is sent.
  double sum(double value) const;
  void sum(std::vector<double>& values) const;
  double min(double value) const;
  double max(double value) const;
  void max(std::vector<double>& values) const;
  bool any(bool value) const;
  void reduce(const Reduction& numbers) const;
  /// Lines of every rank, in the order of the ranks.
  std::vector<std::string> gather(const std::vector<std::string>& lines) const;
  /// Items of all ranks, one rank after the other, on every rank.
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
  /// Where this rank's items are in the list of all, which has them in the order of the ranks.
  Share share(std::size_t count) const;
  /// Runs `action` on every rank, without messages in it. What it throws on any of them is thrown on all of
  /// them, with the message of the first one: otherwise the others would wait for it in their next message.
  void on_all(const std::function<void()>& action) const;
  /// Runs `action` on one rank. What it throws is thrown on all of them.
  void on_one(int rank, const std::function<void()>& action) const;
  void on_first(const std::function<void()>& action) const { on_one(0, action); }
  /// Ends all processes at once, if there are several: for what only one of them knows.
  void abort(int code) const;

private:
  struct Session;
  std::vector<char> join_bytes(const std::vector<char>& bytes) const;

  std::shared_ptr<Session> session;
  int mine = 0, all = 1, cores = 1;
};

} // namespace spall
