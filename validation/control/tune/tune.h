// A search for constants of a controller that the publications leave out, which can be run again.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "validation/control/published/published.h"

namespace plumbline::validation {

/// One number that is searched: constants of the controller that share a factor.
struct Searched {
  std::vector<std::string> constants;  ///< each is multiplied by the same factor
  bool whole = false;                  ///< rounded to whole numbers
  double lower = 0.0, upper = 0.0;     ///< SI, within which each is held
};

/// What is searched, as a file says it.
struct TuneFile {
  std::string file, published, gait;
  std::vector<Searched> searched;
};

/// Reads `plumbline: tune/1`: `published` (file), `gait` and a list `constants` of {names: [..]} or
/// {names: [..], whole: true, from: .., to: ..}. Throws InputError.
TuneFile read_tune(const std::string& path);

/// Limits of the searched constants, from the library's ports where the file gives none; throws InputError
/// for constants that the controller does not have or that are not above zero: they are searched in the
/// logarithm.
void check_searched(TuneFile& file, const run::ControllerSetup& setup);

struct TuneOptions {
  int trials = 60;     ///< sets tried
  int starts = 8;      ///< runs for each
  long enough = 40;    ///< cycles that end a run
  double width = 0.4;  ///< standard deviation of the first sets, in the logarithm
  std::uint64_t seed = 1;
  run::RunOptions run;
  const StopFlag* stop = nullptr;
  work::Workers* workers = nullptr;  ///< of several ranks: the runs of a generation are shared among them
};

struct TuneResult {
  std::vector<double> constants;  ///< all of the controller, in the order of its library
  double cost = 0.0;
  Share share;
  std::vector<double> means;  ///< over the settled cycles, one for each published quantity of a cycle
  bool interrupted = false;   ///< TuneOptions::stop was raised before all sets were tried
};

/// 20 (1 - mean over the runs of min(cycles, enough)/enough) + sum over the quantities of a cycle of log(1 +
/// mean d^2), d how far a settled cycle is from what was published, in units of its tolerance (0 on the right
/// side of a limit; 30 without a settled cycle). Falling costs more than any one quantity, and a gait that
/// wanders costs more than a steady one of the same mean.
double gait_cost(const Gait& gait, const std::vector<GaitRun>& runs, long enough,
                 const std::vector<PublishedQuantity>& quantities);

/// Looks for the searched constants in the logarithm about those of the gait's controller, by CmaSearch on
/// gait_cost. Returns the cheapest set that was tried, also when it is interrupted; before the first is tried
/// Stopped is thrown. Deterministic for a seed. `progress` is told of each set in its order.
TuneResult tune(const PublishedGait& published, const std::vector<Searched>& searched,
                const TuneOptions& options, const std::function<void(int, const TuneResult&)>& progress);

/// The quantities that count in the cost, in their order.
std::vector<PublishedQuantity> quantities_of_a_cycle(const PublishedGait& published);

}  // namespace plumbline::validation
