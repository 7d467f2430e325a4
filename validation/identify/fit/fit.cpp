#include "validation/identify/fit/fit.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "simulator/trace/error.h"
#include "simulator/trace/number_text.h"
#include "validation/identify/predict/profile.h"

namespace plumbline::validation {
namespace {

/// Two digits, or all before the point.
std::string percent(double share) {
  const double value = 100.0 * share;
  return (value < 100.0 || value > 1e6 ? number_text(value, 2) : number_text(std::round(value))) + " %";
}

/// Confidence interval along the search line, in the parameter's own unit and within its bounds.
void set_interval(const FreeParameter& parameter, double below, double above, FittedParameter& fitted) {
  const double here = to_search(parameter.scale, fitted.after);
  double low = here - below;
  double high = here + above;
  if (parameter.scale == effects::Scale::reciprocal && here > 0.0) {
    low = std::max(low, 0.0);  // 1/0: the null value, infinite
  }
  double a = from_search(parameter.scale, low);
  double b = from_search(parameter.scale, high);
  if (a > b) {
    std::swap(a, b);
  }
  fitted.lower = std::max(a, parameter.lower);
  fitted.upper = std::min(b, parameter.upper);
}

void set_partner(const std::vector<FreeParameter>& parameters, const Eigen::MatrixXd& correlation,
                 Eigen::Index p, FittedParameter& fitted) {
  for (Eigen::Index other = 0; other < correlation.cols(); ++other) {
    if (other != p && std::abs(correlation(p, other)) > std::abs(fitted.correlation)) {
      fitted.correlation = correlation(p, other);
      fitted.partner = parameters[static_cast<std::size_t>(other)].label;
    }
  }
}

/// "its lower bound 0 N m", or nothing.
std::string bound_reached(const FreeParameter& parameter, double value) {
  const double here = to_search(parameter.scale, value);
  const double unit = parameter.scale == effects::Scale::logarithm
                          ? 1.0
                          : std::abs(to_search(parameter.scale, parameter.typical));
  const auto touches = [&](double bound) {
    const double there = to_search(parameter.scale, bound);
    return std::isfinite(there) && std::abs(here - there) <= 1e-6 * unit;
  };
  const std::string unit_text = parameter.unit == "1" ? "" : " " + parameter.unit;
  if (touches(parameter.lower)) {
    return "its lower bound " + number_text(parameter.lower) + unit_text;
  }
  if (touches(parameter.upper)) {
    return "its upper bound " + number_text(parameter.upper) + unit_text;
  }
  return "";
}

/// The same with those of logarithmic scale held, which say how sharp or stiff a law is: free from the
/// beginning they run away while its place is still wrong, and then nothing moves that any more.
std::vector<FreeParameter> with_sharpness_held(const std::vector<FreeParameter>& parameters,
                                               const Eigen::VectorXd& values) {
  std::vector<FreeParameter> held = parameters;
  for (std::size_t p = 0; p < held.size(); ++p) {
    if (held[p].scale == effects::Scale::logarithm) {
      held[p].lower = held[p].upper = values[static_cast<Eigen::Index>(p)];
    }
  }
  return held;
}

std::vector<int> all_of(const std::vector<FreeParameter>& parameters) {
  std::vector<int> all(parameters.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

void add_doubts(const FreeParameter& parameter, bool seen, const FitOptions& options,
                FittedParameter& fitted) {
  if (!seen) {
    fitted.doubts.push_back({"unseen", "these motions do not depend on it; its value was left as it was"});
    return;
  }
  if (fitted.degrees_of_freedom < 1.0) {
    fitted.doubts.push_back(
        {"few_windows",
         "there are no more windows that tell it than parameters, so nothing says how sure it is: record "
         "longer or free fewer"});
  }
  const std::string bound = bound_reached(parameter, fitted.after);
  if (!bound.empty()) {
    fitted.doubts.push_back({"at_bound", "it ended at " + bound +
                                             ": the best value may lie beyond, or the "
                                             "effect is not there"});
  }
  if (fitted.deviation > options.uncertain * std::abs(fitted.after)) {
    const bool zero = fitted.after == 0.0;
    fitted.doubts.push_back({"uncertain", zero ? "its standard deviation is larger than its value"
                                               : "it is known to within " +
                                                     percent(fitted.deviation / std::abs(fitted.after)) +
                                                     " (one standard deviation) only"});
  }
  if (std::abs(fitted.correlation) > options.tied) {
    fitted.doubts.push_back({"tied", "it cannot be told from " + fitted.partner + " (correlation " +
                                         number_text(fitted.correlation, 4) +
                                         "): only a combination of the two is known"});
  }
}

bool FittedParameter::seen() const {
  return std::none_of(doubts.begin(), doubts.end(),
                      [](const Doubt& doubt) { return doubt.kind == "unseen"; });
}

double student_quantile(double confidence, double degrees_of_freedom) {
  if (degrees_of_freedom < 1.0) {
    return std::numeric_limits<double>::infinity();
  }
  constexpr double kMany = 1e6;  // as good as normal
  const boost::math::students_t distribution(std::min(degrees_of_freedom, kMany));
  return boost::math::quantile(distribution, 0.5 + 0.5 * confidence);
}

std::vector<FittedParameter> judge(const std::vector<FreeParameter>& parameters, const FitNumbers& numbers,
                                   const FitOptions& options) {
  const Eigen::MatrixXd& correlation = numbers.precision.correlation;
  std::vector<FittedParameter> all;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto p = static_cast<Eigen::Index>(i);
    FittedParameter fitted;
    fitted.label = parameters[i].label;
    fitted.unit = parameters[i].unit;
    fitted.before = numbers.before[p];
    fitted.after = numbers.after[p];
    const bool seen = correlation(p, p) > 0.5;
    fitted.deviation = seen ? numbers.precision.deviations[p] : std::numeric_limits<double>::infinity();
    fitted.degrees_of_freedom = numbers.precision.freedom[p];
    const double quantile = student_quantile(options.confidence, fitted.degrees_of_freedom);
    if (seen && std::isfinite(quantile)) {
      const Precision& known = numbers.precision;
      set_interval(parameters[i], quantile * known.below[p], quantile * known.above[p], fitted);
    } else {
      fitted.lower = parameters[i].lower;
      fitted.upper = parameters[i].upper;
    }
    set_partner(parameters, correlation, p, fitted);
    add_doubts(parameters[i], seen, options, fitted);
    all.push_back(std::move(fitted));
  }
  return all;
}

Fit fit(const model::Model& model, const Data& data, std::vector<FreeParameter> parameters,
        const FitOptions& options, const Progress& progress) {
  if (!data.has(Role::train)) {
    const Trial& other = data.trials.empty() ? data.tests.front() : data.trials.front();
    throw InputError({other.file, 0, "role"}, to_string(other.role), "at least one trial with role: train");
  }
  check_can_move(model, parameters);
  progress("the model as given", 0.0);
  PredictorPool pool(model, data);
  const Estimate given = estimate_states(pool);
  set_typical(model, data, parameters);
  progress("fitting " + std::to_string(parameters.size()) + " parameters", 0.2);
  FitNumbers numbers;
  numbers.before = values_of(model, parameters);
  const Estimate near = gauss_newton(pool, with_sharpness_held(parameters, numbers.before), numbers.before,
                                     given.x0, {options.iterations, 1e-3});
  progress("the last digits", 0.6);
  const Estimate last =
      estimate(pool, parameters, near.theta, near.x0, {options.iterations, options.tolerance});
  progress("how sure they are", 0.7);
  const Estimate fitted =
      gauss_newton(pool, parameters, last.theta, last.x0, {options.iterations, options.tolerance});
  const Profiled known = profile(pool, parameters, fitted, all_of(parameters));
  numbers.after = known.estimate.theta;
  numbers.precision = known.held;
  Fit result;
  result.before = given.scores;
  // As compare finds them of the fitted model: a search that has followed its parameters may stand at initial
  // states that no one finds again.
  const model::Model last_model = with_values(model, parameters, numbers.after);
  PredictorPool afresh(last_model, data);
  result.after = estimate_states(afresh).scores;
  result.before.test = test_error(model, data);
  result.after.test = test_error(last_model, data);
  result.parameters = judge(parameters, numbers, options);
  result.together = correlations_of(parameters, numbers.after, numbers.precision);
  result.windows = static_cast<int>(data.windows_of(Role::train).size());
  result.iterations = near.iterations + last.iterations;
  result.converged = last.converged;
  return result;
}

}  // namespace plumbline::validation
