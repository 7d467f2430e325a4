#include "simulator/integrate/one_step_backend.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulator/integrate/switch_search.h"

namespace plumbline::integrate {
namespace {

/// How closely a switch found within a step of size h to time t is located.
double time_tolerance(double t, double h) {
  return std::max(1e-11 * h, 256.0 * std::numeric_limits<double>::epsilon() * (std::abs(t) + h));
}

}  // namespace

bool OneStepBackend::advance(double t_stop) {
  if (directions_.empty()) {
    steps(t_stop);
    return false;
  }
  return step_once(t_stop);
}

bool OneStepBackend::step_once(double t_stop) {
  if (directions_.empty()) {
    step(t_stop);
    return false;
  }
  if (!switches_known_) bridge_.switches_at(t_, x_, g_);
  const double t_before = t_;
  x_before_ = x_;
  g_before_ = g_;
  step(t_stop);
  bridge_.switches_at(t_, x_, g_);
  switches_known_ = true;
  const bool found = any_changes_sign(g_before_, g_);
  if (found) locate(t_before, t_);
  return found;
}

void OneStepBackend::go_to(double t, const Eigen::VectorXd& x, double t_stop) {
  t_ = t;
  x_ = x;
  moved();
  while (t_ < t_stop) steps(t_stop);
}

// The interpolant says where the switch is to about its own error; each integration to that place measures
// the error there, and so moves the next guess by a factor h^3 closer.
void OneStepBackend::locate(double t_before, double t_after) {
  Eigen::VectorXd x_behind = x_;
  const Eigen::VectorXd x_after = x_;
  Eigen::VectorXd f_before(x_.size()), f_after(x_.size()), x_model(x_.size()), g_model(g_.size());
  Eigen::VectorXd defect = Eigen::VectorXd::Zero(g_.size());
  bridge_.rate_at(t_before, x_before_, f_before);
  bridge_.rate_at(t_after, x_after, f_after);
  const CubicHermite model(t_before, x_before_, f_before, t_after, x_after, f_after);
  const auto model_switches = [&](double t) -> const Eigen::VectorXd& {
    model.at(t, x_model);
    bridge_.switches_at(t, x_model, g_model);
    return g_model;
  };
  SwitchBracket bracket(t_before, g_before_, t_after, g_);
  const double tolerance = time_tolerance(t_after, bracket.width());
  for (int trial = 0; bracket.width() > tolerance; ++trial) {
    SwitchBracket search = bracket;
    while (search.width() > 0.25 * tolerance) {
      const double t = search.guess();
      search.narrow(t, model_switches(t) + defect);
    }
    if (bracket.hi() - search.hi() <= tolerance) break;
    // The model is no help where it does not converge: then halve.
    const double guess = trial < 8 ? search.hi() + 0.5 * tolerance : 0.5 * (bracket.lo() + bracket.hi());
    go_to(t_before, x_before_, guess);
    bridge_.switches_at(t_, x_, g_);
    defect = g_ - model_switches(t_);
    bracket.narrow(t_, g_);
    if (bracket.hi() == t_) x_behind = x_;
  }
  t_ = bracket.hi();
  x_ = x_behind;
  bridge_.switches_at(t_, x_, g_);
  bracket.directions(directions_);
  moved();
  ++restarts_;
}

}  // namespace plumbline::integrate
