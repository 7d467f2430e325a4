// A scenario run until it falls or has made enough cycles, measured cycle by cycle.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "simulator/run/run_scenario.h"
#include "validation/control/gait/gait.h"
#include "validation/control/gait/measure.h"
#include "validation/identify/predict/problem.h"

namespace plumbline::work {
class Workers;
}

namespace plumbline::validation {

/// One cycle and what was measured on it.
struct Cycle {
  double begin = 0.0, end = 0.0;        ///< s
  int foot = -1;                        ///< whose touchdown began it, index in Gait::feet
  std::vector<double> values;           ///< one for each measure, SI; 0 for those that are not of a cycle
  std::vector<Eigen::VectorXd> curves;  ///< one for each CurveView, at its points; NaN behind the cycle's end
};

struct GaitRun {
  run::RunRecord run;
  std::vector<Cycle> cycles;
};

/// A channel that is kept as a curve over the cycle.
struct CurveView {
  std::string channel;
  Eigen::VectorXd at;        ///< s since the cycle's beginning, or shares of it (0 to 1)
  bool over_shares = false;  ///< `at` are shares
};

/// What is looked at.
struct GaitView {
  Gait gait;
  std::vector<Measure> measures;
  std::vector<CurveView> curves;
  Place_in_file where;  ///< of the measures, for messages
};

struct GaitOptions {
  long enough = 100;  ///< cycles that end the run; 0: the scenario's length alone
  run::RunOptions run;
  const StopFlag* stop = nullptr;    ///< raised: Stopped is thrown
  work::Workers* workers = nullptr;  ///< of several ranks: run_gaits has each run done by one of them
};

/// Throws InputError as run_scenario does, and for channels that there are not.
GaitRun run_gait(const run::LoadedScenario& loaded, const GaitView& view, const GaitOptions& options);

/// One run for each of the loaded scenarios (another start, another controller, another robot), on all cores
/// or among the ranks; between ranks goes what gait_bytes.h says. `progress` is told how many are done.
std::vector<GaitRun> run_gaits(const std::vector<run::LoadedScenario>& all, const GaitView& view,
                               const GaitOptions& options, const std::function<void(int)>& progress = {});

/// The scenario from `count` random starts.
std::vector<run::LoadedScenario> from_starts(const run::LoadedScenario& loaded, int count,
                                             std::uint64_t seed);

/// Cycles behind the transient and before a fall (Gait::settle, before_fall). `foot`: only those that this
/// foot's touchdown began (index in Gait::feet); -1: all.
std::vector<const Cycle*> settled_cycles(const Gait& gait, const std::vector<GaitRun>& runs, int foot = -1);

/// Mean and standard deviation over cycles of one of their curves, point by point, and how many cycles last
/// so long. NaN where none does.
struct MeanCurve {
  Eigen::VectorXd mean, deviation;
  Eigen::VectorXi count;
};
MeanCurve mean_curve(const std::vector<const Cycle*>& cycles, std::size_t curve);

/// How many runs went on long enough.
struct Share {
  std::string what;
  int sustained = 0, runs = 0;
  double median_cycles = 0.0;
};
Share share_of(const std::string& what, const std::vector<GaitRun>& runs, long enough);

/// Values of one measure over cycles.
std::vector<double> values_of(const std::vector<const Cycle*>& cycles, std::size_t measure);

}  // namespace plumbline::validation
