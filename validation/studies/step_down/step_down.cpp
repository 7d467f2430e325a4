#include "validation/studies/step_down/step_down.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "validation/control/gait/shared_runs.h"
#include "validation/studies/step_down/contact_intensity.h"

namespace plumbline::validation {
namespace {

constexpr double kFar = 1e4;  // m: the lower ground goes on so far

/// Follows the feet of one run.
class StepDownWatch {
 public:
  StepDownWatch(const StepDownTest& test, const run::LoadedScenario& scenario, StepDownRun& result)
      : test_(test),
        model_(scenario.model),
        finder_(test.gait, scenario.model.feet.size()),
        intensity_(test.design),
        result_(result) {}

  /// At each sample; true when the run is over.
  bool look(run::SampledRun& sampled) {
    const double t = sampled.simulation().time();
    const std::vector<model::Touch>& touches = sampled.simulation().touches();
    const Eigen::VectorXd state = sampled.simulation().state();
    follow_force(t, touches);
    bool over = false;
    if (finder_.look(t, touches) && before_.size() > 0) {
      over = touchdown(t, sampled.plant(), touches);
    }
    if (lower_ > 0) {
      const double torso = sampled.plant().position_of(test_.design.torso, state.data());
      result_.lowest_torso = std::min(result_.lowest_torso, torso);
      result_.highest_torso = std::max(result_.highest_torso, torso);
    }
    before_ = state;
    return over;
  }

 private:
  /// By trapezoids between samples.
  void follow_force(double t, const std::vector<model::Touch>& touches) {
    if (foot_ < 0) {
      return;
    }
    const double force = touches[static_cast<std::size_t>(foot_)].force.z();
    Touchdown& last = result_.touchdowns.back();
    if (t <= last.time + test_.force_time + 1e-9) {
      last.force_impulse += 0.5 * (force + force_) * (t - then_);
    }
    force_ = force;
    then_ = t;
  }

  bool touchdown(double t, model::Plant& plant, const std::vector<model::Touch>& touches) {
    foot_ = test_.gait.feet[static_cast<std::size_t>(finder_.foot())];
    const auto f = static_cast<std::size_t>(foot_);
    Touchdown now;
    now.time = t;
    now.lower = touches[f].position.x() >= test_.edge;
    now.impulse = intensity_.of(plant, before_, model_.feet[f].name);
    now.speed = plant.velocity_of(test_.design.base[0], before_.data());
    // The first sample in the ground is up to one sample late; the force began at most there.
    force_ = touches[f].force.z();
    then_ = t;
    result_.touchdowns.push_back(now);
    lower_ += now.lower ? 1 : 0;
    if (test_.fuse > 0.0 && now.impulse.z() > test_.fuse) {
      result_.outcome = StepDownRun::Outcome::broke;
      result_.end = fmt::format("the fuse in the {} shin breaks at {:.3f} s: {:.1f} N s", model_.feet[f].name,
                                t, now.impulse.z());
      return true;
    }
    if (lower_ >= test_.enough) {
      result_.outcome = StepDownRun::Outcome::passed;
      return true;
    }
    return false;
  }

  const StepDownTest& test_;
  const model::Model& model_;
  CycleFinder finder_;
  ContactIntensity intensity_;
  StepDownRun& result_;
  Eigen::VectorXd before_;  // state at the last sample
  long lower_ = 0;
  int foot_ = -1;
  double force_ = 0.0, then_ = 0.0;
};

std::string bytes_of(const StepDownRun& run) {
  work::Bytes bytes;
  bytes.add(static_cast<double>(run.outcome)).add(run.end).add(run.lowest_torso).add(run.highest_torso);
  for (const Touchdown& one : run.touchdowns) {
    bytes.add(one.time).add(one.lower ? 1.0 : 0.0).add(one.force_impulse).add(one.speed);
    bytes.add(one.impulse.x()).add(one.impulse.y()).add(one.impulse.z());
  }
  return bytes.all();
}

StepDownRun run_from(work::BytesReader& reader) {
  StepDownRun run;
  run.outcome = static_cast<StepDownRun::Outcome>(static_cast<int>(reader.number()));
  run.end = reader.text();
  run.lowest_torso = reader.number();
  run.highest_torso = reader.number();
  while (!reader.at_end()) {
    Touchdown one;
    one.time = reader.number();
    one.lower = reader.number() != 0.0;
    one.force_impulse = reader.number();
    one.speed = reader.number();
    for (double& axis : one.impulse) {
      axis = reader.number();
    }
    run.touchdowns.push_back(one);
  }
  return run;
}

}  // namespace

const Touchdown* StepDownRun::behind_edge(int n) const {
  for (const Touchdown& one : touchdowns) {
    if (one.lower && --n == 0) {
      return &one;
    }
  }
  return nullptr;
}

int StepDownShare::count(StepDownRun::Outcome outcome) const {
  return static_cast<int>(std::count_if(runs.begin(), runs.end(),
                                        [&](const StepDownRun& run) { return run.outcome == outcome; }));
}

StepDownRun step_down(const StepDownTest& test, const run::LoadedScenario& scenario, double height,
                      const StopFlag* stop) {
  StepDownRun result;
  result.lowest_torso = std::numeric_limits<double>::infinity();
  result.highest_torso = -result.lowest_torso;
  run::LoadedScenario there = scenario;
  if (height != 0.0) {
    there.scenario.terrain = contact::Terrain(0.0, {{test.edge, test.edge + kFar, -height}});
  }
  StepDownWatch watch(test, there, result);
  run::RunOptions options;
  options.watch = [&](run::SampledRun& sampled) {
    if (stop != nullptr && stop->raised) {
      throw Stopped();
    }
    return watch.look(sampled);
  };
  const run::RunRecord run = run::run_scenario(there.model, there.scenario, &*there.controller, options);
  if (result.outcome == StepDownRun::Outcome::not_reached && run.fell) {
    result.outcome = StepDownRun::Outcome::fell;
    result.end = run.end;
  }
  if (result.behind_edge(1) == nullptr && result.outcome != StepDownRun::Outcome::broke) {
    result.outcome = StepDownRun::Outcome::not_reached;
    result.end = run.end.empty() ? "no foot came down behind the edge" : run.end;
  }
  return result;
}

std::vector<StepDownShare> step_down_all(const StepDownTest& test, const StepDownOptions& options,
                                         const std::function<void(double)>& progress) {
  std::vector<run::LoadedScenario> starts{test.scenario};
  if (options.starts > 1) {
    starts = from_starts(test.scenario, options.starts, options.seed);
  }
  std::vector<StepDownShare> cells;
  for (const StepDownTest::Controller& controller : test.controllers) {
    for (const double height : test.heights) {
      cells.push_back({controller.name, height, std::vector<StepDownRun>(starts.size())});
    }
  }
  const std::size_t all = cells.size() * starts.size();
  const auto cell_of = [&](int run) { return static_cast<std::size_t>(run) / starts.size(); };
  const auto start_of = [&](int run) { return static_cast<std::size_t>(run) % starts.size(); };
  const auto result_of = [&](int run) -> StepDownRun& { return cells[cell_of(run)].runs[start_of(run)]; };
  SharedRuns shared{"step down", static_cast<int>(all), {}, {}, {}};
  shared.work = [&](int run) {
    run::LoadedScenario scenario = starts[start_of(run)];
    scenario.controller = test.controllers[cell_of(run) / test.heights.size()].setup;
    result_of(run) = step_down(test, scenario, cells[cell_of(run)].height, options.stop);
  };
  shared.result = [&](int run) { return bytes_of(result_of(run)); };
  shared.take = [&](int run, work::BytesReader& reader) { result_of(run) = run_from(reader); };
  share_runs(shared, {options.workers, options.stop},
             [&](int done) { progress(static_cast<double>(done) / static_cast<double>(all)); });
  return cells;
}

}  // namespace plumbline::validation
