#include "validation/identify/diagnose/promise.h"

#include <algorithm>
#include <numeric>

namespace plumbline::validation {
namespace {

Eigen::VectorXd chosen_of(const Eigen::VectorXd& all, const std::vector<Eigen::Index>& chosen) {
  Eigen::VectorXd some(static_cast<Eigen::Index>(chosen.size()));
  for (std::size_t a = 0; a < chosen.size(); ++a) {
    some[static_cast<Eigen::Index>(a)] = all[chosen[a]];
  }
  return some;
}

Sum chosen_of(const Sum& all, const std::vector<Eigen::Index>& chosen) {
  Sum some{Eigen::MatrixXd(chosen.size(), chosen.size()), chosen_of(all.g, chosen), all.sse, all.samples};
  for (std::size_t a = 0; a < chosen.size(); ++a) {
    some.H.col(static_cast<Eigen::Index>(a)) = chosen_of(all.H.col(chosen[a]), chosen);
  }
  return some;
}

/// The floor is what the sensors leave: a linearised promise below it is no better than the floor.
double mean_square(double square, const Sum& sum) {
  return sum.samples > 0.0 ? std::max(square / sum.samples, 0.9) : 0.0;
}

}  // namespace

LinearProblem linear_problem(const Data& data, const std::vector<int>& windows,
                             const std::vector<Reduced>& reduced,
                             const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& theta,
                             const Eigen::VectorXd& units) {
  return {sum_of(reduced, windows, data, Role::train), sum_of(reduced, windows, data, Role::held_out),
          prior(parameters, units, theta), room(parameters, theta, units)};
}

LinearProblem linear_problem(const model::Model& model, const std::vector<FreeParameter>& parameters,
                             const Eigen::VectorXd& theta, const Data& data, const std::vector<int>& windows,
                             const std::vector<Eigen::VectorXd>& x0) {
  PredictorPool pool(model, data);
  const Eigen::VectorXd units = search_units(parameters, theta);
  return linear_problem(data, windows, reduce(pool, windows, parameters, theta, x0, units), parameters, theta,
                        units);
}

Promise promise_of(const LinearProblem& problem, const std::vector<Eigen::Index>& chosen) {
  const Prior& known = problem.known;
  const Room& bounds = problem.bounds;
  const Foretold foretold = foretell(chosen_of(problem.train, chosen), chosen_of(problem.held_out, chosen),
                                     {known.square, chosen_of(known.g, chosen), known.H(chosen, chosen)},
                                     {chosen_of(bounds.lower, chosen), chosen_of(bounds.upper, chosen)});
  return {foretold.train_step, mean_square(foretold.train, problem.train),
          mean_square(foretold.held_out, problem.held_out)};
}

Promise promise_of(const LinearProblem& problem) {
  std::vector<Eigen::Index> all(static_cast<std::size_t>(problem.train.g.size()));
  std::iota(all.begin(), all.end(), Eigen::Index{0});
  return promise_of(problem, all);
}

}  // namespace plumbline::validation
