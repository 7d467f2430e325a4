#include "validation/studies/running/design.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "validation/studies/running/return_map.h"

namespace plumbline::validation {
namespace {

using namespace monopod;
using Eigen::VectorXd;

constexpr int kPoints = 16;             // of each part at which curves, forces and torques are looked at
constexpr double kLost = 1e9;           // residuals beyond this are of a robot that fell
constexpr double kSettleStep = 2.5e-4;  // s, of the stride that is run with its events
constexpr int kSettleRounds = 8;
constexpr int kLimits = 7;
constexpr int kLimitResiduals = 11 * kPoints;  // torques, toe, normal and tangential force
constexpr double kBeyond = 0.01;               // share beyond a limit that is one residual
constexpr double kFeasible = 1e-3;             // in units of the scales; Newton's method closes what is left
constexpr double kTolerance = 1e-6;
constexpr double kToeScale = 0.01;  // m

/// The unknowns in one vector: they are named once, here, with start, bounds and scale.
class Unknowns {
 public:
  explicit Unknowns(const RunningDesign& d) : d_(d) {
    static constexpr double kRoom[8] = {0.2, 0.1, 0.1, 3.0, 3.0, 2.0, 0.5, 0.5};
    static constexpr double kScales[8] = {0.1, 0.1, 0.05, 1.0, 1.0, 1.0, 0.5, 0.5};
    for (const Section& section : {d.liftoff, d.touchdown}) {
      for (int i = 0; i < 8; ++i) {
        add(section[i], kRoom[i], kScales[i]);
      }
    }
    const State middle = guessed_middle();
    static constexpr double kMiddleRoom[8] = {0.3, 0.3, 0.6, 0.3, 5.0, 5.0, 20.0, 5.0};
    static constexpr double kMiddleScales[8] = {0.1, 0.1, 3.0, 0.05, 1.0, 1.0, 30.0, 1.0};
    for (int i = 0; i < 8; ++i) {
      add(i < 4 ? middle.q[i] : middle.v[i - 4], kMiddleRoom[i], kMiddleScales[i]);
    }
    add(d.flight, 5.0 * d.duration_tolerance, 0.01);
    add(d.stance, 5.0 * d.duration_tolerance, 0.01);
    add(d.compression, 0.2 * d.compression, 0.01);
    for (std::size_t k = 2; k <= 6; ++k) {
      add(k == 6 ? d.start.beta[2] : d.start.toe[k], 0.05, 0.05);
    }
    for (std::size_t k = 2; k <= 6; ++k) {
      add(d.start.shape[k], 0.05, 0.05);
    }
    add(d.start.torso_2, 0.3, 0.05);
    add(d.start.torso_3, 0.3, 0.05);
    add(d.start.beta[0], 0.05, 0.05);
    add(d.start.motor_middle, 0.8, 0.5);
    add(d.start.beta[1], 1.0, 1.0);
    add(d.start.theta_max, 0.1, 0.1);
    for (const FreeConstant& one : d.free) {
      start.push_back(one.start);
      lower.push_back(one.lower);
      upper.push_back(one.upper);
      scale.push_back(0.25 * (one.upper - one.lower));
    }
  }

  struct Read {
    Section liftoff, touchdown;
    State middle;  ///< toe in the origin, at rest
    double flight = 0.0, stance = 0.0, compression = 0.0;
    Gait gait;
    Constants constants;
  };

  Read read(const VectorXd& x) const {
    Read r;
    r.constants = d_.constants;
    for (std::size_t k = 0; k < d_.free.size(); ++k) {
      *constant_by_name(r.constants, d_.free[k].name) =
          x[x.size() - static_cast<Eigen::Index>(d_.free.size() - k)];
    }
    r.liftoff = x.head<8>();
    r.touchdown = x.segment<8>(8);
    r.middle.q.head<4>() = x.segment<4>(16);
    r.middle.v.head<4>() = x.segment<4>(20);
    stand_on_origin(r.constants, r.middle, true);
    Eigen::Index i = 24;
    r.flight = x[i++];
    r.stance = x[i++];
    r.compression = x[i++];
    Gait& gait = r.gait;
    gait = d_.start;
    gait.gain.setZero();
    gait.injection_span = 0.0;
    for (std::size_t k = 2; k <= 6; ++k) {
      gait.toe[k] = x[i++];
    }
    gait.beta[2] = gait.toe[6];
    for (std::size_t k = 2; k <= 6; ++k) {
      gait.shape[k] = x[i++];
    }
    gait.torso_2 = x[i++];
    gait.torso_3 = x[i++];
    gait.beta[0] = x[i++];
    gait.motor_middle = x[i++];
    gait.beta[1] = x[i++];
    gait.theta_max = x[i++];
    return r;
  }

  std::vector<double> start, lower, upper, scale;

 private:
  /// Compression from the guessed touchdown, on the guessed gait.
  State guessed_middle() const {
    Gait gait = d_.start;
    gait.torso_start = d_.touchdown[2];
    gait.section = d_.touchdown;
    Running control(d_.constants, gait);
    const State before = state_at(d_.constants, d_.touchdown);
    State state = before;
    const Dynamics d = dynamics(d_.constants, before);
    state.v = impact(d, stance(d), before.v);
    control.touch_down(before, state);
    for (int k = 0; k < d_.steps; ++k) {
      state = runge_kutta(control, state, d_.compression / d_.steps);
    }
    return state;
  }

  void add(double value, double room, double by) {
    start.push_back(value);
    lower.push_back(value - room);
    upper.push_back(value + room);
    scale.push_back(by);
  }
  const RunningDesign& d_;
};

/// What is seen in one part at the middles of its sixteenths.
struct Part {
  std::array<double, kPoints> time{};  ///< since the part began, s
  std::array<State, kPoints> state;
  std::array<ControlledState, kPoints> loop;
  State end;
};

Part run_part(Running& control, State state, double duration, int steps) {
  Part part;
  const double step = duration / steps;
  const int every = steps / kPoints;
  for (int k = 0; k < steps; ++k) {
    if (k % every == every / 2) {
      const auto at = static_cast<std::size_t>(k / every);
      part.time[at] = k * step;
      part.state[at] = state;
      part.loop[at] = closed_loop(control, state);
    }
    state = runge_kutta(control, state, step);
  }
  part.end = state;
  return part;
}

/// The three parts of a stride and the gaps between them.
struct Stride {
  Part flight, compression, rest;
  Gait gait;  ///< completed by what the unknowns say of it
  VectorXd gaps;
  ControlledState first, last;  ///< just after touchdown, just before lift-off
  double lift = 0.0;            ///< the toe's upward speed after lift-off, m/s
};

constexpr int kGaps = 27;

Stride run_stride(const Unknowns::Read& u, int steps) {
  const Constants& c = u.constants;
  Stride s;
  s.gait = u.gait;
  const State after_liftoff = state_at(c, u.liftoff), before_touchdown = state_at(c, u.touchdown);
  const Dynamics up = dynamics(c, after_liftoff), down = dynamics(c, before_touchdown);
  s.gait.toe[0] = up.com[0] - up.toe[0];
  s.gait.shape[0] = after_liftoff.q[kLegShape];
  s.gait.touchdown_height = down.com[1] - down.toe[1];
  s.gait.torso_start = u.touchdown[2];
  s.gait.section = u.touchdown;
  s.gait.injection_span = u.gait.theta_max - theta(u.middle.q);

  Running control(c, s.gait);
  control.lift_off(after_liftoff, up.com[1] - up.toe[1]);
  s.flight = run_part(control, after_liftoff, u.flight, steps);

  State touched = before_touchdown;
  touched.v = impact(down, stance(down), before_touchdown.v);
  control = Running(c, s.gait);
  control.touch_down(before_touchdown, touched);
  s.first = closed_loop(control, touched);
  s.compression = run_part(control, touched, u.compression, steps);
  control.inject(u.middle);
  s.rest = run_part(control, u.middle, u.stance - u.compression, steps);
  s.last = closed_loop(control, s.rest.end);
  const State next = internal_impact(c, s.rest.end);
  s.lift = (dynamics(c, next).toe_jacobian * next.v)[1];

  s.gaps.resize(kGaps);
  s.gaps.segment<8>(0) = section_of(c, s.flight.end) - u.touchdown;
  s.gaps[8] = dynamics(c, s.flight.end).toe[1];
  s.gaps.segment<4>(9) = (s.compression.end.q - u.middle.q).head<4>();
  s.gaps.segment<4>(13) = (s.compression.end.v - u.middle.v).head<4>();
  s.gaps[17] = deflection(c, u.middle.v);
  s.gaps[18] = deflection(c, s.rest.end.q);
  s.gaps.segment<8>(19) = section_of(c, next) - u.liftoff;
  return s;
}

/// By which the gaps are divided: what counts alike.
VectorXd gap_scales(const std::vector<double>& scale) {
  VectorXd by(kGaps);
  for (int i = 0; i < 8; ++i) {
    by[i] = by[19 + i] = scale[static_cast<std::size_t>(i)];
    by[9 + i] = scale[static_cast<std::size_t>(16 + i)];
  }
  by[8] = 0.01;
  by[17] = 5.0;
  by[18] = 0.1;
  return by;
}

class Problem {
 public:
  explicit Problem(const RunningDesign& design)
      : d_(design), unknowns_(design), gap_scale_(gap_scales(unknowns_.scale)) {
    const auto as_vector = [](const std::vector<double>& v) {
      return VectorXd(Eigen::Map<const VectorXd>(v.data(), static_cast<Eigen::Index>(v.size())));
    };
    squares_.start = as_vector(unknowns_.start);
    squares_.lower = as_vector(unknowns_.lower);
    squares_.upper = as_vector(unknowns_.upper);
    squares_.scale = as_vector(unknowns_.scale);
    squares_.residuals = curve_residuals() + 1 + static_cast<int>(d_.free.size()) + kLimitResiduals;
    squares_.equalities = kGaps;
    squares_.inequalities = kLimits;
    squares_.iterations = d_.iterations;
    squares_.print_level = d_.print_level;
    squares_.damping = d_.damping;
    squares_.tolerance = kTolerance;
    squares_.feasible = kFeasible;
    squares_.evaluate = [this](const VectorXd& x, LeastSquares::Values& values) {
      return evaluate(x, values);
    };
  }

  LeastSquaresResult solve() const { return validation::solve(squares_); }
  Stride stride(const VectorXd& x) const { return run_stride(unknowns_.read(x), d_.steps); }
  Unknowns::Read read(const VectorXd& x) const { return unknowns_.read(x); }
  static int curve_residuals() { return 2 * kPoints + 4 * kPoints + 2; }

 private:
  bool evaluate(const VectorXd& x, LeastSquares::Values& values) const {
    const Unknowns::Read u = unknowns_.read(x);
    const Stride s = run_stride(u, d_.steps);
    residuals(u, s, values.residuals);
    values.equalities = s.gaps.cwiseQuotient(gap_scale_);
    inequalities(u, s, values.inequalities);
    return values.residuals.allFinite() && values.equalities.allFinite() && values.inequalities.allFinite() &&
           values.residuals.norm() < kLost;
  }

  void residuals(const Unknowns::Read& u, const Stride& s, VectorXd& r) const {
    r.resize(squares_.residuals);
    Eigen::Index at = 0;
    for (std::size_t i = 0; i < kPoints; ++i) {
      const Dynamics& d = s.flight.loop[i].dynamics;
      r[at++] = (d.com[0] - d.toe[0] - d_.toe.at(s.flight.time[i])) / d_.toe.tolerance;
      r[at++] = (s.flight.state[i].q[kLegShape] - d_.shape.at(s.flight.time[i])) / d_.shape.tolerance;
      for (const Part* part : {&s.compression, &s.rest}) {
        const double t = part->time[i] + (part == &s.rest ? u.compression : 0.0);
        r[at++] = (part->state[i].q[kTorso] - d_.torso.at(t)) / d_.torso.tolerance;
        r[at++] = (part->state[i].q[kMotor] - d_.motor.at(t)) / d_.motor.tolerance;
      }
    }
    r[at++] = (u.stance - d_.stance) / d_.duration_tolerance;
    r[at++] = (u.flight - d_.flight) / d_.duration_tolerance;
    r[at++] = (s.last.force[1] - d_.force) / d_.force_tolerance;
    Constants c = u.constants;
    for (const FreeConstant& one : d_.free) {
      r[at++] = (*constant_by_name(c, one.name) - one.believed) / one.tolerance;
    }
    beyond_limits(u, s, r, at);
  }

  // What must not happen anywhere is a residual at each point, zero within the limit: a square whose slope is
  // continuous. Inequalities there have no slope as long as they hold by far and much of one where they do
  // not, and the line search gets stuck between the two.
  void beyond_limits(const Unknowns::Read& u, const Stride& s, VectorXd& r, Eigen::Index at) const {
    const double weight = total_mass(u.constants) * u.constants.gravity;
    const auto beyond = [&](double share) { r[at++] = std::max(0.0, share) / kBeyond; };
    for (const Part* part : {&s.flight, &s.compression, &s.rest}) {
      for (const ControlledState& loop : part->loop) {
        for (int m = 0; m < 2; ++m) {
          beyond(std::abs(loop.torque[m]) / d_.torque[m] - 1.0);
        }
        if (part == &s.flight) {
          beyond(-loop.dynamics.toe[1] / kToeScale);
        } else {
          beyond(-loop.force[1] / weight);
          beyond((std::abs(loop.force[0]) - d_.friction * loop.force[1]) / weight);
        }
      }
    }
  }

  void inequalities(const Unknowns::Read& u, const Stride& s, VectorXd& g) const {
    const double weight = total_mass(u.constants) * u.constants.gravity;
    const Vector2 first = s.first.force / weight, last = s.last.force / weight;
    g.resize(kLimits);
    g << first[1], d_.friction * first[1] - first[0], d_.friction * first[1] + first[0], last[1],
        d_.friction * last[1] - last[0], d_.friction * last[1] + last[0], s.lift - d_.lift;
  }

  const RunningDesign& d_;
  Unknowns unknowns_;
  VectorXd gap_scale_;
  LeastSquares squares_;
};

std::vector<DesignedRunning::Misfit> misfits_of(const RunningDesign& d, const VectorXd& residuals) {
  double sums[4] = {0.0, 0.0, 0.0, 0.0};  // toe, shape, torso, motor
  for (Eigen::Index i = 0, at = 0; i < kPoints; ++i) {
    sums[0] += std::pow(residuals[at++] * d.toe.tolerance, 2);
    sums[1] += std::pow(residuals[at++] * d.shape.tolerance, 2);
    for (int part = 0; part < 2; ++part) {
      sums[2] += std::pow(residuals[at++] * d.torso.tolerance, 2);
      sums[3] += std::pow(residuals[at++] * d.motor.tolerance, 2);
    }
  }
  return {{"centre of mass ahead of the toe, m", std::sqrt(sums[0] / kPoints)},
          {"leg shape, rad", std::sqrt(sums[1] / kPoints)},
          {"torso, rad", std::sqrt(sums[2] / (2 * kPoints))},
          {"leg-shape motor, rad", std::sqrt(sums[3] / (2 * kPoints))}};
}

}  // namespace

double WantedCurve::at(double t) const {
  const auto after = std::upper_bound(time.begin(), time.end(), t);
  if (after == time.begin()) {
    return value.front();
  }
  if (after == time.end()) {
    return value.back();
  }
  const auto i = static_cast<std::size_t>(after - time.begin());
  return value[i - 1] + (t - time[i - 1]) / (time[i] - time[i - 1]) * (value[i] - value[i - 1]);
}

double settle_on_fixed_point(const Constants& c, Gait& gait, double step, int rounds) {
  double error = 0.0;
  for (int i = 0; i <= rounds; ++i) {
    const auto next = next_touchdown(c, gait, gait.section, step);
    if (!next) {
      throw std::runtime_error("the motion that was designed does not last a stride");
    }
    const Section off = *next - gait.section;
    error = off.cwiseAbs().maxCoeff();
    if (i == rounds || error < 1e-11) {
      break;
    }
    const Eigen::Matrix<double, 8, 8> slope = linear_return(c, gait, step).by_state;
    gait.section += (Eigen::Matrix<double, 8, 8>::Identity() - slope).partialPivLu().solve(off);
  }
  return error;
}

DesignedRunning design_running(const RunningDesign& design) {
  const Problem problem(design);
  const LeastSquaresResult result = problem.solve();
  DesignedRunning done;
  const Unknowns::Read u = problem.read(result.x);
  done.constants = u.constants;
  done.gait = problem.stride(result.x).gait;
  done.liftoff = u.liftoff;
  const VectorXd curves = result.values.residuals.head(Problem::curve_residuals());
  done.misfit = std::sqrt(curves.squaredNorm() / static_cast<double>(curves.size()));
  done.misfits = misfits_of(design, curves);
  done.gap = result.values.equalities.cwiseAbs().maxCoeff();
  done.status = result.status;
  done.found = result.feasible;
  done.iterations = result.iterations;
  if (done.found) {
    done.period_error = settle_on_fixed_point(done.constants, done.gait, kSettleStep, kSettleRounds);
    if (!next_touchdown(done.constants, done.gait, done.gait.section, kSettleStep, &done.facts)) {
      throw std::runtime_error("the motion that was designed does not last a stride");
    }
  }
  return done;
}

}  // namespace plumbline::validation
