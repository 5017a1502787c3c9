#pragma once

#include <memory>
#include <string>
#include <vector>

namespace spall {

/// The processes that mpirun (or srun) started together. MPI itself is started only if there are several: a
/// single microcell takes less time than that.
class Ranks {
public:
  Ranks(int& argc, char**& argv);
  ~Ranks();

  int rank() const { return mine; }
  int count() const { return all; }
  bool first() const { return mine == 0; }
  int threads() const { return cores; } ///< so that the ranks on a machine use all of it

  // All ranks must call these together.
  double sum(double value) const;
  bool any(bool value) const;
  /// Lines of every rank, in the order of the ranks.
  std::vector<std::string> gather(const std::vector<std::string>& lines) const;

private:
  struct Session;
  std::unique_ptr<Session> session;
  int mine = 0, all = 1, cores = 1;
};

} // namespace spall
