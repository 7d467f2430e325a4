#include "controllers/atrias_running/actuator.h"

#include <algorithm>
#include <cmath>

namespace plumbline::controllers::atrias {

double Rate::update(double angle, double period, double share) {
  rate_ = known_ ? rate_ + share * ((angle - last_) / period - rate_) : 0.0;
  last_ = angle;
  known_ = true;
  return rate_;
}

void Drive::begin() {
  motor_.begin();
  link_.begin();
}

void Drive::read(const DriveNumbers& numbers, double motor, double link, double period, double motor_share,
                 double link_share) {
  motor_angle_ = motor / numbers.gear;
  stretch_ = motor_angle_ - link;
  motor_.update(motor, period, motor_share);
  link_.update(link, period, link_share);
}

// The servo drive's speed loop, with what the load and the friction are known to ask for.
double Drive::current(const DriveNumbers& numbers, double motor_speed, double load) const {
  const double way = std::tanh(motor_speed / numbers.friction_speed);
  const double torque = load + numbers.speed_gain * (motor_speed - motor_.value()) +
                        way * (numbers.friction + numbers.load_friction * std::abs(load));
  return std::clamp(torque / numbers.torque_constant, -numbers.current_limit, numbers.current_limit);
}

double Drive::current_for_torque(const DriveNumbers& numbers, double torque) const {
  const double speed = link_.value() + numbers.torque_rate * (torque / stiffness_ - stretch_);
  return current(numbers, numbers.gear * speed, torque / numbers.gear);
}

double Drive::current_for_angle(const DriveNumbers& numbers, double angle, double rate,
                                double acceleration) const {
  const double speed = rate + numbers.angle_rate * (angle - motor_angle_);
  return current(numbers, numbers.gear * speed, numbers.rotor_inertia * numbers.gear * acceleration);
}

}  // namespace plumbline::controllers::atrias
