// One series-elastic drive: motor, gear, leaf spring, link. Wu (2017), sections 4.3.4, 5.4.3 and 5.5.
#pragma once

namespace plumbline::controllers::atrias {

/// Rate of an angle: difference of two samples, through a low-pass of first order.
class Rate {
 public:
  void begin() { known_ = false; }
  /// `share`: of the newest difference, period/(period + time constant).
  double update(double angle, double period, double share);
  double value() const { return rate_; }

 private:
  double last_ = 0.0, rate_ = 0.0;
  bool known_ = false;
};

struct DriveNumbers {
  double gear = 50.0;
  double torque_constant = 0.121;  ///< N m/A
  double rotor_inertia = 1.5e-3;   ///< kg m^2
  double current_limit = 165.0;    ///< A
  double speed_gain = 0.2;         ///< N m s/rad, of the motor's speed loop
  double torque_rate = 100.0;      ///< 1/s, of the spring's torque error (equation 4.6)
  double angle_rate = 50.0;        ///< 1/s, of the angle error of a leg in the air
  double friction = 0.0;           ///< N m at the motor, compensated
  double load_friction = 0.0;      ///< of the load at the motor, compensated
  double friction_speed = 2.0;     ///< rad/s of the motor, within which the compensation changes its sign
};

/// The current for a wanted spring torque, or for a wanted angle of the link.
class Drive {
 public:
  explicit Drive(double stiffness) : stiffness_(stiffness) {}
  void begin();
  /// Angles of motor and link relative to the trunk (rad).
  void read(const DriveNumbers& numbers, double motor, double link, double period, double motor_share,
            double link_share);
  double torque() const { return stiffness_ * stretch_; }  ///< N m, of the spring, on the link
  double link_rate() const { return link_.value(); }       ///< rad/s

  /// d stretch/dt = torque_rate (wanted stretch - stretch), by the motor's speed.
  double current_for_torque(const DriveNumbers& numbers, double torque) const;
  /// As if the spring were rigid: the motor goes where the link should be.
  double current_for_angle(const DriveNumbers& numbers, double angle, double rate, double acceleration) const;

 private:
  double current(const DriveNumbers& numbers, double motor_speed, double load) const;

  double stiffness_;  // N m/rad at the joint
  double stretch_ = 0.0, motor_angle_ = 0.0;
  Rate motor_, link_;
};

}  // namespace plumbline::controllers::atrias
