// One case from the hidden effect to the verdict.
#pragma once

#include <cstdint>
#include <string>

#include "tests/battery/cases.h"
#include "validation/diagnose/diagnose.h"

namespace plumbline::battery {

constexpr double kVisible = 1.3;  ///< bare held-out error, in floors, from which an effect must be found
constexpr int kMostRivals = 2;    ///< a set of names with more rivals is no answer

struct Result {
  Case one;
  std::string with;   ///< what was hidden, as `plumbline twin --with` reads it; empty: nothing
  double bare = 0.0;  ///< held-out error of the model as it is, in floors; nothing fitted
  bool visible = false;
  std::string verdict;
  std::string first;    ///< first effect named, "coulomb@mLA"; empty: none
  std::string others;   ///< further accepted effects, joined by spaces
  int set_size = 0;     ///< the first name and its rivals
  bool in_set = false;  ///< the truth is the first name or one of its rivals
  /// hidden: named first, or in a set of at most kMostRivals rivals; none: nothing named; removed: no verdict
  /// "missing"
  bool right = false;
  double before = 0.0;  ///< held-out error with the model's own parameters fitted
  double after = 0.0;   ///< held-out error with all that was accepted
  double seconds = 0.0;
  std::vector<validation::RankRow> ranking, leads;  ///< first round's candidates; the last round's rejected
  std::string error;                                ///< why the case could not be run; empty otherwise
};

struct RunOptions {
  std::uint64_t seed = 1;
  bool bare_only = false;  ///< held-out trials only and no diagnosis
};

/// Never throws for a case that fails: the reason is in Result::error.
Result run_case(const Case& one, const RunOptions& options);

}  // namespace plumbline::battery
