#include "validation/identify/predict/state_search.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>

namespace plumbline::validation {
namespace {

constexpr double kLost = std::numeric_limits<double>::infinity();

/// A step of a window's state, and what a straight line promises it to take off the window's cost.
struct StateStep {
  Eigen::VectorXd shift;
  double promised = 0.0;
};

/// The steps of one window. One that made it worse is damped after Marquardt, which turns it away from what
/// the window hardly tells, where a straight line leads astray first; or merely shortened. The damping falls
/// again where a step keeps what a straight line promises of it.
class StateSteps {
 public:
  explicit StateSteps(bool straight) : straight_(straight) {}
  /// share * shift, or (H + damping diag(H)) step = H shift.
  StateStep next(const Reduced& one) const {
    StateStep step;
    if (straight_ || damping_ == 0.0) {
      step.shift = (straight_ ? share_ : 1.0) * one.x_shift;
    } else {
      Eigen::MatrixXd H = one.x_H;
      H.diagonal() *= 1.0 + damping_;
      step.shift = H.ldlt().solve(one.x_H * one.x_shift);
    }
    // All that the whole shift promises, less (shift - step)' H (shift - step).
    const Eigen::VectorXd rest = one.x_shift - step.shift;
    step.promised = one.raw_sse - one.sse - rest.dot(one.x_H * rest);
    return step;
  }
  /// It would be too short, or promises little; or the last ones have brought little. Dry friction bends a
  /// window's cost at every reversal: there what a full step promises is never reached.
  bool is_end(const StateStep& step, const Reduced& one) const {
    return (straight_ ? share_ < kShortest : step.promised < kLittle * one.raw_sse) || in_vain_ == kInVain;
  }
  /// After the step from `from` has left this cost.
  void after(const StateStep& step, const Reduced& from, double cost) {
    const double gain = from.raw_sse - cost;
    if (!(gain > 0.0)) {
      share_ *= 0.3;
      damping_ = std::max(kFactor * damping_, kFirst);
      return;
    }
    share_ = std::min(1.0, 2.0 * share_);
    if (gain / step.promised > kWell) {
      damping_ = damping_ > kFirst ? damping_ / kFactor : 0.0;
    }
    in_vain_ = gain < kLittle * from.raw_sse ? in_vain_ + 1 : 0;
  }

 private:
  static constexpr double kShortest = 0.01, kFirst = 1e-2, kFactor = 10.0;
  static constexpr double kLittle = 1e-3;  // of the cost
  static constexpr double kWell = 0.5;     // of the promise
  static constexpr int kInVain = 2;
  bool straight_;
  double share_ = 1.0, damping_ = 0.0;
  int in_vain_ = 0;  // steps in a row that brought little
};

/// Squared residuals of a window that begins at x0, and of what is known of x0; r are those of the window.
/// Infinite where it cannot be integrated from there, and where the squared residuals alone exceed `most`.
double cost(Predictor& predictor, const Window& window, const Eigen::VectorXd& x0, Eigen::VectorXd& r,
            double most = kLost) {
  try {
    const std::optional<Eigen::VectorXd> found = predictor.residual_within(window, x0, most);
    if (!found) {
      return kLost;
    }
    r = *found;
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return kLost;
  }
  return r.squaredNorm() + predictor.anchor(window, x0, r).r.squaredNorm();
}

}  // namespace

bool is_settled(const Reduced& reduced, const Settling& settling) {
  return reduced.raw_sse <= (1.0 + settling.much) * reduced.sse;
}

Settled StateSearch::from(const Eigen::VectorXd& x0) { return from(whole(), x0, true); }

// The parameters' columns are more than the states' and of no use on the way: once, at the end.
void StateSearch::settle(const Settling& settling, Settled& at) {
  const Eigen::VectorXd began = at.x0;
  settle(whole(), settling, at);
  if (units_.size() > 0 && at.x0 != began) {
    at = from(at.x0);
  }
}

Settled StateSearch::if_better(const Eigen::VectorXd& x0, const Reduced& than) {
  return if_better(whole(), x0, true, than);
}

void StateSearch::take_last_step(Settled& at) {
  // Of a step that takes less than a hundredth off, the rounding by a straight line is not seen.
  constexpr double kStraight = 1.01;
  Reduced& one = at.reduced;
  const Eigen::VectorXd there = at.x0 + one.x_shift;
  if (!one.curved && one.raw_sse <= kStraight * one.sse) {
    at.x0 = there;
    return;
  }
  pool_.with(window_, parameters_, theta_, [&](Predictor& predictor) {
    Eigen::VectorXd r;
    one.sse = cost(predictor, whole(), there, r);
    if (one.sse < one.raw_sse) {
      at.x0 = there;
    } else {
      one.sse = cost(predictor, whole(), at.x0, r);
    }
    one.square = predictor.squares(whole(), r);
  });
}

Settled StateSearch::grown(const Eigen::VectorXd& start, const Settling& settling) {
  constexpr int kParts = 10;
  constexpr double kFar = 3.0;  // floors
  const Data& data = pool_.data();
  const Trial& trial = data.trials[static_cast<std::size_t>(whole().trial)];
  Eigen::VectorXd x0 = start;
  for (int k = 1; k < kParts; ++k) {
    const double share = static_cast<double>(k) / kParts;
    const Window part = beginning_of(whole(), trial, share);
    Settled at = from(part, x0, false);
    settle(part, settling, at);
    if (at.reduced.raw_sse > kFar * kFar * share * readings(data, window_)) {
      break;
    }
    x0 = at.x0;
  }
  Settled at = from(x0);
  settle(settling, at);
  return at;
}

Settled StateSearch::from(const Window& part, const Eigen::VectorXd& x0, bool with_parameters) {
  Settled at{x0, {}};
  at.reduced.raw_sse = at.reduced.sse = kLost;
  const bool is_moving = with_parameters && units_.size() > 0;
  const std::vector<FreeParameter> moving = is_moving ? parameters_ : std::vector<FreeParameter>();
  const Eigen::VectorXd slopes = is_moving ? search_slopes(moving, units_, theta_) : Eigen::VectorXd();
  try {
    pool_.with(window_, parameters_, theta_,
               [&](Predictor& predictor) { at.reduced = reduce(predictor, part, x0, moving, slopes); });
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return at;
  }
  return at;
}

Settled StateSearch::if_better(const Window& part, const Eigen::VectorXd& x0, bool with_parameters,
                               const Reduced& than) {
  Settled at{x0, {}};
  pool_.with(window_, parameters_, theta_, [&](Predictor& predictor) {
    Eigen::VectorXd r;
    at.reduced.raw_sse = cost(predictor, part, x0, r, than.raw_sse);
  });
  return than.raw_sse <= at.reduced.raw_sse ? at : from(part, x0, with_parameters);
}

void StateSearch::settle(const Window& part, const Settling& settling, Settled& at) {
  StateSteps steps(settling.straight);
  for (int i = 0; i < settling.steps && !is_settled(at.reduced, settling); ++i) {
    const StateStep step = steps.next(at.reduced);
    if (steps.is_end(step, at.reduced)) {
      return;
    }
    Settled next = if_better(part, at.x0 + step.shift, false, at.reduced);
    steps.after(step, at.reduced, next.reduced.raw_sse);
    if (next.reduced.raw_sse < at.reduced.raw_sse) {
      at = std::move(next);
    }
  }
}

}  // namespace plumbline::validation
