#include "validation/studies/running/ladder.h"

#include <algorithm>
#include <cmath>

#include "simulator/model/plain_number.h"
#include "simulator/model/yaml_chain.h"
#include "simulator/model/yaml_node.h"
#include "simulator/run/scenario.h"
#include "validation/control/gait/gait_run.h"
#include "validation/studies/running/published_running.h"
#include "validation/studies/running/return_map.h"

namespace plumbline::validation {
namespace {

using model::YamlNode;

// Strides behind the push between which the contraction is taken: the fast multipliers are gone, the slow one
// is above what counts leave.
constexpr std::size_t kFirst = 3, kLast = 14, kLeast = 2;
constexpr double kNoise = 0.02;  // of the push
constexpr double kAbove = 2.0;   // times the wandering of a run that is not pushed

LadderRung read_rung(const YamlNode& node) {
  node.allow_keys({"name", "model", "controller", "period", "counts", "set"});
  LadderRung rung;
  rung.name = node.at("name").text();
  const auto file = [&](const char* key) {
    const auto found = node.find(key);
    return found ? model::beside(node.file(), found->text()) : std::string();
  };
  rung.model = file("model");
  rung.controller = file("controller");
  if (const auto period = node.find("period")) {
    rung.period = model::read_positive(*period, "s");
  }
  if (const auto counts = node.find("counts")) {
    rung.counts = counts->flag();
  }
  if (const auto set = node.find("set")) {
    for (const auto& [name, value] : set->entries()) {
      rung.set.emplace_back(name, value.number());
    }
  }
  return rung;
}

/// The motion in continuous time on its paper's model.
RungResult on_paper(const RunningLadder& ladder) {
  const PublishedRunning published = read_published_running(ladder.paper);
  RungResult result;
  result.name = published.title;
  const monopod::Gait& gait = published.running.gait;
  std::vector<StrideFacts> facts;
  const auto sections = touchdowns(published.model, gait, gait.section, static_cast<int>(ladder.cycles) + 1,
                                   kIntegrationStep, &facts);
  result.steps = static_cast<long>(sections.size()) - 1;
  result.fell = result.steps < ladder.cycles;
  result.end = result.fell ? "fell" : "";
  if (!facts.empty()) {
    result.period = facts.back().stance + facts.back().flight;
    result.speed = sections.back()[6];
  }
  result.contraction = multipliers(linear_return(published.model, gait, kIntegrationStep).by_state).front();
  return result;
}

class Climber {
 public:
  Climber(const RunningLadder& ladder, const StopFlag* stop) : ladder_(ladder), stop_(stop) {}

  RungResult run(const LadderRung& rung) const {
    run::LoadedScenario loaded = run::read_scenario(ladder_.scenario, {rung.model, rung.controller});
    if (!loaded.controller) {
      throw InputError({ladder_.scenario, 0, "controller"}, "none", "a running controller");
    }
    if (rung.period > 0.0) {
      loaded.controller->period = rung.period;
    }
    for (const auto& [name, value] : rung.set) {
      loaded.controller->set(name, value);
    }
    const GaitRun nominal = walk(loaded, rung);
    RungResult result;
    result.name = rung.name;
    result.steps = static_cast<long>(nominal.cycles.size());
    result.fell = nominal.run.fell;
    result.end = nominal.run.end;
    for (const Cycle& cycle : nominal.cycles) {
      result.period = cycle.values[0];
      result.speed = cycle.values[1];
    }
    double* speed = loaded.scenario.start.velocity(ladder_.pushed);
    if (speed == nullptr) {
      throw InputError({ladder_.file, 0, "push"}, "\"" + ladder_.pushed + "\"",
                       "a velocity that the scenario's start states");
    }
    *speed += ladder_.push;
    contract(nominal, walk(loaded, rung), result);
    return result;
  }

 private:
  GaitRun walk(const run::LoadedScenario& loaded, const LadderRung& rung) const {
    const auto gait = read_gait(loaded);
    if (!gait) {
      throw InputError({ladder_.scenario, 0, "gait"}, "no gait", "one, to know its steps by");
    }
    GaitView view;
    view.gait = *gait;
    view.where = {ladder_.scenario, 0, "quantities"};
    Measure duration, speed;
    speed.kind = Measure::Kind::rate;
    speed.channels = {"travel"};
    speed.text = "rate of travel";
    view.measures = {duration, speed};
    GaitOptions options;
    options.enough = ladder_.cycles;
    options.run.sensors.quantise = rung.counts;
    options.stop = stop_;
    return run_gait(loaded, view, options);
  }

  /// By how much the speed of a run that is not pushed changes from stride to stride once it has settled,
  /// m/s: root mean square. A push that has come down to it can no longer be followed.
  static double wandering(const GaitRun& run) {
    double sum = 0.0;
    const std::size_t begin = run.cycles.size() / 2, end = run.cycles.size();
    for (std::size_t k = begin + 1; k < end; ++k) {
      sum += std::pow(run.cycles[k].values[1] - run.cycles[k - 1].values[1], 2);
    }
    return end > begin + 1 ? std::sqrt(sum / static_cast<double>(end - begin - 1)) : 0.0;
  }

  void contract(const GaitRun& nominal, const GaitRun& pushed, RungResult& result) const {
    const auto off = [&](std::size_t k) {
      return std::abs(pushed.cycles[k].values[1] - nominal.cycles[k].values[1]);
    };
    const std::size_t count = std::min(nominal.cycles.size(), pushed.cycles.size());
    const double floor = std::max(kNoise * std::abs(ladder_.push), kAbove * wandering(nominal));
    std::size_t last = kFirst;
    while (last + 1 < count && last < kLast && off(last + 1) > floor) {
      ++last;
    }
    if (nominal.run.fell || pushed.run.fell) {
      result.no_contraction = "it falls";
    } else if (last < kFirst + kLeast) {
      result.no_contraction = floor > kNoise * std::abs(ladder_.push) ? "lost in noise" : "gone at once";
    } else {
      result.contraction = std::pow(off(last) / off(kFirst), 1.0 / static_cast<double>(last - kFirst));
    }
  }

  const RunningLadder& ladder_;
  const StopFlag* stop_;
};

}  // namespace

RunningLadder read_running_ladder(const std::string& path) {
  const YamlNode root = YamlNode::load(path);
  model::check_format(root, "running_ladder/1");
  root.allow_keys({"plumbline", "title", "scenario", "paper", "cycles", "push", "rungs"});
  RunningLadder ladder;
  ladder.file = path;
  ladder.title = root.at("title").text();
  ladder.scenario = model::beside(path, root.at("scenario").text());
  if (const auto paper = root.find("paper")) {
    ladder.paper = model::beside(path, paper->text());
  }
  const double cycles = root.at("cycles").number();
  if (!(cycles >= 1.0 && cycles <= 1e6)) {
    root.at("cycles").refuse("a number from 1 to 1000000");
  }
  ladder.cycles = static_cast<long>(cycles);
  const YamlNode push = root.at("push");
  push.allow_keys({"of", "value", "unit", "assumed", "source"});
  ladder.pushed = push.at("of").text();
  ladder.push = model::read_number(push, "m/s", {"of"});
  for (const YamlNode& item : root.at("rungs").items()) {
    ladder.rungs.push_back(read_rung(item));
  }
  return ladder;
}

std::vector<RungResult> climb(const RunningLadder& ladder, const StopFlag* stop,
                              const std::function<void(const RungResult&)>& done) {
  std::vector<RungResult> results;
  const auto add = [&](const RungResult& result) {
    results.push_back(result);
    done(results.back());
  };
  if (!ladder.paper.empty()) {
    add(on_paper(ladder));
  }
  const Climber climber(ladder, stop);
  for (const LadderRung& rung : ladder.rungs) {
    add(climber.run(rung));
  }
  return results;
}

}  // namespace plumbline::validation
