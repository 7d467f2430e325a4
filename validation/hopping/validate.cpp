#include "validation/hopping/validate.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "validation/hopping/drawn_models.h"

namespace plumbline::validation {
namespace {

using controllers::HoppingConfig;
using Kind = Measure::Kind;

Share share_of(const std::string& what, const std::vector<HopRun>& runs, long enough) {
  const HopStatistics s = statistics_of(runs, enough);
  return {what, s.sustained, s.starts, s.median_hops};
}

/// Everything that was run, from which the verdicts are read.
struct Evidence {
  std::vector<HopRun> starts, tuned_rigid;
};

std::vector<HopRun> hop_many(const ValidateInputs& inputs, const HoppingConfig& config,
                             const ValidateOptions& options, const ValidateProgress& progress,
                             const std::string& what) {
  HopOptions run = options.run;
  run.hops = options.enough;
  return hop_from(inputs.model, config, draw_starts(options.starts, options.seed), run,
                  [&](int done) { progress(what, static_cast<double>(done) / options.starts); });
}

std::vector<HopRun> hop_drawn(const ValidateInputs& inputs, const ValidateOptions& options,
                              const ValidateProgress& progress) {
  HopOptions run = options.run;
  run.hops = options.enough;
  const std::vector<model::Model> models =
      draw_models(inputs.model, options.draws, options.share, options.seed);
  std::vector<HopRun> runs(models.size());
  std::atomic<int> done{0};
  const int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  parallel_for(options.draws, threads, [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    runs[k] = hop(models[k], inputs.controller, {}, run);
    progress("drawn robots", static_cast<double>(++done) / options.draws);
  });
  return runs;
}

Orbit look_for_orbit(const ValidateInputs& inputs, const ValidateOptions& options,
                     const ValidateProgress& progress) {
  progress("orbit", 0.0);
  OrbitOptions orbit;
  orbit.run = options.run;
  orbit.hops = options.enough;
  return find_orbit(inputs.model, inputs.controller, orbit);
}

PublishedVerdict of_hops(const Published& published, const Evidence& evidence, const HoppingConfig& config) {
  std::vector<double> values;
  for (const Hop& hop : settled_hops(evidence.starts)) {
    values.push_back(measure_of(*published.measure, hop, config));
  }
  if (values.empty()) {
    return {published, std::nullopt, "no settled hop"};
  }
  return {published, spread_of(values), ""};
}

PublishedVerdict of_runs(const Published& published, const Evidence& evidence, const HopRun& run) {
  if (published.measure->name == "hops") {
    const double hops = static_cast<double>(run.hops.size());
    if (!run.fell && hops < published.quantity.value) {
      return {published, std::nullopt, fmt::format("only {:.0f} were asked for", hops)};
    }
    return {published, Spread{hops, 0.0, 1}, run.fell ? run.end : "then ended by us"};
  }
  if (evidence.tuned_rigid.empty()) {
    return {published, std::nullopt, "no controller tuned on rigid cables"};
  }
  std::vector<double> hops;
  for (const HopRun& one : evidence.tuned_rigid) {
    hops.push_back(static_cast<double>(one.hops.size()));
  }
  return {published, spread_of(hops), fmt::format("from {} starts", hops.size())};
}

PublishedVerdict of_orbit(const Published& published, const std::optional<Orbit>& orbit) {
  if (!orbit) {
    return {published, std::nullopt, "not asked for"};
  }
  if (!orbit->settled) {
    return {published, std::nullopt, "the gait did not last: " + orbit->why_not};
  }
  if (!orbit->found) {
    return {published, std::nullopt,
            fmt::format("no fixed point: {:.1f} steps away at best", orbit->residual)};
  }
  const bool without = published.measure->name == "growth_without_update";
  const double growth = without ? orbit->growth_without_update : orbit->growth;
  const double twice = without ? orbit->growth_without_twice_step : orbit->growth_twice_step;
  return {published, Spread{growth, std::abs(growth - twice), 1},
          fmt::format("{:.2f} with twice the step", twice)};
}

PublishedVerdict of_model(const Published& published, const model::Model& model) {
  const std::string ratio =
      published.measure->name == "joint_angle_of_stretch_LA" ? "leg_angle" : "leg_shape";
  const model::Ratio* found = model.find_ratio(ratio + "_left");
  if (found == nullptr) {
    return {published, std::nullopt, "no ratio " + ratio + "_left"};
  }
  return {published, Spread{1.0 / std::abs(found->ratios.front().value), 0.0, 1}, ""};
}

PublishedVerdict judge(const Published& published, const ValidateInputs& inputs, const Evidence& evidence,
                       const Validation& done) {
  switch (published.measure->kind) {
    case Kind::of_a_hop:
      return of_hops(published, evidence, inputs.controller);
    case Kind::of_a_run:
      return of_runs(published, evidence, done.run);
    case Kind::of_an_orbit:
      return of_orbit(published, done.orbit);
    case Kind::of_a_model:
      break;
  }
  return of_model(published, inputs.model);
}

}  // namespace

bool Validation::holds() const {
  return std::all_of(verdicts.begin(), verdicts.end(),
                     [](const PublishedVerdict& verdict) { return !verdict.simulated || verdict.holds(); });
}

Validation validate(const ValidateInputs& inputs, const ValidateOptions& options,
                    const ValidateProgress& progress) {
  Validation done;
  Evidence evidence;
  HopOptions run = options.run;
  run.hops = options.hops;
  progress("from the default start", 0.0);
  done.run = hop(inputs.model, inputs.controller, {}, run);
  evidence.starts = hop_many(inputs, inputs.controller, options, progress, "random starts");
  done.statistics = statistics_of(evidence.starts, options.enough);
  done.shares.push_back(share_of("random starts", evidence.starts, options.enough));
  if (options.without) {
    HoppingConfig held = inputs.controller;
    held.parameters.event_update = false;
    done.shares.push_back(share_of("random starts, torso not updated",
                                   hop_many(inputs, held, options, progress, "without the update"),
                                   options.enough));
  }
  if (inputs.tuned_rigid) {
    evidence.tuned_rigid = hop_many(inputs, *inputs.tuned_rigid, options, progress, "tuned on rigid cables");
    done.shares.push_back(
        share_of("random starts, gains tuned on rigid cables", evidence.tuned_rigid, options.enough));
  }
  if (options.draws > 0) {
    done.shares.push_back(share_of(fmt::format("robots drawn within {:.0f} %", 100.0 * options.share),
                                   hop_drawn(inputs, options, progress), options.enough));
  }
  if (options.orbit) {
    done.orbit = look_for_orbit(inputs, options, progress);
  }
  for (const Published& published : inputs.published) {
    done.verdicts.push_back(judge(published, inputs, evidence, done));
  }
  return done;
}

}  // namespace plumbline::validation
