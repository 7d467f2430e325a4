// A linearly implicit one-step method: one Jacobian, which may be approximate, and one factorisation a step.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "simulator/integrate/one_step_backend.h"
#include "simulator/integrate/step_control.h"

namespace plumbline::integrate {
namespace {

constexpr int kStages = 4;

/// ROS34PW2: order 3 for any matrix in place of the Jacobian (a W-method), with an embedded method of order
/// 2, stiffly accurate and L-stable with the Jacobian itself. Source: J. Rang, L. Angermann, New Rosenbrock
/// W-methods of order 3 for partial differential algebraic equations of index 1, BIT 45 (2005) 761.
/// In the variables that save products with the Jacobian (Hairer and Wanner, Solving ODEs II, IV.7):
///   (I/(h gamma) - J) u_i = f(t + alpha_i h, x + sum a_ij u_j) + sum c_ij/h u_j,   x' = x + sum m_i u_i.
struct Tableau {
  double gamma = 0.43586652150845900;
  Eigen::Matrix4d a, c;
  Eigen::Vector4d alpha, m, error;

  Tableau() {
    Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
    A(1, 0) = 0.87173304301691801;
    A(2, 0) = 0.84457060015369423;
    A(2, 1) = -0.11299064236484185;
    A(3, 2) = 1.0;
    Eigen::Matrix4d G = gamma * Eigen::Matrix4d::Identity();
    G(1, 0) = -0.87173304301691801;
    G(2, 0) = -0.90338057013044082;
    G(2, 1) = 0.054180672388095326;
    G(3, 0) = 0.24212380706095346;
    G(3, 1) = -1.2232505839045147;
    G(3, 2) = 0.54526025533510214;
    const Eigen::Vector4d b(0.24212380706095346, -1.2232505839045147, 1.5452602553351020, gamma);
    const Eigen::Vector4d b2(0.37810903145819369, -0.096042292212423178, 0.5, 0.21793326075422950);
    const Eigen::Matrix4d inverse = G.inverse();
    a = A * inverse;
    c = Eigen::Matrix4d::Identity() / gamma - inverse;
    alpha = A.rowwise().sum();
    m = inverse.transpose() * b;
    error = m - inverse.transpose() * b2;
  }
};

class RosenbrockBackend : public OneStepBackend {
 public:
  RosenbrockBackend(Bridge& bridge, const Options& options)
      : OneStepBackend(bridge, options),
        n_(x_.size()),
        positions_(bridge.ode().has_jacobian() ? bridge.ode().positions() : 0),
        rest_(n_ - positions_),
        control_(3),
        J_(n_, n_),
        W_(rest_, rest_),
        u_(n_, kStages),
        trial_(x_),
        f_(x_),
        f_begin_(x_),
        reach_(x_),
        solved_(rest_),
        factor_(rest_) {}

  void start(double t, const Eigen::VectorXd& x) override {
    t_ = t;
    x_ = x;
    control_ = StepControl(3);
    counts_ = Counts();
    forget_switches();
    next_ = 0.0;
    reach_.setZero();
  }

  Counts counts() const override {
    Counts counts = counts_;
    counts.restarts = restarts_;
    return counts;
  }

  int worst_state() const override {
    return counts_.steps + counts_.error_test_failures == 0 ? -1 : largest(f_.array() / weight());
  }

 protected:
  void step(double t_stop) override;
  void steps(double t_stop) override {
    const long first = counts_.steps;
    while (t_stop - t_ > roundoff(t_stop) && counts_.steps - first < options_.max_steps) step(t_stop);
  }
  void moved() override {}

 private:
  static double roundoff(double t) { return 4.0 * std::numeric_limits<double>::epsilon() * std::abs(t); }
  void evaluate_jacobian();
  void begin_step();
  double first_step(double t_stop);
  void factorise(double h);
  void solve(double h, Eigen::Index stage);
  double try_step(double h);
  Eigen::ArrayXd weight() const;
  double norm(const Eigen::VectorXd& error) const;

  const Tableau method_;
  const Eigen::Index n_, positions_, rest_;
  StepControl control_;
  Counts counts_;
  double next_ = 0.0;  // step to try; 0: not known
  Eigen::MatrixXd J_, W_, u_;
  Eigen::VectorXd trial_, f_, f_begin_, reach_, solved_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factor_;
};

void RosenbrockBackend::evaluate_jacobian() {
  ++counts_.jacobian_evaluations;
  if (bridge_.ode().has_jacobian()) {
    bridge_.ode().jacobian(t_, x_.data(), J_);
    return;
  }
  Eigen::VectorXd there(n_);
  trial_ = x_;
  for (Eigen::Index i = 0; i < n_; ++i) {
    const double step = 1e-7 * std::max(std::abs(x_[i]), 1e-3);
    trial_[i] = x_[i] + step;
    bridge_.rate_at(t_, trial_, there);
    J_.col(i) = (there - f_begin_) / step;
    trial_[i] = x_[i];
  }
}

// What every attempt at this step shares.
void RosenbrockBackend::begin_step() {
  bridge_.rate_at(t_, x_, f_begin_);
  evaluate_jacobian();
  if (options_.weight == Weight::reach) {
    bridge_.ode().reach(x_.data(), reach_.data());
  } else {
    reach_ = x_.cwiseAbs();
  }
}

Eigen::ArrayXd RosenbrockBackend::weight() const {
  return options_.relative_tolerance * reach_.array().max(trial_.array().abs()) +
         options_.absolute_tolerance.array();
}

double RosenbrockBackend::norm(const Eigen::VectorXd& error) const {
  return std::sqrt((error.array() / weight()).square().mean());
}

// A step along which the rate alone changes the state by a hundredth of its weight's reach (Hairer, Norsett,
// Wanner, Solving ODEs I, II.4, without the second look).
double RosenbrockBackend::first_step(double t_stop) {
  trial_ = x_;
  const double d0 = norm(x_);
  const double d1 = norm(f_begin_);
  const double h = d0 > 1e-5 && d1 > 1e-5 ? 0.01 * d0 / d1 : 1e-6;
  return std::min(h, t_stop - t_);
}

// Positions z with z' = w leave the system by u_z = h gamma (r_z + u_w).
void RosenbrockBackend::factorise(double h) {
  W_ = -J_.bottomRightCorner(rest_, rest_);
  W_.leftCols(positions_) -= h * method_.gamma * J_.bottomLeftCorner(rest_, positions_);
  W_.diagonal().array() += 1.0 / (h * method_.gamma);
  factor_.compute(W_);
}

// f_ holds the right-hand side.
void RosenbrockBackend::solve(double h, Eigen::Index stage) {
  const double hg = h * method_.gamma;
  auto u = u_.col(stage);
  solved_ = f_.tail(rest_);
  solved_.noalias() += hg * (J_.bottomLeftCorner(rest_, positions_) * f_.head(positions_));
  u.tail(rest_) = factor_.solve(solved_);
  u.head(positions_) = hg * (f_.head(positions_) + u.segment(positions_, positions_));
}

// Leaves the new state in trial_ and returns the scaled error; infinite when a rate is not finite.
double RosenbrockBackend::try_step(double h) {
  factorise(h);
  for (int i = 0; i < kStages; ++i) {
    if (i == 0) {
      f_ = f_begin_;
    } else {
      trial_ = x_;
      for (int j = 0; j < i; ++j) {
        if (method_.a(i, j) != 0.0) trial_ += method_.a(i, j) * u_.col(j);
      }
      bridge_.rate_at(t_ + method_.alpha[i] * h, trial_, f_);
    }
    for (int j = 0; j < i; ++j) {
      f_ += method_.c(i, j) / h * u_.col(j);
    }
    if (!f_.allFinite()) {
      return std::numeric_limits<double>::infinity();
    }
    solve(h, i);
  }
  trial_ = x_;
  trial_.noalias() += u_ * method_.m;
  f_.noalias() = u_ * method_.error;
  return trial_.allFinite() ? norm(f_) : std::numeric_limits<double>::infinity();
}

void RosenbrockBackend::step(double t_stop) {
  const bool fixed = options_.fixed_step > 0.0;
  control_.set_stop(t_, t_stop);
  begin_step();
  double h = fixed ? options_.fixed_step : next_ > 0.0 ? next_ : first_step(t_stop);
  for (int trial = 0;; ++trial) {
    h = std::min(h, t_stop - t_);
    if (options_.max_step > 0.0) h = std::min(h, options_.max_step);
    const double error = try_step(h);
    const bool accepted = fixed || error <= 1.0;
    const double after = t_ + h;
    next_ = control_.next(accepted ? after : t_, h, error);
    if (accepted) {
      t_ = t_stop - after <= roundoff(t_stop) ? t_stop : after;
      x_.swap(trial_);
      if (bridge_.ode().has_projection()) {
        bridge_.largest_projection =
            std::max(bridge_.largest_projection, bridge_.ode().project(t_, x_.data()));
      }
      ++counts_.steps;
      return;
    }
    ++counts_.error_test_failures;
    h = next_;
    if (!(t_ + h > t_) || trial > 30) {
      const std::string cause = std::isfinite(error) ? "" : " Some rates were not finite.";
      fail("no step is small enough for the error test." + cause);
    }
  }
}

}  // namespace

std::unique_ptr<Backend> make_rosenbrock_backend(Bridge& bridge, const Options& options) {
  return std::make_unique<RosenbrockBackend>(bridge, options);
}

}  // namespace plumbline::integrate
