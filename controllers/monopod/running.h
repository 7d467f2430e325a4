// The running controller of the monopod Thumper: hybrid zero dynamics, as Poulakakis and Grizzle, Modeling
// and Control of the Monopedal Robot Thumper, ICRA 2009 ("the paper") describe it. Equation numbers are the
// paper's.
//
// Torques impose two virtual constraints in each phase (equations 18 to 26). At each event the polynomials
// are bent so that the phase begins on its own constraints (27), and at each touchdown three of their end
// values are set by a linear feedback of the state (31).
#pragma once

#include "controllers/monopod/bezier.h"
#include "controllers/monopod/monopod.h"

namespace plumbline::monopod {

enum class Phase { flight, compression, injection, decompression };

/// Leg angle, leg shape, torso, their rates, and the velocity of the centre of mass: x_f of equations 30, 31.
/// Horizontal position does not matter, and height follows from the toe on the ground.
using Section = Eigen::Matrix<double, 8, 1>;

/// Torso at lift-off (rad), leg-shape motor at lift-off (rad), centre of mass ahead of the toe at touchdown
/// (m): beta.
using Betas = Eigen::Vector3d;

/// A nominal motion and what holds it.
struct Gait {
  Coefficients toe{};  ///< centre of mass ahead of the toe over the travel of a flight, m; the last is beta_f
  Coefficients shape{};  ///< leg shape over the same, rad
  /// Torso at touchdown and the third and fourth coefficient of equation 7, rad. The second follows from the
  /// rates at touchdown, the last three are beta_s,Tor.
  double torso_start = 0.0, torso_2 = 0.0, torso_3 = 0.0;
  double motor_middle = 0.5;      ///< fourth coefficient of equation 10, as a share of the way to beta_s,mLS
  double theta_max = 0.0;         ///< of both stance constraints, rad
  double injection_span = 0.0;    ///< theta from maximum compression to theta_max, rad
  double touchdown_height = 0.0;  ///< of the centre of mass, m: foretells the travel of a flight
  Betas beta = Betas::Zero();
  Section section = Section::Zero();  ///< just before touchdown
  Betas shift = Betas::Zero();        ///< added at each touchdown: to steer, and to find what beta does
  Eigen::Matrix<double, 3, 8> gain = Eigen::Matrix<double, 3, 8>::Zero();
  double kp = 0.0, kv = 0.0, epsilon = 1.0;  ///< equation 26, the same for both outputs; 1/s^2, 1/s, 1
};

/// The angle of the line from toe to hip, which grows through stance (equation 6 less its constant), rad.
inline double theta(const Vector6& q) { return q[kLegAngle] + q[kTorso]; }

Section section_of(const Constants& c, const State& state);

class Running {
 public:
  Running(const Constants& constants, const Gait& gait)
      : constants_(constants), gait_(gait), beta_(gait.beta) {}

  /// Torques of leg-angle and leg-shape motor for a state; the state's Dynamics may be at hand. NaN-free as
  /// long as the decoupling matrix is regular; returns zeros where it is not.
  Vector2 torque(const State& state, const Dynamics& d);

  void touch_down(const State& before, const State& after);
  void inject(const State& state);
  void decompress() { phase_ = Phase::decompression; }
  /// `height`: of the centre of mass over the ground.
  void lift_off(const State& state, double height);
  /// Let go in the air: straight to the touchdown's pose, without the swing of a whole flight.
  void drop(const State& state, double height);

  Phase phase() const { return phase_; }
  /// True once theta has passed the end of the polynomials.
  bool injected(const State& state) const { return theta(state.q) > motor_end_; }
  const Betas& beta() const { return beta_; }
  void set_beta(const Betas& beta) { beta_ = beta; }
  Vector2 output() const { return y_; }
  Vector2 output_rate() const { return y_rate_; }
  /// What the outputs are to be: torso and motor, or centre of mass ahead of toe and leg shape.
  Vector2 wanted() const { return wanted_; }
  const Gait& gait() const { return gait_; }
  const Constants& constants() const { return constants_; }

 private:
  Constants constants_;
  Gait gait_;
  Betas beta_;
  Phase phase_ = Phase::flight;
  Coefficients torso_{}, motor_{}, toe_{}, shape_{};
  double motor_hold_ = 0.0;
  double torso_begin_ = 0.0, torso_end_ = 1.0, motor_begin_ = 0.0, motor_end_ = 1.0;  // theta, rad
  double travel_begin_ = 0.0, travel_ = 1.0;                                          // m
  Vector2 y_ = Vector2::Zero(), y_rate_ = Vector2::Zero(), wanted_ = Vector2::Zero();
};

}  // namespace plumbline::monopod
