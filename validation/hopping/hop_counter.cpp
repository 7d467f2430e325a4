#include "validation/hopping/hop_counter.h"

#include <algorithm>
#include <cmath>

namespace plumbline::validation {

void HopCounter::feet(double t, const std::vector<model::Touch>& touches) {
  for (std::size_t f = 0; f < 2; ++f) {
    const bool down = touches[f].depth > 0.0;
    if (down && !down_[f]) {
      since_[f] = t;
    }
    down_[f] = down;
  }
}

void HopCounter::load(const controllers::HoppingTorques& torques, double stretch_LA, double stretch_LS) {
  const auto raise = [](double& most, double value) { most = std::max(most, std::abs(value)); };
  const auto motor = [&](double& most, double torque, double limit) {
    raise(most, torque);
    const double spent = std::abs(torque) >= limit ? config_.period : 0.0;
    now_.time_at_limit += spent;
    time_at_limit_ += spent;
  };
  motor(now_.largest_torque_mLA, torques.mLA_left, config_.torque_limit_mLA);
  motor(now_.largest_torque_mLA, torques.mLA_right, config_.torque_limit_mLA);
  motor(now_.largest_torque_mLS, torques.mLS_left, config_.torque_limit_mLS);
  motor(now_.largest_torque_mLS, torques.mLS_right, config_.torque_limit_mLS);
  raise(now_.largest_stretch_LA, stretch_LA);
  raise(now_.largest_stretch_LS, stretch_LS);
}

void HopCounter::sample(double t, const Eigen::VectorXd& outputs, const controllers::Hopping& controller) {
  const double height = watch_.height(outputs);
  now_.lowest_hip = std::min(now_.lowest_hip, height);
  now_.highest_hip = std::max(now_.highest_hip, height);
  const bool first = !landed_ && controller.phase() == controllers::HoppingPhase::touchdown;
  if (first || controller.hops() > static_cast<long>(hops_.size())) {
    land(t, outputs, controller);
  }
}

void HopCounter::land(double t, const Eigen::VectorXd& outputs, const controllers::Hopping& controller) {
  if (landed_) {
    now_.landing = t;
    now_.period = t - last_time_;
    now_.travel = watch_.travel(outputs) - last_travel_;
    now_.torso = watch_.torso(outputs);
    now_.torso_wanted = controller.h_T_d();
    now_.touchdown_gap = std::abs(since_[0] - since_[1]);
    hops_.push_back(now_);
  }
  landed_ = true;
  last_time_ = t;
  last_travel_ = watch_.travel(outputs);
  now_ = Hop();
  now_.lowest_hip = now_.highest_hip = watch_.height(outputs);
}

}  // namespace plumbline::validation
