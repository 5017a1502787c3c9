#pragma once

#include "shared/summary.h"

#include <string>

namespace spall {

/// What of an answer does not change any more at the end of a run, and what may still change: lists of names.
struct Settlement {
  std::string settled, not_settled;
  std::string remark = {}; ///< on what may still change: at which moment it was measured, or why it was not

  /// @param prefix of the names
  void add_to(Summary& summary, const std::string& prefix) const {
    summary.set(prefix + "settled", settled);
    summary.set(prefix + "not_settled", not_settled);
    summary.set(prefix + "not_settled_remark", remark);
  }
  std::string in_words() const {
    std::string words = settled.empty() ? "" : "settled: " + settled;
    if (!not_settled.empty()) words += (words.empty() ? "" : "; ") + ("not settled: " + not_settled);
    return words + (remark.empty() ? "" : " (" + remark + ")");
  }
};

} // namespace spall
