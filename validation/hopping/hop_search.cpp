#include "validation/hopping/hop_search.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace plumbline::validation {
namespace {

using controllers::HoppingConfig;

/// What is searched, each a positive number moved by a factor.
void multiply(HoppingConfig& config, const Eigen::VectorXd& factors) {
  for (controllers::HoppingLegGains* gains : {&config.left, &config.right}) {
    gains->kp_LA *= factors[0];
    gains->kd_LA *= factors[1];
    gains->kp_mLS *= factors[2];
    gains->kd_mLS *= factors[3];
  }
  config.parameters.K_T *= factors[4];
  const auto length = [](int samples, double factor) {
    const double most = 12.0;  // longer ones are late by more than the legs' own motion allows
    return static_cast<int>(std::lround(std::clamp(samples * factor, 2.0, most)));
  };
  config.leg_angle_filter.samples = length(config.leg_angle_filter.samples, factors[5]);
  config.leg_shape_filter.samples = length(config.leg_shape_filter.samples, factors[6]);
}
constexpr int kSearched = 7;

constexpr double kAnyGait = 0.1;  // what it is worth to hop on in another way, in place say
constexpr double kOff = 0.5;      // relative: a gait as far off as this is hardly the paper's

double score_of(const HoppingConfig& config, const std::vector<HopRun>& runs, const HopStatistics& statistics,
                long enough) {
  double score = 0.0;
  for (const HopRun& run : runs) {
    score += std::min(1.0, static_cast<double>(run.hops.size()) / static_cast<double>(enough)) /
             static_cast<double>(runs.size());
  }
  const controllers::HoppingParameters& p = config.parameters;
  const double wanted = config.boom_length * p.delta_phi_d;
  const double travel = (statistics.travel - wanted) / wanted;
  const double lean = (statistics.torso - p.h_T0) / p.h_T0;
  return score * (kAnyGait + std::exp(-0.5 * (travel * travel + lean * lean) / (kOff * kOff)));
}

}  // namespace

HopSearchResult search_gains(const model::Model& model, const HoppingConfig& around,
                             const HopSearchOptions& options,
                             const std::function<void(int, const HopSearchResult&)>& progress) {
  std::mt19937_64 random(options.seed);
  std::uniform_real_distribution<double> even(-std::log(4.0), std::log(4.0));
  std::normal_distribution<double> normal;
  HopOptions run = options.run;
  run.hops = options.hops;
  const std::vector<HopStart> starts = draw_starts(options.starts, options.seed);
  Eigen::VectorXd best_at = Eigen::VectorXd::Zero(kSearched);
  HopSearchResult best;
  for (int trial = 0; trial < options.trials; ++trial) {
    const bool wide = 3 * trial < options.trials;
    const double width = 0.5 * std::pow(0.1, std::max(0.0, 1.5 * trial / options.trials - 0.5));
    Eigen::VectorXd at = best_at;
    for (Eigen::Index i = 0; trial > 0 && i < kSearched; ++i) {
      at[i] = wide ? even(random) : best_at[i] + width * normal(random);
    }
    HopSearchResult result;
    result.config = around;
    multiply(result.config, at.array().exp());
    const std::vector<HopRun> runs = hop_from(model, result.config, starts, run);
    result.statistics = statistics_of(runs, options.hops);
    result.score = score_of(result.config, runs, result.statistics, options.hops);
    progress(trial, result);
    if (trial == 0 || result.score > best.score) {
      best = result;
      best_at = at;
    }
  }
  return best;
}

}  // namespace plumbline::validation
