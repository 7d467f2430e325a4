// Gaits of the design model that repeat: fixed points of the map from step to step, and how fast it comes
// back.
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "validation/studies/walking/rigid_gait.h"

namespace plumbline::validation {

using controllers::WalkPhase;

RigidWalker::FixedPoint RigidWalker::fixed_point(const Eigen::Vector3d& guess,
                                                 const RigidGaitOptions& options) {
  FixedPoint point;
  point.at = guess;
  const Eigen::Vector3d steps(1e-4, 1e-4, 1e-3);
  const auto map = [&](const Eigen::Vector3d& before, RigidStep& step) {
    step = this->step(after_touchdown(before, options.impact_scale), options);
    return step.walked ? Eigen::Vector3d(before_touchdown(step.end) - before)
                       : Eigen::Vector3d::Zero().eval();
  };
  for (int round = 0; round < 12; ++round) {
    const Eigen::Vector3d off = map(point.at, point.step);
    if (!point.step.walked) {
      point.failure = point.step.failure;
      return point;
    }
    point.residual = off.cwiseAbs().maxCoeff();
    if (point.residual < 1e-7) {
      point.found = true;
      return point;
    }
    Eigen::Matrix3d slope;
    for (int i = 0; i < 3; ++i) {
      RigidStep aside;
      Eigen::Vector3d moved = point.at;
      moved[i] += steps[i];
      slope.col(i) = (map(moved, aside) - off) / steps[i];
      if (!aside.walked) {
        point.failure = aside.failure;
        return point;
      }
    }
    Eigen::Vector3d move = -slope.fullPivLu().solve(off);
    move *= std::min(1.0, 0.3 / move.cwiseAbs().maxCoeff());
    point.at += move;
  }
  point.failure = "Newton's method has not settled";
  return point;
}

RigidWalker::FixedPoint RigidWalker::settle(const Eigen::VectorXd& start, const RigidGaitOptions& options,
                                            int most, double tolerance) {
  FixedPoint point;
  Eigen::VectorXd x = start;
  for (int k = 0; k < most; ++k) {
    point.step = step(x, options);
    if (!point.step.walked) {
      point.failure = point.step.failure + " (step " + std::to_string(k + 1) + ")";
      return point;
    }
    const Eigen::Vector3d now = before_touchdown(point.step.end);
    point.residual = (now - point.at).cwiseAbs().maxCoeff();
    point.at = now;
    x = point.step.next;
    if (k > 0 && point.residual < tolerance) {
      point.found = true;
      return point;
    }
  }
  point.failure = "the steps have not settled";
  return point;
}

Eigen::VectorXd RigidWalker::multipliers(const Eigen::VectorXd& start, const RigidGaitOptions& options) {
  constexpr int kSize = 11;
  RigidStep ignored;
  Eigen::VectorXd x = start;
  if (!walk(x, {WalkPhase::motor_compress, true}, options, ignored)) {
    throw std::runtime_error("multipliers: " + ignored.failure);
  }
  const auto pack = [&](const Eigen::VectorXd& at) {
    const GaitCoordinates q = coordinates(at, false);
    const GaitCoordinates v = coordinates(at, true);
    Eigen::VectorXd xi(kSize);
    xi << q[1], q.tail<4>(), v[0], v[1], v.tail<4>();
    return xi;
  };
  const auto unpack = [&](const Eigen::VectorXd& xi) {
    GaitCoordinates q, v;
    q << gait_.gait.theta_si, xi[0], 0.0, xi.segment<4>(1);
    v << xi[5], xi[6], 0.0, xi.segment<4>(7);
    return compose(q, v);
  };
  const auto map = [&](const Eigen::VectorXd& xi) {
    RigidStep step;
    Eigen::VectorXd at = unpack(xi);
    bool walked = walk(at, {WalkPhase::spring_decompress, false}, options, step);
    if (walked) {
      at = touchdown(at, options.impact_scale, nullptr);
      walked = walk(at, {WalkPhase::motor_compress, true}, options, step);
    }
    if (!walked) {
      throw std::runtime_error("multipliers: " + step.failure);
    }
    return pack(at);
  };
  const Eigen::VectorXd at = pack(x);
  Eigen::MatrixXd slope(kSize, kSize);
  for (int i = 0; i < kSize; ++i) {
    const double h = 1e-4 * (i < 5 ? 1.0 : 10.0);
    Eigen::VectorXd up = at;
    Eigen::VectorXd down = at;
    up[i] += h;
    down[i] -= h;
    slope.col(i) = (map(up) - map(down)) / (2.0 * h);
  }
  const Eigen::VectorXcd values = slope.eigenvalues();
  Eigen::VectorXd sizes = values.cwiseAbs();
  std::sort(sizes.data(), sizes.data() + sizes.size(), std::greater<>());
  return sizes;
}

}  // namespace plumbline::validation
