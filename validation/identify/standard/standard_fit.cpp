#include "validation/identify/standard/standard_fit.h"

#include <algorithm>

#include "simulator/trace/error.h"
#include "validation/identify/compare/compare.h"
#include "validation/identify/standard/torque_problem.h"

namespace plumbline::validation {

int StandardFit::at_limits() const {
  return static_cast<int>(std::count_if(free.values.begin(), free.values.end(),
                                        [](const FreeValue& value) { return value.at_limit; }));
}

int StandardFit::unseen() const {
  return static_cast<int>(std::count_if(free.values.begin(), free.values.end(),
                                        [](const FreeValue& value) { return !value.seen; }));
}

namespace {

constexpr double kMotionCutoff = 100.0;  // Hz

/// The search with all torques compared below one frequency, from the values that `fit` has.
void fit_below(double cutoff, const model::Model& model, const Data& data, StandardFit& fit) {
  const TorqueProblem problem(model, data, {kMotionCutoff, cutoff});
  FreeModel free = free_values(model, problem.scales());
  for (std::size_t i = 0; i < fit.free.values.size(); ++i) {
    free.values[i].value = fit.free.values[i].value;
  }
  problem.search(free);
  fit = {};
  fit.cutoff = problem.cutoff();
  fit.samples = problem.samples();
  fit.free = std::move(free);
  const model::Model found = identified(fit.free);
  const std::map<int, double> before = problem.rms(model);
  const std::map<int, double> after = problem.rms(found);
  for (const auto& [motor, rms] : before) {
    const std::string& name = place_name(model, motor);
    fit.torques.push_back({name, place_is_angular(model, motor) ? "N m" : "N",
                           problem.scales().at(name).torque, rms, after.at(motor)});
  }
}

/// Halved from the highest down to what a window of the train trials still holds one period of.
std::vector<double> cutoffs_of(const Data& data, const StandardOptions& options) {
  if (options.force_cutoff > 0.0) {
    return {options.force_cutoff};
  }
  constexpr double kHighest = 40.0;  // Hz
  std::vector<double> cutoffs;
  for (double cutoff = kHighest; cutoff * data.predict.window >= 1.0; cutoff *= 0.5) {
    cutoffs.push_back(cutoff);
  }
  if (cutoffs.empty()) {
    cutoffs.push_back(kHighest);
  }
  return cutoffs;
}

}  // namespace

StandardFit standard_fit(const model::Model& model, const Data& data, const StandardOptions& options,
                         const Progress& progress) {
  constexpr std::size_t kSome = 8;  // windows of a role that choose the frequency
  const Data some = data.thinned(kSome);
  const std::vector<double> cutoffs = cutoffs_of(data, options);
  StandardFit best;
  StandardFit last;
  for (std::size_t i = 0; i < cutoffs.size(); ++i) {
    if (progress) {
      progress("regressor", static_cast<double>(i) / static_cast<double>(cutoffs.size()));
    }
    try {
      fit_below(cutoffs[i], model, data, last);
      last.after = compare(identified(last.free), some).scores;
    } catch (const InputError&) {
      if (best.torques.empty()) {
        throw;
      }
      break;  // the records are too short for filters of lower frequencies
    }
    if (best.torques.empty() || last.after.train < best.after.train) {
      best = last;
    }
  }
  best.before = compare(model, data).scores;
  best.after = compare(identified(best.free), data).scores;
  return best;
}

}  // namespace plumbline::validation
