// The spring-mass model of running in three dimensions: a point mass, a massless leg with a linear spring, a
// foot that neither slips nor carries a moment.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>

namespace plumbline::spring_mass {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double degree = pi / 180.0;

/// Numbers of the model. The default ones are those of Wu, "The Theory, Implementation, and Evaluation of
/// Spring Mass Running on ATRIAS" (Carnegie Mellon University 2017), section 3.2.1: human size at about 5
/// m/s.
struct Body {
  double mass = 80.0;          ///< kg
  double gravity = 9.81;       ///< m/s^2
  double stiffness = 15000.0;  ///< N/m
  double rest_length = 1.0;    ///< m
  double energy = 1785.0;      ///< J, kinetic and potential, above the ground that the foot meets
};

/// Where the leg points in flight, in the apex frame: x along the velocity at the apex, z up.
/// The foot is at rest_length*[cos(attack)cos(splay), cos(attack)sin(splay), -sin(attack)] from the mass.
struct LegAngles {
  double attack = 0.0;  ///< rad; pi/2: straight down
  double splay = 0.0;   ///< rad; about the vertical, from the direction of motion
};

/// How a step ended.
enum class Ending {
  apex,       ///< in flight, at the next highest point
  stumbled,   ///< the foot was in the ground at the apex already
  fell,       ///< the mass reached the ground
  no_flight,  ///< the leg reached its rest length while the mass moved down
};
std::string to_string(Ending ending);

/// Position and velocity of the mass relative to the foot.
struct Moment {
  Eigen::Vector3d position;  ///< m
  Eigen::Vector3d velocity;  ///< m/s
};

/// The stance from touchdown (position at rest length from the foot) until the leg is at its rest length
/// again.
struct Stance {
  Ending ending = Ending::fell;
  Moment takeoff;
  double duration = 0.0;  ///< s
  double friction =
      0.0;  ///< largest horizontal over vertical leg force: what the ground's friction must give
};

/// m d2r/dt2 = k (l0/|l| - 1) l - m g e_z (equation 3.2), by the classical fourth-order Runge-Kutta method
/// with steps of a thousandth of 2 pi sqrt(m/k); the end by secants on |l| = l0, to 1e-12 m. `seen`, if
/// given, gets every step's moment and time.
Stance stance(const Body& body, const Moment& touchdown,
              const std::function<void(double, const Moment&)>& seen = nullptr);

/// What a step from one apex to the next does.
struct Step {
  Ending ending = Ending::fell;
  double apex = 0.0;          ///< m, next apex above the ground that the foot met
  double deflection = 0.0;    ///< rad, turn of the horizontal velocity, in (-pi, pi]
  double fall = 0.0;          ///< s, from the apex to touchdown
  double stance = 0.0;        ///< s
  double rise = 0.0;          ///< s, from take-off to the next apex
  double friction = 0.0;      ///< largest horizontal over vertical leg force
  Moment touchdown, takeoff;  ///< in the apex frame, relative to the foot
};

/// The behaviour function f of equation 3.4 and the way to it: from an apex at `apex` m above the ground with
/// the model's energy. Speed at the apex is sqrt(2 E/m - 2 g apex); an apex above E/(m g) is refused with
/// std::invalid_argument.
Step step(const Body& body, double apex, const LegAngles& leg);

/// The speed at an apex of this height, m/s; 0 where all the energy is height.
double apex_speed(const Body& body, double apex);

}  // namespace plumbline::spring_mass
