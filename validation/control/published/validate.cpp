#include "validation/control/published/validate.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "simulator/trace/units.h"
#include "validation/control/gait/drawn_models.h"

namespace plumbline::validation {
namespace {

using Kind = Measure::Kind;
using Runs = std::vector<GaitRun>;

/// Everything that was run, from which the verdicts are read.
struct Evidence {
  Runs starts;
  std::map<std::string, Runs> with_controller;  // by the controller's file
};

class Validator {
 public:
  Validator(const PublishedGait& published, const ValidateOptions& options, const ValidateProgress& progress)
      : published_(published), options_(options), progress_(progress) {
    view_.gait = published.gait;
    view_.where = published.where;
    for (const PublishedQuantity& quantity : published.quantities) {
      view_.measures.push_back(quantity.measure);
    }
    Measure duration;
    view_.measures.push_back(duration);
    for (const PublishedCurve& curve : published.curves) {
      view_.curves.push_back({curve.channel, curve.at, curve.over_shares});
    }
    done_.gait = published.name;
    done_.title = published.loaded.scenario.title;
  }

  GaitValidation run() {
    from_start();
    evidence_.starts = many(published_.loaded, "random starts");
    done_.shares.push_back(share_of("random starts", evidence_.starts, options_.enough));
    const std::vector<double> durations =
        values_of(settled_cycles(view_.gait, evidence_.starts), view_.measures.size() - 1);
    done_.duration = spread_of(durations).mean;
    hold_memory();
    other_controllers();
    draw();
    find();
    for (std::size_t q = 0; q < published_.quantities.size(); ++q) {
      done_.verdicts.push_back(judge(q));
    }
    for (std::size_t c = 0; c < published_.curves.size(); ++c) {
      done_.verdicts.push_back(judge(published_.curves[c], c));
    }
    return std::move(done_);
  }

 private:
  GaitOptions gait_options(long enough) const {
    return {enough, options_.run, options_.stop, options_.workers};
  }

  void from_start() {
    progress_("from the scenario's start", 0.0);
    done_.run = run_gait(published_.loaded, view_, gait_options(options_.cycles));
  }

  Runs many(const run::LoadedScenario& loaded, const std::string& what) const {
    return many(from_starts(loaded, options_.starts, options_.seed), what);
  }
  Runs many(const std::vector<run::LoadedScenario>& all, const std::string& what) const {
    const double count = static_cast<double>(std::max<std::size_t>(all.size(), 1));
    return run_gaits(all, view_, gait_options(options_.enough),
                     [&](int done) { progress_(what, static_cast<double>(done) / count); });
  }

  void hold_memory() {
    if (!options_.held || !published_.section || published_.section->held.empty() ||
        !published_.loaded.controller) {
      return;
    }
    run::LoadedScenario held = published_.loaded;
    std::string names;
    for (const auto& [name, value] : published_.section->held) {
      held.controller->set(name, value);
      names += (names.empty() ? "" : ", ") + fmt::format("{} = {:g}", name, value);
    }
    const std::string what = "random starts, " + names;
    done_.shares.push_back(share_of(what, many(held, what), options_.enough));
  }

  void other_controllers() {
    for (const PublishedQuantity& quantity : published_.quantities) {
      if (quantity.controller.empty() || evidence_.with_controller.count(quantity.controller) > 0) {
        continue;
      }
      run::LoadedScenario other = published_.loaded;
      other.controller = run::read_controller(quantity.controller);
      const std::string what = "random starts, " + quantity.controller;
      evidence_.with_controller[quantity.controller] = many(other, what);
      done_.shares.push_back(share_of(what, evidence_.with_controller[quantity.controller], options_.enough));
    }
  }

  void draw() {
    if (options_.draws == 0) {
      return;
    }
    std::vector<run::LoadedScenario> all(static_cast<std::size_t>(options_.draws), published_.loaded);
    const std::vector<model::Model> models =
        draw_models(published_.loaded.model, options_.draws, options_.share, options_.seed);
    for (std::size_t k = 0; k < all.size(); ++k) {
      all[k].model = models[k];
    }
    const std::string what = fmt::format("robots drawn within {:.0f} %", 100.0 * options_.share);
    done_.shares.push_back(share_of(what, many(all, "drawn robots"), options_.enough));
  }

  void find() {
    const bool asked = std::any_of(published_.quantities.begin(), published_.quantities.end(),
                                   [](const auto& q) { return q.measure.of() == Measure::Of::orbit; });
    if (!options_.orbit || !asked) {
      return;
    }
    progress_("orbit", 0.0);
    OrbitOptions orbit;
    orbit.cycles = options_.enough;
    orbit.run = options_.run;
    orbit.stop = options_.stop;
    orbit.workers = options_.workers;
    done_.orbit = find_orbit(published_.loaded, *published_.section, orbit);
  }

  Verdict judge(std::size_t q) const {
    const PublishedQuantity& quantity = published_.quantities[q];
    Verdict verdict;
    verdict.name = quantity.name;
    verdict.measure = quantity.measure.text;
    verdict.source = quantity.quantity.source;
    verdict.unit = quantity.quantity.unit;
    verdict.relation = quantity.relation;
    verdict.published = quantity.quantity.value;
    verdict.tolerance = quantity.tolerance.value;
    switch (quantity.measure.of()) {
      case Measure::Of::cycle:
        of_cycles(q, verdict);
        break;
      case Measure::Of::run:
        of_runs(quantity, verdict);
        break;
      case Measure::Of::orbit:
        of_orbit(quantity, verdict);
        break;
      case Measure::Of::model:
        verdict.simulated =
            Spread{1.0 / std::abs(published_.loaded.model.find_ratio(quantity.measure.channels.front())
                                      ->ratios.front()
                                      .value),
                   0.0, 1};
        break;
    }
    if (verdict.simulated) {
      verdict.outside = quantity.outside(verdict.simulated->mean);
    }
    return verdict;
  }

  const Runs& runs_of(const PublishedQuantity& quantity) const {
    return quantity.controller.empty() ? evidence_.starts : evidence_.with_controller.at(quantity.controller);
  }

  void of_cycles(std::size_t q, Verdict& verdict) const {
    const auto cycles =
        settled_cycles(view_.gait, runs_of(published_.quantities[q]), published_.quantities[q].foot);
    if (cycles.empty()) {
      verdict.remark = "no settled " + to_string(view_.gait.cycle);
      return;
    }
    verdict.simulated = spread_of(values_of(cycles, q));
  }

  void of_runs(const PublishedQuantity& quantity, Verdict& verdict) const {
    if (quantity.over_starts) {
      std::vector<double> counts;
      for (const GaitRun& one : runs_of(quantity)) {
        counts.push_back(static_cast<double>(one.cycles.size()));
      }
      verdict.simulated = spread_of(counts);
      verdict.remark = fmt::format("from {} starts", counts.size());
      return;
    }
    const auto cycles = static_cast<double>(done_.run.cycles.size());
    if (!done_.run.run.fell && cycles < quantity.quantity.value) {
      verdict.remark = fmt::format("only {:.0f} were asked for", cycles);
      return;
    }
    verdict.simulated = Spread{cycles, 0.0, 1};
    verdict.remark = done_.run.run.fell ? done_.run.run.end : "then ended by us";
  }

  void of_orbit(const PublishedQuantity& quantity, Verdict& verdict) const {
    if (!done_.orbit) {
      verdict.remark = "not asked for";
    } else if (!done_.orbit->settled) {
      verdict.remark = "the gait did not last: " + done_.orbit->why_not;
    } else if (!done_.orbit->found) {
      verdict.remark = fmt::format("no fixed point: {:.1f} steps away at best", done_.orbit->residual);
    } else {
      const bool held = quantity.measure.kind == Kind::growth_held;
      const double growth = held ? done_.orbit->growth_held : done_.orbit->growth;
      const double twice = held ? done_.orbit->growth_held_twice_step : done_.orbit->growth_twice_step;
      verdict.simulated = Spread{growth, std::abs(growth - twice), 1};
      verdict.remark = fmt::format("{:.2f} with twice the step", twice);
    }
  }

  /// Root mean square difference of the mean simulated curve, over what at least half of the cycles reach.
  Verdict judge(const PublishedCurve& curve, std::size_t c) const {
    Verdict verdict;
    verdict.name = curve.name;
    verdict.measure = "rms difference of the mean curve of " + curve.channel;
    verdict.source = curve.source;
    verdict.unit = curve.tolerance.unit;
    verdict.relation = PublishedQuantity::Relation::at_most;
    verdict.tolerance = curve.tolerance.value;
    verdict.curve.channel = curve.channel;
    const auto cycles = settled_cycles(view_.gait, evidence_.starts, curve.foot);
    if (cycles.empty()) {
      verdict.remark = "no settled " + to_string(view_.gait.cycle);
      return verdict;
    }
    const MeanCurve mean = mean_curve(cycles, c);
    double sum = 0.0;
    double worst = 0.0;
    double until = 0.0;
    long points = 0;
    for (Eigen::Index k = 0; k < curve.at.size(); ++k) {
      if (2 * mean.count[k] >= static_cast<int>(cycles.size())) {
        const double off = mean.mean[k] - curve.value[k];
        sum += off * off;
        worst = std::max(worst, std::abs(off));
        until = curve.at[k];
        ++points;
      }
    }
    const double rms = std::sqrt(sum / static_cast<double>(std::max(points, 1L)));
    verdict.simulated = Spread{rms, 0.0, 1};
    verdict.outside = std::max(0.0, rms - curve.tolerance.value);
    verdict.remark =
        fmt::format("{} over {:.3g}{}, largest {:.3g}", verdict.measure, until,
                    curve.over_shares ? " of the cycle" : " s", worst / to_si_factor(verdict.unit));
    if (curve.spread.size() > 0) {
      const double scatter = std::sqrt(curve.spread.cwiseAbs2().mean());
      verdict.remark += fmt::format("; measured scatter {:.3g}", scatter / to_si_factor(verdict.unit));
    }
    verdict.curve = {curve.channel, curve.over_shares, curve.at,      curve.value,
                     curve.spread,  mean.mean,         mean.deviation};
    return verdict;
  }

  const PublishedGait& published_;
  const ValidateOptions& options_;
  const ValidateProgress& progress_;
  GaitView view_;
  Evidence evidence_;
  GaitValidation done_;
};

}  // namespace

int GaitValidation::not_measured() const {
  return static_cast<int>(std::count_if(verdicts.begin(), verdicts.end(),
                                        [](const Verdict& verdict) { return !verdict.simulated; }));
}

bool GaitValidation::holds() const {
  return std::all_of(verdicts.begin(), verdicts.end(),
                     [](const Verdict& verdict) { return verdict.holds(); });
}

GaitValidation validate(const PublishedGait& published, const ValidateOptions& options,
                        const ValidateProgress& progress) {
  return Validator(published, options, progress).run();
}

}  // namespace plumbline::validation
