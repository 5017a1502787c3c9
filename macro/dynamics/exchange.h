#pragma once

#include "macro/contact/contact_report.h"
#include "macro/contact/held_points.h"

#include <algorithm>
#include <vector>

namespace spall {

/// What the bodies have exchanged by contact, and what their supports have given them. Bodies are numbered as
/// in Bodies: solids first, then rigid ones.
struct Exchange {
  ImpulseMatrix of_step, of_run;              ///< in the last step, and so far, N s
  Reaction reaction_of_step, reaction_of_run; ///< of all supports on the bodies
  double deepest_overlap = 0;                 ///< over the run, m
  double gap_max = 0;                         ///< of touching points, over the run, m
  double gap_sum = 0;                         ///< |gap| of touching points, over the run, m
  double gap_count = 0;
  double largest_drift = 0; ///< of bonded points from the places where they are held, over the run, m

  double mean_gap() const { return gap_count > 0 ? gap_sum / gap_count : 0; } ///< m

  void count(const ContactReport& report) {
    deepest_overlap = std::max(deepest_overlap, report.deepest);
    gap_sum += report.gap_sum;
    gap_count += static_cast<double>(report.touching);
    gap_max = std::max(gap_max, report.gap_max);
    largest_drift = std::max(largest_drift, report.largest_drift);
  }
  /// The supports in a step.
  void count(const std::vector<Reaction>& supports) {
    reaction_of_step = Reaction();
    for (const Reaction& support : supports) reaction_of_step += support;
    reaction_of_run += reaction_of_step;
  }
  void transfer(Archive& archive) {
    of_step.transfer(archive);
    of_run.transfer(archive);
    for (Reaction* reaction : {&reaction_of_step, &reaction_of_run}) archive("exchange", *reaction);
    for (double* part : {&deepest_overlap, &gap_max, &gap_sum, &gap_count, &largest_drift})
      archive("exchange", *part);
  }
};

} // namespace spall
