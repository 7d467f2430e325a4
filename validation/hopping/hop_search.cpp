#include "validation/hopping/hop_search.h"

#include <algorithm>
#include <cmath>

#include "validation/hopping/cma_search.h"
#include "validation/predict/problem.h"

namespace plumbline::validation {
namespace {

using controllers::HoppingConfig;

constexpr double kFallCosts = 20.0;
constexpr double kNoHop = 30.0;  // deviation of a robot without a settled hop, in tolerances
constexpr double kShortest = 2.0,
                 kLongest = 12.0;  // samples; longer is later than the legs' own motion allows

std::vector<Searched> leg_values(const controllers::HoppingLegGains& gains, const std::string& side) {
  return {{"kp_LA" + side, gains.kp_LA},
          {"kd_LA" + side, gains.kd_LA},
          {"kp_mLS" + side, gains.kp_mLS},
          {"kd_mLS" + side, gains.kd_mLS}};
}

void multiply_gains(controllers::HoppingLegGains& gains, const Eigen::VectorXd& factors, Eigen::Index first) {
  gains.kp_LA *= factors[first];
  gains.kd_LA *= factors[first + 1];
  gains.kp_mLS *= factors[first + 2];
  gains.kd_mLS *= factors[first + 3];
}

/// In the order of searched_values.
HoppingConfig multiply(HoppingConfig config, const Eigen::VectorXd& factors, bool sides) {
  multiply_gains(config.left, factors, 0);
  multiply_gains(config.right, factors, sides ? 4 : 0);
  const Eigen::Index next = sides ? 8 : 4;
  config.parameters.K_T *= factors[next];
  const auto length = [](int samples, double factor) {
    return static_cast<int>(std::lround(std::clamp(samples * factor, kShortest, kLongest)));
  };
  config.leg_angle_filter.samples = length(config.leg_angle_filter.samples, factors[next + 1]);
  config.leg_shape_filter.samples = length(config.leg_shape_filter.samples, factors[next + 2]);
  return config;
}

/// One generation: every set from every start, all on all cores.
std::vector<HopSearchResult> try_all(const model::Model& model, const std::vector<HoppingConfig>& sets,
                                     const std::vector<HopStart>& starts, const HopSearchOptions& options) {
  HopOptions run = options.run;
  run.hops = options.hops;
  const std::vector<std::vector<HopRun>> runs = hop_all(model, sets, starts, run);
  std::vector<HopSearchResult> results(sets.size());
  for (std::size_t s = 0; s < sets.size(); ++s) {
    results[s] = {sets[s], hopping_cost(sets[s], runs[s], options.hops, options.published),
                  statistics_of(runs[s], options.hops)};
  }
  return results;
}

}  // namespace

std::vector<Searched> searched_values(const HoppingConfig& config, bool sides) {
  std::vector<Searched> all = leg_values(config.left, sides ? "_left" : "");
  if (sides) {
    const std::vector<Searched> right = leg_values(config.right, "_right");
    all.insert(all.end(), right.begin(), right.end());
  }
  all.push_back({"K_T", config.parameters.K_T});
  all.push_back({"leg_angle_samples", static_cast<double>(config.leg_angle_filter.samples)});
  all.push_back({"leg_shape_samples", static_cast<double>(config.leg_shape_filter.samples)});
  return all;
}

double hopping_cost(const HoppingConfig& config, const std::vector<HopRun>& runs, long enough,
                    const std::vector<Published>& published) {
  double missing = 0.0;
  for (const HopRun& run : runs) {
    missing += 1.0 - std::min(1.0, static_cast<double>(run.hops.size()) / static_cast<double>(enough));
  }
  double cost = kFallCosts * missing / static_cast<double>(runs.size());
  const std::vector<Hop> hops = settled_hops(runs);
  for (const Published& quantity : published) {
    if (quantity.measure->kind != Measure::Kind::of_a_hop) {
      continue;
    }
    double square = hops.empty() ? kNoHop * kNoHop : 0.0;
    for (const Hop& hop : hops) {
      const double off = quantity.deviation(measure_of(*quantity.measure, hop, config));
      square += off * off / static_cast<double>(hops.size());
    }
    cost += std::log1p(square);
  }
  return cost;
}

HopSearchResult search_gains(const model::Model& model, const HoppingConfig& around,
                             const HopSearchOptions& options,
                             const std::function<void(int, const HopSearchResult&)>& progress) {
  const std::vector<HopStart> starts = draw_starts(options.starts, options.seed);
  const auto size = static_cast<Eigen::Index>(searched_values(around, options.sides).size());
  CmaSearch search(Eigen::VectorXd::Zero(size), options.width, 0, options.seed);
  HopSearchResult best = try_all(model, {around}, starts, options).front();
  progress(0, best);
  try {
    for (int trial = 1; trial < options.trials; trial += search.population()) {
      const Eigen::MatrixXd candidates = search.ask();
      std::vector<HoppingConfig> sets;
      for (const auto& candidate : candidates.colwise()) {
        sets.push_back(multiply(around, candidate.array().exp(), options.sides));
      }
      const std::vector<HopSearchResult> results = try_all(model, sets, starts, options);
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
