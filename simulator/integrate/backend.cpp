#include "simulator/integrate/backend.h"

#include <cmath>

namespace plumbline::integrate {

int Backend::largest(const Eigen::ArrayXd& weighed) {
  for (Eigen::Index i = 0; i < weighed.size(); ++i) {
    if (!std::isfinite(weighed[i])) return static_cast<int>(i);
  }
  Eigen::Index worst = 0;
  return weighed.abs().maxCoeff(&worst) > 0.0 ? static_cast<int>(worst) : -1;
}

std::string Backend::worst() {
  const int state = worst_state();
  if (state >= 0) return " Largest local error: " + bridge_.ode().state_name(state) + ".";
  Eigen::VectorXd rate(x_.size());
  bridge_.rate_at(t_, x_, rate);
  const Eigen::ArrayXd weight =
      options_.relative_tolerance * x_.array().abs() + options_.absolute_tolerance.array();
  const int fastest = largest(rate.array() / weight);
  return fastest < 0 ? "" : " Fastest against its tolerance: " + bridge_.ode().state_name(fastest) + ".";
}

int Backend::largest_estimate(void* memory, GetVector errors, GetVector weights,
                              const Context& context) const {
  Eigen::VectorXd error = x_;
  Eigen::VectorXd weight = x_;
  const Vector error_view = view(error, context);
  const Vector weight_view = view(weight, context);
  errors(memory, error_view.get());
  weights(memory, weight_view.get());
  return largest(error.array() * weight.array());
}

}  // namespace plumbline::integrate
