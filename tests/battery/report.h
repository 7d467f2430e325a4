// What the battery found: the table while it runs, the summary against the targets, and both as files.
#pragma once

#include <string>
#include <vector>

#include "tests/battery/run_case.h"

namespace plumbline::battery {

struct Targets {
  double right_share = 0.90;  ///< least share of visible hidden effects that must be right
  double floor = 1.15;        ///< most that the held-out error may be after a right answer, in floors
  int named_on_none = 0;      ///< most effects named where nothing is hidden
  int confident_wrong = 1;  ///< most wrong names with verdict "missing" where the law is not in the catalogue
};

struct Summary {
  int hidden = 0, visible = 0, right = 0, first = 0;
  int above_floor = 0;  ///< right, but above Targets::floor
  double worst_after = 0.0;
  int none = 0, named_on_none = 0;
  int removed = 0, confident_wrong = 0;
  int errors = 0;
  double seconds = 0.0;
};

Summary summarise(const std::vector<Result>& results, const Targets& targets);
/// A target that no case touches is met; a case that could not be run misses them all.
bool targets_met(const Summary& summary, const Targets& targets);

std::string table_head();
std::string table_line(const Result& result);
/// The candidates of the first round and those rejected in the last one, with why: for whoever improves the
/// diagnosis.
std::string explanation(const Result& result);
std::string summary_text(const Summary& summary, const Targets& targets);

/// Throw std::runtime_error when the file cannot be written.
void write_json(const std::string& file, const std::vector<Result>& results, const Summary& summary,
                const Targets& targets, std::uint64_t seed);
void write_csv(const std::string& file, const std::vector<Result>& results);

}  // namespace plumbline::battery
