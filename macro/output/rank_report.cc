#include "macro/output/rank_report.h"

#include "shared/traffic.h"

namespace spall {

RankReport::RankReport(const Simulation& run) : ranks(run.ranks().count()) {
  double owned = 0, ghosts = 0;
  for (const auto& solid : run.bodies.solids) {
    owned += static_cast<double>(solid->points.owned);
    ghosts += static_cast<double>(solid->ghosts.remote_points().size());
  }
  add("owned_points", owned, true);
  add("ghost_points", ghosts, true);
  add("compute_seconds", run.computing, true);
  const double each = run.own_steps > 0 ? 1 / static_cast<double>(run.own_steps) : 0;
  double messages = 0, bytes = 0;
  for (const MpiUse use : {MpiUse::velocities, MpiUse::forces, MpiUse::contact}) {
    messages += each * static_cast<double>(traffic_of(use).messages);
    bytes += each * static_cast<double>(traffic_of(use).bytes);
  }
  add("messages_per_step", messages, true);
  add("bytes_per_step", bytes, true);
  for (const MpiUse use : {MpiUse::velocities, MpiUse::forces, MpiUse::contact, MpiUse::refreshes,
                           MpiUse::looks, MpiUse::reductions}) {
    const Traffic sent = traffic_of(use);
    for (const auto& [what, count] : {std::pair{"messages", sent.messages},
                                      {"bytes", sent.bytes},
                                      {"collectives", sent.collectives},
                                      {"collective_bytes", sent.collective_bytes},
                                      {"gathered_bytes", sent.gathered_bytes}})
      add(std::string(what) + "_per_step_" + mpi_uses[static_cast<std::size_t>(use)],
          each * static_cast<double>(count), false);
  }
  Reduction all;
  for (Number& number : numbers) all.largest.push_back(&number.largest), all.sums.push_back(&number.sum);
  run.ranks().reduce(all);
}

void RankReport::add(const std::string& name, double value, bool with_mean) {
  numbers.push_back({name, value, value, with_mean});
}

void RankReport::add_to(Summary& summary) const {
  for (const Number& number : numbers) {
    summary.set(number.with_mean ? number.name + "_max" : number.name, number.largest);
    if (number.with_mean) summary.set(number.name + "_mean", number.sum / ranks);
    if (number.name == "compute_seconds")
      summary.set("imbalance", number.sum > 0 ? number.largest * ranks / number.sum : 1.0);
  }
}

} // namespace spall
