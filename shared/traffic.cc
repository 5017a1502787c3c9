#include "shared/traffic.h"

#include <mpi.h>

#include <ctime>

namespace spall {
namespace {

// Plain variables suffice, because only the main thread calls MPI.
std::array<Traffic, mpi_uses.size()> counts;
MpiUse present = MpiUse::other;
double inside = 0;

Traffic& now() { return counts[static_cast<std::size_t>(present)]; }

std::size_t size_of(int count, MPI_Datatype type) {
  int size = 0;
  PMPI_Type_size(type, &size);
  return static_cast<std::size_t>(count) * static_cast<std::size_t>(size);
}

double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Adds the processor time between its construction and its end to `inside`.
struct Inside {
  double begin = thread_seconds();
  ~Inside() { inside += thread_seconds() - begin; }
};

void count_message(int count, MPI_Datatype type, int to, MPI_Comm comm) {
  int self = to;
  PMPI_Comm_rank(comm, &self);
  if (to == self || to == MPI_PROC_NULL) return;
  ++now().messages;
  now().bytes += size_of(count, type);
}

void count_collective(std::size_t bytes) {
  ++now().collectives;
  now().collective_bytes += bytes;
}

void count_gathering(std::size_t bytes) {
  count_collective(bytes);
  now().gathered_bytes += bytes;
}

} // namespace

Traffic traffic_of(MpiUse use) { return counts[static_cast<std::size_t>(use)]; }
double seconds_in_mpi() { return inside; }

TrafficOf::TrafficOf(MpiUse use) : before(present) {
  if (present == MpiUse::other) present = use;
}
TrafficOf::~TrafficOf() { present = before; }

} // namespace spall

// These functions replace MPI's own ones, for deal.II's calls too, and pass every call on. Functions that
// send nothing and functions that nothing here uses are not replaced.
extern "C" {

using spall::count_collective;
using spall::count_gathering;
using spall::count_message;
using spall::Inside;
using spall::size_of;

int MPI_Send(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  const Inside timer;
  count_message(count, type, to, comm);
  return PMPI_Send(data, count, type, to, tag, comm);
}
int MPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
              MPI_Request* request) {
  const Inside timer;
  count_message(count, type, to, comm);
  return PMPI_Isend(data, count, type, to, tag, comm, request);
}
int MPI_Issend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
               MPI_Request* request) {
  const Inside timer;
  count_message(count, type, to, comm);
  return PMPI_Issend(data, count, type, to, tag, comm, request);
}

int MPI_Allreduce(const void* data, void* result, int count, MPI_Datatype type, MPI_Op operation,
                  MPI_Comm comm) {
  const Inside timer;
  count_collective(size_of(count, type));
  return PMPI_Allreduce(data, result, count, type, operation, comm);
}
int MPI_Reduce(const void* data, void* result, int count, MPI_Datatype type, MPI_Op operation, int root,
               MPI_Comm comm) {
  const Inside timer;
  count_collective(size_of(count, type));
  return PMPI_Reduce(data, result, count, type, operation, root, comm);
}
int MPI_Bcast(void* data, int count, MPI_Datatype type, int root, MPI_Comm comm) {
  const Inside timer;
  count_collective(size_of(count, type));
  return PMPI_Bcast(data, count, type, root, comm);
}
int MPI_Allgather(const void* data, int count, MPI_Datatype type, void* result, int received,
                  MPI_Datatype received_type, MPI_Comm comm) {
  const Inside timer;
  count_gathering(size_of(count, type));
  return PMPI_Allgather(data, count, type, result, received, received_type, comm);
}
int MPI_Allgatherv(const void* data, int count, MPI_Datatype type, void* result, const int* received,
                   const int* places, MPI_Datatype received_type, MPI_Comm comm) {
  const Inside timer;
  count_gathering(size_of(count, type));
  return PMPI_Allgatherv(data, count, type, result, received, places, received_type, comm);
}
int MPI_Exscan(const void* data, void* result, int count, MPI_Datatype type, MPI_Op operation,
               MPI_Comm comm) {
  const Inside timer;
  count_collective(size_of(count, type));
  return PMPI_Exscan(data, result, count, type, operation, comm);
}
int MPI_Barrier(MPI_Comm comm) {
  const Inside timer;
  count_collective(0);
  return PMPI_Barrier(comm);
}
int MPI_Ibarrier(MPI_Comm comm, MPI_Request* request) {
  const Inside timer;
  count_collective(0);
  return PMPI_Ibarrier(comm, request);
}

// In the following functions a process waits for the others.
int MPI_Recv(void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Status* status) {
  const Inside timer;
  return PMPI_Recv(data, count, type, from, tag, comm, status);
}
int MPI_Wait(MPI_Request* request, MPI_Status* status) {
  const Inside timer;
  return PMPI_Wait(request, status);
}
int MPI_Waitall(int count, MPI_Request requests[], MPI_Status statuses[]) {
  const Inside timer;
  return PMPI_Waitall(count, requests, statuses);
}
int MPI_Waitany(int count, MPI_Request requests[], int* index, MPI_Status* status) {
  const Inside timer;
  return PMPI_Waitany(count, requests, index, status);
}
int MPI_Test(MPI_Request* request, int* done, MPI_Status* status) {
  const Inside timer;
  return PMPI_Test(request, done, status);
}
int MPI_Probe(int from, int tag, MPI_Comm comm, MPI_Status* status) {
  const Inside timer;
  return PMPI_Probe(from, tag, comm, status);
}
int MPI_Iprobe(int from, int tag, MPI_Comm comm, int* found, MPI_Status* status) {
  const Inside timer;
  return PMPI_Iprobe(from, tag, comm, found, status);
}
}
