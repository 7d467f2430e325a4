// Closed-form planar dynamics of MABEL's leg on the bench, by hand from Lagrange's equations (Eigen only).
// An oracle: it shares nothing with the simulator.
#pragma once

#include <Eigen/Core>

namespace plumbline::oracles {

/// A rigid link that turns about a pivot. Angle 0: it hangs straight down; counter-clockwise is positive
/// (x to the right, z up).
struct PendulumLink {
  double mass = 0.0;     ///< kg
  double along = 0.0;    ///< centre of mass along the link from the pivot, m (down at angle 0)
  double across = 0.0;   ///< centre of mass across the link, m (along +x at angle 0)
  double inertia = 0.0;  ///< about the pivot, kg m^2
};

/// A motor with all that turns with it. Its position is ratio * coordinate.
struct GearedMotor {
  double ratio = 1.0;    ///< motor position per leg angle (mLA) or per leg shape (mLS)
  double inertia = 0.0;  ///< rotor and pulleys at the motor, kg m^2
};

struct LegBenchConstants {
  double gravity = 9.80665;   ///< m/s^2, along -z
  double thigh_length = 0.0;  ///< hip to knee, m
  PendulumLink thigh;         ///< about the hip
  PendulumLink shin;          ///< about the knee
  PendulumLink cspring;       ///< turns by thigh - shin, twice the leg shape
  PendulumLink cshin;         ///< turns with the shin
  GearedMotor leg_angle;      ///< mLA = ratio (thigh + shin)/2
  GearedMotor leg_shape;      ///< mLS = ratio (thigh - shin)/2
};

/// The two coordinates are (thigh, shin), both relative to the torso, which does not move; rad.
/// shin = hip joint + knee joint of the skeleton, thigh = hip joint.
using Pair = Eigen::Vector2d;

/// Motor positions (mLA, mLS) = motor_map * (thigh, shin); also for rates and accelerations.
Eigen::Matrix2d motor_map(const LegBenchConstants& k);

/// M in M acceleration + bias = motor_map^T (motor torques); kg m^2.
Eigen::Matrix2d leg_bench_mass_matrix(const LegBenchConstants& k, const Pair& angles);

/// Centrifugal and gravity terms; N m.
Pair leg_bench_bias(const LegBenchConstants& k, const Pair& angles, const Pair& rates);

/// (thigh, shin) accelerations, rad/s^2. `motor_torques` (mLA, mLS) are all torques on the rotors except
/// viscous friction (so with bias), N m; `viscous` (mLA, mLS) is the friction at the motors, N m s/rad.
Pair leg_bench_accelerations(const LegBenchConstants& k, const Pair& angles, const Pair& rates,
                             const Pair& motor_torques, const Pair& viscous);

/// Acceleration of one coordinate with the other motor locked: `free_motor` is 0 (mLA moves, mLS is locked)
/// or 1. Returns the (thigh, shin) accelerations; `rates` must obey the lock.
Pair leg_bench_accelerations_locked(const LegBenchConstants& k, int free_motor, const Pair& angles,
                                    const Pair& rates, const Pair& motor_torques, const Pair& viscous);

/// Kinetic energy and gravity's potential (0 with all links at the height of their pivots and the hip), J.
double leg_bench_energy(const LegBenchConstants& k, const Pair& angles, const Pair& rates);

/// Left leg of Park et al., Identification of a Bipedal Robot with a Compliant Drivetrain: Table VI (links),
/// Tables IV and V (rotors and pulleys), equations 6 and 7 (ratios). Small links hang at zero (assumed).
LegBenchConstants mabel_left_leg();

}  // namespace plumbline::oracles
