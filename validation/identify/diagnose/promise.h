// What a step on a few of the linearised windows' unknowns promises.
#pragma once

#include <vector>

#include "validation/identify/predict/foretell.h"

namespace plumbline::validation {

struct Promise {
  Eigen::VectorXd step;                ///< of the chosen unknowns: the best for the train windows
  double train = 0.0, held_out = 0.0;  ///< mean squares (1: the floor) after it, held-out as foretold
};

/// The linearised windows of both roles, what is known of the unknowns, and how far they may go.
struct LinearProblem {
  Sum train, held_out;
  Prior known;
  Room bounds;
};

/// Of windows that were reduced at theta; `units`: of the reduction.
LinearProblem linear_problem(const Data& data, const std::vector<int>& windows,
                             const std::vector<Reduced>& reduced,
                             const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& theta,
                             const Eigen::VectorXd& units);

/// The same, reduced here: the windows from x0 with the model's parameters at theta.
LinearProblem linear_problem(const model::Model& model, const std::vector<FreeParameter>& parameters,
                             const Eigen::VectorXd& theta, const Data& data, const std::vector<int>& windows,
                             const std::vector<Eigen::VectorXd>& x0);

/// The best step of the chosen unknowns within their bounds; the others stay where they are.
Promise promise_of(const LinearProblem& problem, const std::vector<Eigen::Index>& chosen);

/// The best step of all.
Promise promise_of(const LinearProblem& problem);

}  // namespace plumbline::validation
