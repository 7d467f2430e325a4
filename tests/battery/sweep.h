// What each constant of the diagnosis' policy decides.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/battery/run_case.h"

namespace plumbline::battery {

/// A constant at another value, over all cases.
struct Swept {
  std::string constant;
  double value = 0.0;
  int changed = 0;       ///< cases with another verdict or other names
  int lost = 0;          ///< right before, wrong now
  int won = 0;           ///< wrong before, right now
  double seconds = 0.0;  ///< beyond what the diagnoses before it of the same cases have estimated
};

/// A diagnosis under a policy: a case of the battery, or measurements.
using Diagnose = std::function<Result(const RunOptions&)>;

/// Each is diagnosed with the policy as it is, then with half and twice the value of one constant at a time
/// (PolicyConstant::scale). What a diagnosis has estimated serves the others of the same data.
std::vector<Swept> sweep(const std::vector<Diagnose>& all, const RunOptions& options);
/// The same with one constant at a time taken away (PolicyConstant::absent).
std::vector<Swept> take_away(const std::vector<Diagnose>& all, const RunOptions& options);
std::string sweep_text(const std::vector<Swept>& swept, std::size_t diagnoses);

}  // namespace plumbline::battery
