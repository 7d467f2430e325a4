// What the battery found: the table while it runs, the summary against the targets, and both as files.
#pragma once

#include <string>
#include <vector>

#include "tests/battery/run_case.h"

namespace plumbline::battery {

/// So many of so many.
struct Count {
  int of = 0, met = 0;
  void add(bool holds) {
    ++of;
    met += holds ? 1 : 0;
  }
  double share() const { return of == 0 ? 1.0 : static_cast<double>(met) / of; }
};

struct Targets {
  double clear = 0.95;       ///< share of right names, visible cases of medium and strong effects
  double weak = 0.75;        ///< the same, weak effects
  double overall = 0.90;     ///< the same, all together
  int named_on_none = 0;     ///< effects named where nothing is hidden
  double pairs = 0.80;       ///< share of pairs with both found and none invented
  double unknown = 0.90;     ///< share of laws outside the catalogue without a confident wrong name
  double after = 1.1;        ///< median held-out error after a right answer, in floors
  double each_after = 1.15;  ///< from here an error after a right answer is counted as too large
  double intervals_from = 0.90, intervals_to = 0.99;  ///< share of 95 % intervals that hold the truth
  double seconds = 60.0;                              ///< median time of a case
};

struct Summary {
  int hidden = 0;              ///< cases with one effect, visible or not
  Count clear, weak, first;    ///< visible ones; `first`: named first among the right ones
  Count none, pairs, unknown;  ///< none: with nothing named
  int in_larger_set = 0;       ///< visible ones that are not right, but in the set that was named
  Count at_floor;              ///< right ones with an error below Targets::each_after
  Count intervals;
  /// Whether visible or not; `alone`: of the visible ones those named themselves and not only by a set of
  /// names that the data cannot tell apart; `clean`: of the right ones those with nothing else named beside.
  Count clear_of_all, weak_of_all, alone, clean;
  Count silent;  ///< outside the catalogue: nothing named, not even as a part of an unexplained answer
  std::vector<double> after;  ///< held-out errors of right single cases
  std::vector<double> seconds, processor_seconds;
  int errors = 0;

  Count overall() const { return {clear.of + weak.of, clear.met + weak.met}; }
};

/// 0 without values.
double median(std::vector<double> values);

Summary summarise(const std::vector<Result>& results, const Targets& targets);
/// A target that no case touches is met; a case that could not be run misses them all.
bool targets_met(const Summary& summary, const Targets& targets);

std::string table_head();
std::string table_line(const Result& result);
/// The candidates of the first round and those rejected in the last one, with why: for whoever improves the
/// diagnosis.
std::string explanation(const Result& result);
std::string summary_text(const Summary& summary, const Targets& targets);
/// For every hidden law how often it was right and which other names were given, of the visible cases.
std::string confusion_text(const std::vector<Result>& results);

/// Throw std::runtime_error when the file cannot be written.
void write_json(const std::string& file, const std::vector<Result>& results, const Summary& summary,
                const Targets& targets, std::uint64_t seed);
void write_csv(const std::string& file, const std::vector<Result>& results);

}  // namespace plumbline::battery
