// A monopod's equations of motion in closed form, for the controller's own use: three links and a
// transmission, as the robot Thumper has them.
//
// Coordinates q, in this order: leg angle, leg shape, leg-shape motor, torso, and the hip's position x and z
// (rad, m). x points forward, z up. Angles turn forward over the top (about +y) and are zero with the torso
// upright and the leg straight down: thigh = torso + leg angle + leg shape, shin = torso + leg angle - leg
// shape. The knee points backward. This is the mirror image of Figure 1(b) of Poulakakis and Grizzle,
// Modeling and Control of the Monopedal Robot Thumper, ICRA 2009 ("the paper"), whose robot runs towards -x;
// its leg angle is larger by pi.
#pragma once

#include <Eigen/Core>

namespace plumbline::monopod {

enum Coordinate : int { kLegAngle, kLegShape, kMotor, kTorso, kHipX, kHipZ };

using Vector2 = Eigen::Vector2d;
using Vector4 = Eigen::Matrix<double, 4, 1>;
using Vector5 = Eigen::Matrix<double, 5, 1>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix62 = Eigen::Matrix<double, 6, 2>;
using Matrix26 = Eigen::Matrix<double, 2, 6>;

/// A rigid link: its centre of mass is given in its own frame, which sits on its upper joint (the torso's on
/// the hip).
struct Link {
  double mass = 0.0;     ///< kg
  double x = 0.0;        ///< of the centre of mass, m
  double z = 0.0;        ///< m
  double inertia = 0.0;  ///< about the centre of mass, kg m^2
};

struct Constants {
  Link torso, thigh, shin;
  double upper_length = 0.0, lower_length = 0.0;  ///< m
  double angle_ratio = 0.0;                       ///< motor's turn for each turn of the leg angle
  double shape_ratio = 0.0;       ///< motor's turn for each turn of the leg shape, spring at rest
  double spring_ratio = 0.0;      ///< turn of B_Spring for each turn of the leg shape, motor held
  double angle_inertia = 0.0;     ///< of rotor and pulleys, at the leg-angle motor, kg m^2
  double shape_inertia = 0.0;     ///< the same at the leg-shape motor
  double spring_inertia = 0.0;    ///< of B_Spring, kg m^2
  double spring_stiffness = 0.0;  ///< at B_Spring, N m/rad
  double spring_preload = 0.0;    ///< N m, presses B_Spring towards its stop
  double spring_damping = 0.0;    ///< N m s/rad
  double angle_friction = 0.0;    ///< at the motor, N m s/rad
  double shape_friction = 0.0;    ///< at the motor, N m s/rad
  double gravity = 0.0;           ///< m/s^2
};

struct State {
  Vector6 q = Vector6::Zero();
  Vector6 v = Vector6::Zero();
};

/// M q'' + h = B u (+ J' F of the ground), and where toe and centre of mass are and how they move.
struct Dynamics {
  Matrix6 mass;      ///< M
  Vector6 bias;      ///< h: Coriolis, gravity, spring, friction
  Matrix62 input;    ///< B: torques of the leg-angle and the leg-shape motor
  Vector2 toe, com;  ///< m
  Matrix26 toe_jacobian, com_jacobian;
  Vector2 toe_bias, com_bias;  ///< d(J)/dt q', m/s^2
};

Dynamics dynamics(const Constants& c, const State& state);

double total_mass(const Constants& c);
/// Of B_Spring, rad; above zero the spring is compressed.
double deflection(const Constants& c, const Vector6& q);
/// Kinetic and potential, J; heights count from z = 0.
double energy(const Constants& c, const State& state);

/// Velocities and accelerations that a constraint leaves, q' = S s', q'' = S s'' + gamma.
template <int N>
struct Reduced {
  Eigen::Matrix<double, 6, N> s;
  Vector6 gamma;
  Eigen::Matrix<double, N, 6> inverse_st;  ///< (S' M S)^-1 S'
};

/// Toe pinned: s = leg angle, leg shape, motor, torso.
Reduced<4> stance(const Dynamics& d);
/// B_Spring on its stop: s = leg angle, leg shape, torso, hip x, hip z.
Reduced<5> flight(const Constants& c, const Dynamics& d);

/// q'' = drift + gain u of the constrained robot.
struct Acceleration {
  Vector6 drift;
  Matrix62 gain;
};
template <int N>
Acceleration accelerations(const Dynamics& d, const Reduced<N>& r) {
  Acceleration a;
  a.gain.noalias() = r.s * (r.inverse_st * d.input);
  a.drift = r.gamma - r.s * (r.inverse_st * (d.bias + d.mass * r.gamma));
  return a;
}

/// What the ground exerts on the pinned toe, N.
Vector2 ground_force(const Dynamics& d, const Vector6& acceleration);

/// The velocities after a rigid, inelastic impact at which the constraint begins: (S' M S) s' = S' M v.
template <int N>
Vector6 impact(const Dynamics& d, const Reduced<N>& r, const Vector6& v) {
  return r.s * (r.inverse_st * (d.mass * v));
}

/// The hip over a toe that stands in the origin (fills q of hip x and z, and v if the toe rests).
void stand_on_origin(const Constants& c, State& state, bool also_velocity);

}  // namespace plumbline::monopod
