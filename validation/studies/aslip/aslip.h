// The Asymmetric Spring Loaded Inverted Pendulum under its SLIP-embedding controller.
//
// Source: I. Poulakakis, J. W. Grizzle, "The Spring Loaded Inverted Pendulum as the Hybrid Zero Dynamics of
// an Asymmetric Hopper", IEEE Transactions on Automatic Control 54(8), 2009 ("TAC" below; equation numbers
// are of the submitted manuscript).
#pragma once

#include <array>
#include <vector>

namespace plumbline::validation {

/// A torso on a massless leg with a spring, its hip a distance below the centre of mass (TAC Table I).
struct AslipModel {
  double mass = 0.0;              ///< m, kg
  double inertia = 0.0;           ///< J about the centre of mass, kg m^2
  double hip_to_com = 0.0;        ///< L, m
  double leg_length = 0.0;        ///< l0 at touchdown, m
  double spring_rest = 0.0;       ///< l_nat, m
  double spring_stiffness = 0.0;  ///< k_A, N/m
  double gravity = 0.0;           ///< m/s^2
};

/// The target SLIP and the gains (TAC equations 41, 42, 58, 59, 64, 72, 73).
struct SlipEmbedding {
  double pitch = 0.0;       ///< rad, from the horizontal to the line from hip to centre of mass
  double stiffness = 0.0;   ///< k of the target SLIP, N/m
  double radius = 0.0;      ///< r0, from toe to centre of mass at touchdown and lift-off, m
  double pretension = 0.0;  ///< Delta r, m
  double touchdown =
      0.0;  ///< psi, the line from centre of mass to toe against the vertical, toe ahead positive, rad
  double speed = 0.0;                                             ///< forward speed before lift-off, m/s
  double energy = 0.0;                                            ///< E of equation 60 on the orbit, J
  double pitch_gain = 0.0, pitch_rate_gain = 0.0, epsilon = 1.0;  ///< 1/s^2, 1/s, 1
  double energy_gain = 0.0;                                       ///< K_P^E, 1/m
  double speed_gain = 0.0;                                        ///< K_xdot, rad s/m
};

/// Position of the centre of mass over the ground, pitch, and their rates: m, rad, m/s, rad/s.
struct AslipState {
  double x = 0.0, y = 0.0, pitch = 0.0, x_rate = 0.0, y_rate = 0.0, pitch_rate = 0.0;
};

struct AslipSample {
  double time = 0.0;
  AslipState state;
  bool stance = false;
  double leg_force = 0.0;       ///< u1, N: all of what acts along the leg
  double actuator_force = 0.0;  ///< u1 less the spring, N
  double hip_torque = 0.0;      ///< u2, N m
};

struct AslipRun {
  std::vector<AslipSample> samples;
  std::vector<double> touchdowns, liftoffs;  ///< s
  bool fell = false;                         ///< no touchdown, or no lift-off within a second
};

/// What is changed at one lift-off: the pitch about the hip.
struct AslipPush {
  int liftoff = -1;  ///< counted from 0; -1: never
  double pitch = 0.0, x_rate = 0.0;
};

/// From lift-off at `start`, `strides` times flight and stance. Runge-Kutta of order 4 at `step` seconds in
/// stance, the closed form in flight; lift-off is found to the last bit.
AslipRun run_aslip(const AslipModel& model, const SlipEmbedding& control, const AslipState& start,
                   int strides, const AslipPush& push = {}, double step = 2e-4);

/// What is read off the nominal orbit; nothing else is chosen.
struct AslipReadings {
  double pitch = 0.0;            ///< rad
  double speed = 0.0;            ///< at lift-off, m/s
  double flight = 0.0;           ///< s
  double half_travel = 0.0;      ///< of the centre of mass over the toe from touchdown to mid-stance, m
  double touchdown_force = 0.0;  ///< u1 just after touchdown, N
};

struct AslipOrbit {
  SlipEmbedding control;
  AslipState liftoff;
};

/// The periodic orbit with these readings: r0 and psi from geometry, k and Delta r so that stance is
/// symmetric and begins with the force that was read. Throws std::runtime_error where there is none.
AslipOrbit find_aslip_orbit(const AslipModel& model, const AslipReadings& readings, SlipEmbedding gains);

}  // namespace plumbline::validation
