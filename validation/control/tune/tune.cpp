#include "validation/control/tune/tune.h"

#include <algorithm>
#include <cmath>

#include "simulator/model/yaml_chain.h"
#include "simulator/trace/error.h"
#include "simulator/trace/number_text.h"
#include "validation/identify/optimise/cma_search.h"

namespace plumbline::validation {
namespace {

using model::YamlNode;

constexpr double kFallCosts = 20.0;
constexpr double kNoCycle = 30.0;  // deviation of a robot without a settled cycle, in tolerances

Searched read_searched(const YamlNode& node) {
  node.allow_keys({"names", "whole", "from", "to"});
  Searched searched;
  for (const YamlNode& name : node.at("names").items()) {
    searched.constants.push_back(name.text());
  }
  if (searched.constants.empty()) {
    node.at("names").refuse("an empty list", "at least one constant");
  }
  if (const auto whole = node.find("whole")) {
    searched.whole = whole->text() == "true";
  }
  if (const auto from = node.find("from")) {
    searched.lower = from->number();
  }
  if (const auto to = node.find("to")) {
    searched.upper = to->number();
  }
  return searched;
}

std::vector<double> multiplied(const run::ControllerSetup& setup, const std::vector<Searched>& searched,
                               const Eigen::VectorXd& factors) {
  std::vector<double> constants = setup.constants;
  for (std::size_t s = 0; s < searched.size(); ++s) {
    for (const std::string& name : searched[s].constants) {
      double& value = constants[setup.constant_index(name)];
      value *= factors[static_cast<Eigen::Index>(s)];
      value = std::clamp(value, searched[s].lower, searched[s].upper);
      value = searched[s].whole ? std::round(value) : value;
    }
  }
  return constants;
}

GaitView view_of(const PublishedGait& published) {
  GaitView view;
  view.gait = published.gait;
  view.where = published.where;
  for (const PublishedQuantity& quantity : quantities_of_a_cycle(published)) {
    view.measures.push_back(quantity.measure);
  }
  return view;
}

/// One generation: every set from every start, all on all cores or among the ranks.
std::vector<TuneResult> try_all(const PublishedGait& published, const std::vector<std::vector<double>>& sets,
                                const TuneOptions& options) {
  const GaitView view = view_of(published);
  const std::vector<run::LoadedScenario> starts = from_starts(published.loaded, options.starts, options.seed);
  std::vector<run::LoadedScenario> all;
  for (const std::vector<double>& set : sets) {
    for (run::LoadedScenario one : starts) {
      one.controller->constants = set;
      all.push_back(std::move(one));
    }
  }
  const std::vector<GaitRun> runs =
      run_gaits(all, view, {options.enough, options.run, options.stop, options.workers});
  const std::vector<PublishedQuantity> quantities = quantities_of_a_cycle(published);
  std::vector<TuneResult> results;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const auto begin = runs.begin() + static_cast<std::ptrdiff_t>(s * starts.size());
    const std::vector<GaitRun> own(begin, begin + static_cast<std::ptrdiff_t>(starts.size()));
    TuneResult result;
    result.constants = sets[s];
    result.cost = gait_cost(published.gait, own, options.enough, quantities);
    result.share = share_of("", own, options.enough);
    for (std::size_t q = 0; q < quantities.size(); ++q) {
      const auto cycles = settled_cycles(published.gait, own, quantities[q].foot);
      result.means.push_back(spread_of(values_of(cycles, q)).mean);
    }
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace

std::vector<PublishedQuantity> quantities_of_a_cycle(const PublishedGait& published) {
  std::vector<PublishedQuantity> all;
  std::copy_if(published.quantities.begin(), published.quantities.end(), std::back_inserter(all),
               [](const PublishedQuantity& q) { return q.measure.of() == Measure::Of::cycle; });
  return all;
}

TuneFile read_tune(const std::string& path) {
  const YamlNode root = YamlNode::load(path);
  check_format(root, "tune/1");
  root.allow_keys({"plumbline", "title", "published", "gait", "constants"});
  TuneFile file;
  file.file = path;
  const YamlNode published = root.at("published");
  file.published = model::beside(published.file(), published.text());
  file.gait = root.at("gait").text();
  for (const YamlNode& node : root.at("constants").items()) {
    file.searched.push_back(read_searched(node));
  }
  if (file.searched.empty()) {
    root.at("constants").refuse("an empty list", "at least one entry");
  }
  return file;
}

void check_searched(TuneFile& file, const run::ControllerSetup& setup) {
  const auto ports = setup.library.constants();
  for (Searched& searched : file.searched) {
    double lower = 0.0;
    double upper = INFINITY;
    for (const std::string& name : searched.constants) {
      const std::size_t c = setup.constant_index(name);
      lower = std::max(lower, ports[c].lower);
      upper = std::min(upper, ports[c].upper);
      if (!(setup.constants[c] > 0.0)) {
        throw InputError({file.file, 0, "constants"}, name + " = " + number_text(setup.constants[c]),
                         "a constant above zero: it is searched in the logarithm");
      }
    }
    searched.lower = std::max(searched.lower, lower);
    searched.upper = searched.upper > 0.0 ? std::min(searched.upper, upper) : upper;
    if (!(searched.lower <= searched.upper)) {
      throw InputError({file.file, 0, "constants"}, "no room for " + searched.constants.front(),
                       "from and to within the controller's limits");
    }
  }
}

double gait_cost(const Gait& gait, const std::vector<GaitRun>& runs, long enough,
                 const std::vector<PublishedQuantity>& quantities) {
  double missing = 0.0;
  for (const GaitRun& run : runs) {
    missing += 1.0 - std::min(1.0, static_cast<double>(run.cycles.size()) / static_cast<double>(enough));
  }
  double cost = kFallCosts * missing / static_cast<double>(runs.size());
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    const std::vector<const Cycle*> cycles = settled_cycles(gait, runs, quantities[q].foot);
    double square = cycles.empty() ? kNoCycle * kNoCycle : 0.0;
    for (const Cycle* cycle : cycles) {
      const double off = quantities[q].deviation(cycle->values[q]);
      square += off * off / static_cast<double>(cycles.size());
    }
    cost += std::log1p(square);
  }
  return cost;
}

TuneResult tune(const PublishedGait& published, const std::vector<Searched>& searched,
                const TuneOptions& options, const std::function<void(int, const TuneResult&)>& progress) {
  const run::ControllerSetup& around = *published.loaded.controller;
  CmaSearch search(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(searched.size())), options.width, 0,
                   options.seed);
  TuneResult best = try_all(published, {around.constants}, options).front();
  progress(0, best);
  try {
    for (int trial = 1; trial < options.trials; trial += search.population()) {
      const Eigen::MatrixXd candidates = search.ask();
      std::vector<std::vector<double>> sets;
      for (const auto& candidate : candidates.colwise()) {
        sets.push_back(multiplied(around, searched, candidate.array().exp()));
      }
      const std::vector<TuneResult> results = try_all(published, sets, options);
      Eigen::VectorXd costs(candidates.cols());
      for (std::size_t k = 0; k < results.size(); ++k) {
        costs[static_cast<Eigen::Index>(k)] = results[k].cost;
        best = results[k].cost < best.cost ? results[k] : best;
        progress(trial + static_cast<int>(k), results[k]);
      }
      search.tell(costs);
    }
  } catch (const Stopped&) {
    best.interrupted = true;
  }
  return best;
}

}  // namespace plumbline::validation
