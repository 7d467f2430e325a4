#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "validation/identify/diagnose/candidates.h"
#include "validation/identify/fit/fit.h"
#include "validation/identify/predict/deviations.h"
#include "validation/identify/predict/states_by_parts.h"
#include "validation/studies/recipes/information.h"
#include "validation/studies/recipes/linked.h"
#include "validation/studies/recipes/methods.h"

namespace plumbline::validation {
namespace {

constexpr double kWindowSettled = 1e-8;          // relative change of the cost
constexpr double kSettledThroughContact = 1e-6;  // less than the integrator's own error there would be noise

IdentifiedValue finding_of(const LinkedParameter& linked, const FittedParameter& fitted) {
  IdentifiedValue finding;
  finding.unknown = linked.link.unknown;
  finding.value = linked.link.unknown_of(fitted.after);
  finding.deviation = fitted.deviation / std::abs(linked.link.slope(finding.value));
  const double one = linked.link.unknown_of(fitted.lower);
  const double two = linked.link.unknown_of(fitted.upper);
  finding.lower = std::min(one, two);
  finding.upper = std::max(one, two);
  finding.seen = fitted.seen();
  return finding;
}

/// Information on the free unknowns alone, in the parameters' search units; what is known of the others is in
/// it.
Eigen::MatrixXd free_information(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                                 const Estimate& estimate, Eigen::Index free) {
  const Eigen::VectorXd units = search_units(parameters, estimate.theta);
  Eigen::MatrixXd H = prior(parameters, units, estimate.theta).H;
  for (const Reduced& one :
       reduce(pool, pool.data().windows_of(Role::train), parameters, estimate.theta, estimate.x0, units)) {
    H += one.H;
  }
  const Eigen::Index known = H.rows() - free;
  if (known == 0) {
    return H;
  }
  const Eigen::MatrixXd across = H.topRightCorner(free, known);
  return H.topLeftCorner(free, free) -
         across * H.bottomRightCorner(known, known).ldlt().solve(Eigen::MatrixXd(across.transpose()));
}

/// The same with derivatives by differences, which are right through a touchdown.
Eigen::MatrixXd exact_information(const model::Model& model, Data data,
                                  const std::vector<FreeParameter>& parameters, const Estimate& estimate,
                                  Eigen::Index free) {
  data.predict.differences = true;
  data.predict.relative_tolerance = 1e-6;  // well below the differences' steps
  PredictorPool pool(model, data);
  return free_information(pool, parameters, estimate, free);
}

/// What the sensors' floors alone would leave: the residuals are not those of a fit.
void set_deviations(const Eigen::MatrixXd& H, const Eigen::VectorXd& units,
                    const std::vector<LinkedParameter>& list, std::vector<IdentifiedValue>& findings) {
  const Eigen::MatrixXd inverse = H.completeOrthogonalDecomposition().pseudoInverse();
  for (std::size_t p = 0; p < findings.size(); ++p) {
    const auto i = static_cast<Eigen::Index>(p);
    const LinkedParameter& one = list[p];
    const double value = one.link.parameter(findings[p].value);
    const double search = std::sqrt(std::max(inverse(i, i), 0.0)) * units[i];
    findings[p].deviation =
        std::abs(search_slope(one.parameter.scale, value) / one.link.slope(findings[p].value)) * search;
  }
}

double settled(const Data& data) {
  const auto has_contact = [](const Trial& trial) { return !trial.switches.empty(); };
  return std::any_of(data.trials.begin(), data.trials.end(), has_contact) ? kSettledThroughContact
                                                                          : kWindowSettled;
}

struct Fitted {
  Estimate given, estimate;
  FitNumbers numbers;
};

/// Where the search of the values has lost a window through contact, stops or play it has done so with values
/// that were still wrong: all begin anew with those that it has found, and the fit goes on from there.
Estimate with_lost_windows(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                           Estimate estimate, const EstimateOptions& options) {
  if (estimate.scores.train < kFits || !has_corners(pool, parameters, estimate.theta)) {
    return estimate;
  }
  const Point anew = grown_states(pool, parameters, estimate.theta);
  Estimate again = gauss_newton(pool, parameters, estimate.theta, anew.x0, options);
  return again.cost < estimate.cost ? again : estimate;
}

/// Without `fit` only the windows' initial states are found, and the parameters stay where they are.
Fitted run_fit(PredictorPool& pool, const std::vector<FreeParameter>& parameters, bool fit,
               const MethodOptions& options) {
  Fitted fitted;
  fitted.given = fit ? rough_states(pool) : estimate_states(pool);
  fitted.numbers.before = values_of(pool.model(), parameters);
  if (fit) {
    const EstimateOptions search{options.iterations, settled(pool.data())};
    fitted.estimate = with_lost_windows(
        pool, parameters, gauss_newton(pool, parameters, fitted.numbers.before, fitted.given.x0, search),
        search);
  } else {
    fitted.estimate = fitted.given;
    fitted.estimate.theta = fitted.numbers.before;
  }
  fitted.numbers.after = fitted.estimate.theta;
  fitted.numbers.precision =
      precision_of(pool, pool.data().windows_of(Role::train), parameters, fitted.estimate);
  return fitted;
}

}  // namespace

StepResult window_fit(const Recipe& recipe, const Step& step, const std::vector<Trial>& trials,
                      const KnowledgeMap& knowledge, const MethodOptions& options) {
  const LinkedModel& linked = recipe.model(step.model);
  const std::vector<LinkedParameter> list = linked_parameters(linked, step, knowledge);
  std::vector<FreeParameter> parameters = parameters_of(list);
  const model::Model model = with_unknowns(linked, known_values(step, knowledge));
  PredictOptions predict;
  predict.window = step.window;
  Data data(trials, predict);
  data.stop = options.stop;
  check_can_move(model, parameters);
  set_typical(model, data, parameters);
  PredictorPool pool(model, data);
  const Fitted fitted = run_fit(pool, parameters, step.method == "window_fit", options);
  FitOptions judging;
  judging.confidence = options.confidence;
  const std::vector<FittedParameter> judged = judge(parameters, fitted.numbers, judging);
  StepResult result;
  result.step = step.name;
  std::vector<std::string> names;
  for (std::size_t p = 0; p < list.size(); ++p) {
    (list[p].free ? result.findings : result.updated).push_back(finding_of(list[p], judged[p]));
    if (list[p].free) {
      names.push_back(list[p].link.unknown);
    }
  }
  const auto free = static_cast<Eigen::Index>(names.size());
  const Eigen::MatrixXd H = step.method == "information"
                                ? exact_information(model, data, parameters, fitted.estimate, free)
                                : free_information(pool, parameters, fitted.estimate, free);
  if (step.method == "information") {
    set_deviations(H, search_units(parameters, fitted.estimate.theta), list, result.findings);
  }
  result.weak = weak_directions(H, names);
  result.correlations = strong_correlations(H, names);
  result.before = fitted.given.scores.train;
  result.after = fitted.estimate.scores.train;
  result.windows = static_cast<int>(data.windows.size());
  result.converged = fitted.estimate.converged;
  return result;
}

}  // namespace plumbline::validation
