// What a step on a few of the linearised windows' unknowns promises.
#pragma once

#include <vector>

#include "validation/predict/foretell.h"

namespace plumbline::validation {

struct Promise {
  Eigen::VectorXd step;                ///< of the chosen unknowns: the best for the train windows
  double train = 0.0, held_out = 0.0;  ///< mean squares (1: the floor) after it, held-out as foretold
};

/// The best step of the chosen unknowns within their bounds; the others stay where they are.
Promise promise_of(const Sum& train, const Sum& held_out, const std::vector<Eigen::Index>& chosen,
                   const Prior& known, const Room& bounds);

}  // namespace plumbline::validation
