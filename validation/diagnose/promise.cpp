#include "validation/diagnose/promise.h"

#include <algorithm>

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

Promise promise_of(const Sum& train, const Sum& held_out, const std::vector<Eigen::Index>& chosen,
                   const Prior& known, const Room& bounds) {
  const Prior some{known.square, chosen_of(known.g, chosen), chosen_of(known.H, chosen)};
  const Foretold foretold = foretell(chosen_of(train, chosen), chosen_of(held_out, chosen), some,
                                     {chosen_of(bounds.lower, chosen), chosen_of(bounds.upper, chosen)});
  return {foretold.train_step, mean_square(foretold.train, train), mean_square(foretold.held_out, held_out)};
}

}  // namespace plumbline::validation
