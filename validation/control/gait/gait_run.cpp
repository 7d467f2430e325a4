#include "validation/control/gait/gait_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "validation/control/gait/gait_bytes.h"
#include "validation/control/gait/shared_runs.h"

namespace plumbline::validation {
namespace {

/// Linear between samples.
double at_time(const Eigen::VectorXd& time, const Eigen::VectorXd& values, double t) {
  const double* begin = time.data();
  const double* next = std::lower_bound(begin, begin + time.size(), t);
  const Eigen::Index k = std::clamp<Eigen::Index>(next - begin, 1, time.size() - 1);
  const double share = (t - time[k - 1]) / (time[k] - time[k - 1]);
  return (1.0 - share) * values[k - 1] + share * values[k];
}

/// Keeps the samples of the cycle that is under way, and measures it when it ends.
class CycleRecorder {
 public:
  CycleRecorder(const run::LoadedScenario& loaded, const GaitView& view, std::vector<Cycle>& cycles)
      : view_(view),
        channels_(loaded, names_of(view), view.where),
        finder_(view.gait, loaded.model.feet.size()),
        cycles_(cycles),
        row_(channels_.size()) {}

  void sample(run::SampledRun& sampled) {
    const double t = sampled.simulation().time();
    channels_.read(sampled, row_.data());
    if (begun_) {
      keep(t);
    }
    if (finder_.look(t, sampled.simulation().touches())) {
      if (begun_) {
        finish();
      }
      begun_ = true;
      foot_ = finder_.foot();
      time_.clear();
      rows_.clear();
      keep(t);
    }
  }

 private:
  static std::vector<std::string> names_of(const GaitView& view) {
    std::vector<std::string> names;
    for (const CurveView& curve : view.curves) {
      names.push_back(curve.channel);
    }
    for (const Measure& measure : view.measures) {
      if (measure.of() == Measure::Of::cycle) {
        names.insert(names.end(), measure.channels.begin(), measure.channels.end());
      }
    }
    return names;
  }

  void keep(double t) {
    time_.push_back(t);
    rows_.insert(rows_.end(), row_.begin(), row_.end());
  }

  void finish() {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const auto samples = static_cast<Eigen::Index>(time_.size());
    const Eigen::VectorXd time = Eigen::Map<const Eigen::VectorXd>(time_.data(), samples);
    const Eigen::MatrixXd rows =
        Eigen::Map<const RowMajor>(rows_.data(), samples, static_cast<Eigen::Index>(channels_.size()));
    const CycleSamples samples_of{rows, time, finder_.touchdowns()};
    Cycle cycle;
    cycle.begin = time_.front();
    cycle.end = time_.back();
    cycle.foot = foot_;
    for (const Measure& measure : view_.measures) {
      cycle.values.push_back(measure.of() == Measure::Of::cycle ? value_of(measure, channels_, samples_of)
                                                                : 0.0);
    }
    for (const CurveView& view : view_.curves) {
      Eigen::VectorXd curve(view.at.size());
      const double unit = view.over_shares ? cycle.end - cycle.begin : 1.0;
      for (Eigen::Index k = 0; k < curve.size(); ++k) {
        const double t = cycle.begin + view.at[k] * unit;
        curve[k] = t <= cycle.end + 1e-9 ? at_time(time, rows.col(channels_.index(view.channel)), t)
                                         : std::numeric_limits<double>::quiet_NaN();
      }
      cycle.curves.push_back(std::move(curve));
    }
    cycles_.push_back(std::move(cycle));
  }

  const GaitView& view_;
  Channels channels_;
  CycleFinder finder_;
  std::vector<Cycle>& cycles_;
  bool begun_ = false;
  int foot_ = -1;
  std::vector<double> row_, time_, rows_;
};

}  // namespace

GaitRun run_gait(const run::LoadedScenario& loaded, const GaitView& view, const GaitOptions& options) {
  GaitRun done;
  CycleRecorder recorder(loaded, view, done.cycles);
  run::RunOptions run = options.run;
  run.watch = [&](run::SampledRun& sampled) {
    if (options.stop != nullptr && options.stop->raised) {
      throw Stopped();
    }
    recorder.sample(sampled);
    return options.enough > 0 && static_cast<long>(done.cycles.size()) >= options.enough;
  };
  done.run = run::run_scenario(loaded.model, loaded.scenario,
                               loaded.controller ? &*loaded.controller : nullptr, run);
  return done;
}

std::vector<GaitRun> run_gaits(const std::vector<run::LoadedScenario>& all, const GaitView& view,
                               const GaitOptions& options, const std::function<void(int)>& progress) {
  std::vector<GaitRun> runs(all.size());
  const auto at = [](int run) { return static_cast<std::size_t>(run); };
  SharedRuns shared{"run of a gait", static_cast<int>(all.size()), {}, {}, {}};
  shared.work = [&](int run) { runs[at(run)] = run_gait(all[at(run)], view, options); };
  shared.result = [&](int run) {
    work::Bytes bytes;
    add(runs[at(run)], bytes);
    return bytes.all();
  };
  shared.take = [&](int run, work::BytesReader& reader) { runs[at(run)] = gait_run_from(reader); };
  share_runs(shared, {options.workers, options.stop}, progress);
  return runs;
}

std::vector<run::LoadedScenario> from_starts(const run::LoadedScenario& loaded, int count,
                                             std::uint64_t seed) {
  std::vector<run::LoadedScenario> all(static_cast<std::size_t>(count), loaded);
  const std::vector<run::Start> starts = run::draw_starts(loaded.scenario, count, seed);
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k].scenario.start = starts[k];
  }
  return all;
}

std::vector<const Cycle*> settled_cycles(const Gait& gait, const std::vector<GaitRun>& runs, int foot) {
  std::vector<const Cycle*> settled;
  for (const GaitRun& one : runs) {
    const auto all = static_cast<long>(one.cycles.size());
    const long end = all - (one.run.fell ? std::min(gait.before_fall, all) : 0);
    for (long c = gait.settle; c < end; ++c) {
      const Cycle& cycle = one.cycles[static_cast<std::size_t>(c)];
      if (foot < 0 || cycle.foot == foot) {
        settled.push_back(&cycle);
      }
    }
  }
  return settled;
}

MeanCurve mean_curve(const std::vector<const Cycle*>& cycles, std::size_t curve) {
  MeanCurve result;
  const Eigen::Index points = cycles.empty() ? 0 : cycles.front()->curves[curve].size();
  result.mean.resize(points);
  result.deviation.resize(points);
  result.count.resize(points);
  for (Eigen::Index k = 0; k < points; ++k) {
    std::vector<double> values;
    for (const Cycle* cycle : cycles) {
      if (std::isfinite(cycle->curves[curve][k])) {
        values.push_back(cycle->curves[curve][k]);
      }
    }
    const Spread spread = spread_of(values);
    result.mean[k] = values.empty() ? std::numeric_limits<double>::quiet_NaN() : spread.mean;
    result.deviation[k] = spread.deviation;
    result.count[k] = static_cast<int>(values.size());
  }
  return result;
}

Share share_of(const std::string& what, const std::vector<GaitRun>& runs, long enough) {
  Share share{what, 0, static_cast<int>(runs.size()), 0.0};
  std::vector<double> counts;
  for (const GaitRun& one : runs) {
    counts.push_back(static_cast<double>(one.cycles.size()));
    share.sustained += static_cast<long>(one.cycles.size()) >= enough ? 1 : 0;
  }
  if (!counts.empty()) {
    const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
    std::nth_element(counts.begin(), middle, counts.end());
    share.median_cycles = *middle;
  }
  return share;
}

std::vector<double> values_of(const std::vector<const Cycle*>& cycles, std::size_t measure) {
  std::vector<double> values;
  for (const Cycle* cycle : cycles) {
    values.push_back(cycle->values[measure]);
  }
  return values;
}

}  // namespace plumbline::validation
