#include "shared/ranks.h"

#include "shared/error.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace spall {

namespace mpi = dealii::Utilities::MPI;

namespace {

/// Returns whether the environment shows that a launcher (Open MPI, MPICH and its relatives, Slurm) started
/// several processes.
bool several_started() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"})
    if (const char* value = std::getenv(name)) return std::atoi(value) > 1;
  return false;
}

} // namespace

struct Ranks::Session {
  mpi::MPI_InitFinalize running;
};

Ranks::Ranks(int& argc, char**& argv) {
  if (several_started()) {
    session.reset(new Session{{argc, argv, dealii::numbers::invalid_unsigned_int}});
    mine = static_cast<int>(mpi::this_mpi_process(MPI_COMM_WORLD));
    all = static_cast<int>(mpi::n_mpi_processes(MPI_COMM_WORLD));
  }
  cores = static_cast<int>(dealii::MultithreadInfo::n_threads());
}

double Ranks::sum(double value) const { return all > 1 ? mpi::sum(value, MPI_COMM_WORLD) : value; }

void Ranks::sum(std::vector<double>& values) const {
  if (all > 1) mpi::sum(values, MPI_COMM_WORLD, values);
}

double Ranks::min(double value) const { return all > 1 ? mpi::min(value, MPI_COMM_WORLD) : value; }

double Ranks::max(double value) const { return all > 1 ? mpi::max(value, MPI_COMM_WORLD) : value; }

void Ranks::max(std::vector<double>& values) const {
  if (all > 1) mpi::max(values, MPI_COMM_WORLD, values);
}

bool Ranks::any(bool value) const { return all > 1 ? mpi::max(value ? 1 : 0, MPI_COMM_WORLD) > 0 : value; }

void Ranks::reduce(const Reduction& numbers) const {
  if (all == 1) return;
  std::vector<double> values;
  for (const auto* list : {&numbers.sums, &numbers.largest, &numbers.smallest})
    for (const double* number : *list) values.push_back(*number);
  for (const std::size_t* count : numbers.counts) values.push_back(static_cast<double>(*count));
  const std::vector<mpi::MinMaxAvg> together = mpi::min_max_avg(values, MPI_COMM_WORLD);
  auto next = together.cbegin();
  for (double* number : numbers.sums) *number = next++->sum;
  for (double* number : numbers.largest) *number = next++->max;
  for (double* number : numbers.smallest) *number = next++->min;
  for (std::size_t* count : numbers.counts) *count = static_cast<std::size_t>(next++->sum);
}

std::vector<std::string> Ranks::gather(const std::vector<std::string>& lines) const {
  if (all == 1) return lines;
  std::vector<std::string> together;
  for (const auto& part : mpi::all_gather(MPI_COMM_WORLD, lines))
    together.insert(together.end(), part.begin(), part.end());
  return together;
}

std::vector<char> Ranks::join_bytes(const std::vector<char>& bytes) const {
  // Every rank fills its own part of a list of zeros, and the sum of all lists is the whole list. deal.II's
  // gather would compress the bytes first, which takes longer than the message.
  std::vector<std::uint64_t> counts(static_cast<std::size_t>(all));
  counts[static_cast<std::size_t>(mine)] = bytes.size();
  mpi::sum(counts, MPI_COMM_WORLD, counts);
  const auto first = std::accumulate(counts.begin(), counts.begin() + mine, std::uint64_t{0});
  std::vector<char> together(std::accumulate(counts.begin() + mine, counts.end(), first));
  if (together.empty()) return together;
  // Two ranks may fill different bytes of the same word: the sum keeps both, as all other ranks add 0 there.
  std::vector<std::uint64_t> words((together.size() + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t));
  std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(words.data()) + first);
  mpi::sum(words, MPI_COMM_WORLD, words);
  std::copy_n(reinterpret_cast<const char*>(words.data()), together.size(), together.begin());
  return together;
}

Share Ranks::share(std::size_t count) const {
  Share share{.first = 0, .count = count, .all = 0};
  const std::vector<std::uint64_t> counts = join(std::vector<std::uint64_t>{count});
  for (std::size_t r = 0; r < counts.size(); ++r) {
    if (r < static_cast<std::size_t>(mine)) share.first += counts[r];
    share.all += counts[r];
  }
  return share;
}

void Ranks::on_all(const std::function<void()>& action) const {
  if (all == 1) return action();
  std::vector<std::string> error;
  try {
    action();
  } catch (const InputError& e) {
    error = {"input", e.what()};
  } catch (const OutputError& e) {
    error = {"output", e.what()};
  } catch (const std::exception& e) {
    error = {"other", e.what()};
  }
  if (!any(!error.empty())) return;
  error = gather(error);
  if (error[0] == "input") throw InputError(error[1]);
  if (error[0] == "output") throw OutputError(error[1]);
  throw ComputationError(error[1]);
}

void Ranks::on_one(int rank, const std::function<void()>& action) const {
  on_all([&] {
    if (mine == rank) action();
  });
}

void Ranks::abort(int code) const {
  if (all > 1) MPI_Abort(MPI_COMM_WORLD, code);
}

} // namespace spall
