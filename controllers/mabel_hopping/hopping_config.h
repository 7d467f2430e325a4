// What the hopping controller needs to know: the paper's parameters, the gains, the encoders, and ours.
//
// "The paper" is H.-W. Park, K. Sreenath, J. W. Hurst, J. W. Grizzle, "Identification of a Bipedal Robot with
// a Compliant Drivetrain"; S3 to S17 are the equations of its sidebar 2, How Hopping is Achieved.
// Angles are counter-clockwise seen from the robot's right side, forward to the right: a positive leg angle
// carries the foot forward, a positive torso angle leans backward. A leg angle of 0 is the leg straight down;
// the paper has pi there. Nothing here has a default that a robot could run with: values live in robots/.
#pragma once

#include <limits>

#include "controllers/blocks/rate_filter.h"

namespace plumbline::controllers {

/// Sidebar 2's parameters, under its symbols.
struct HoppingParameters {
  double delta_LA = 0.0;              ///< angle between the legs, right before left, rad
  double h_T0 = 0.0;                  ///< h_T^d0, nominal torso angle, rad
  double h_LS_left = 0.0;             ///< h_LS_L^d, leg shape in flight and touchdown, rad
  double h_LS_right = 0.0;            ///< h_LS_R^d, rad
  double delta_LS_minus_left = 0.0;   ///< delta_LS_L^-, extension at kickoff, rad of leg shape
  double delta_LS_minus_right = 0.0;  ///< delta_LS_R^-, rad
  double delta_LS_plus_left = 0.0;    ///< delta_LS_L^+, retraction after lift-off, rad of leg shape
  double delta_LS_plus_right = 0.0;   ///< delta_LS_R^+, rad
  double gamma_LA_to_mLA = 0.0;       ///< q_mLA / q_LA of the rigid drivetrain (equation 6), not 0
  double gamma_LS_to_mLS = 0.0;       ///< gamma_LS->mLS = q_mLS / q_LS, spring at rest (equation 7), not 0
  double hip_velocity_band = 0.0;     ///< of the condition S8, m/s, >= 0
  double retract_time = 0.0;          ///< length of phase V (S17), s; at least half a period

  bool event_update = false;     ///< whether h_T^d is updated at each touchdown; otherwise it stays h_T0
  double K_T = 0.0;              ///< gain of the update, rad of torso per rad of tower
  double delta_phi_d = 0.0;      ///< delta_phi_h^d, wanted turn of the tower in one hop, rad; forward > 0
  double delta_h_T_limit = 0.0;  ///< largest magnitude of delta_h_T (ours), rad; > 0 with event_update
};

/// Diagonal entries of K_p and K_d (S4) for one leg, all >= 0, the same in all phases.
/// Leg angle: in joint space; the motor's torque is the joint's divided by gamma_LA_to_mLA (virtual work).
/// Leg shape: in the motor's space.
struct HoppingLegGains {
  double kp_LA = 0.0;   ///< N m (at the joint) per rad of q_LA
  double kd_LA = 0.0;   ///< N m s (at the joint) per rad of q_LA
  double kp_mLS = 0.0;  ///< N m (at the motor) per rad of q_mLS
  double kd_mLS = 0.0;  ///< N m s (at the motor) per rad of q_mLS
};

/// Radians per count of each encoder, not 0; negative where the counts fall as the angle grows. Counts are 0
/// where the angle is 0 (the tower's: anywhere) and do not wrap.
struct HoppingResolutions {
  double mLA = 0.0;         ///< leg-angle motor
  double mLS = 0.0;         ///< leg-shape motor
  double thigh = 0.0;       ///< thigh relative to torso
  double knee = 0.0;        ///< shin relative to thigh; falls as the leg bends
  double torso = 0.0;       ///< torso relative to the vertical; grows backward
  double tower = 0.0;       ///< turn of the tower; grows as the robot travels forward
  double boom_pitch = 0.0;  ///< boom against the horizontal; grows as the hip rises
};

/// Where q_LA is read. With a rigid drivetrain both agree; with stretching cables they do not.
enum class LegAngleSource {
  joints,  ///< thigh + knee/2, as S3 has it
  motor,   ///< q_mLA / gamma_LA_to_mLA: finer counts, and on the motor's side of the cable
};

/// What the paper leaves open about the phases. Ours. Times in s, rounded to whole samples.
struct HoppingSupplements {
  int contact_samples = 1;  ///< a switch counts as changed after so many equal samples, >= 1 (1: at once)
  double touchdown_time_min = 0.0;  ///< shortest II before a kickoff: the foot's impact shakes the boom, >= 0
  double bounce_time = 0.0;         ///< II falls back to I when not both feet have been down for longer, >= 0
  double kickoff_time_max = 0.0;    ///< III falls back to II when no foot lifts off for so long; 0: never
  double liftoff_time_max = 0.0;    ///< IVa, IVb fall back to I when the second foot stays down; 0: never
};

/// Where the switches of the hard stops close (the paper's section Sensors: the computer then turns the
/// robot's power off at once). Read at the joints' encoders; infinite: no switch.
struct HoppingWorkspace {
  double leg_angle_from = -std::numeric_limits<double>::infinity();  ///< rad
  double leg_angle_to = std::numeric_limits<double>::infinity();     ///< rad
  double leg_shape_from = -std::numeric_limits<double>::infinity();  ///< rad
  double leg_shape_to = std::numeric_limits<double>::infinity();     ///< rad
};

/// Everything that a Hopping is made of.
struct HoppingConfig {
  double period = 0.0;       ///< T between samples, s, > 0
  double boom_length = 0.0;  ///< hip to the boom's pivot, m, > 0; hip height = boom_length sin(boom pitch)
  HoppingParameters parameters;
  HoppingLegGains left;
  HoppingLegGains right;
  double torque_limit_mLA = 0.0;  ///< largest magnitude of a leg-angle motor's torque, N m, > 0
  double torque_limit_mLS = 0.0;  ///< largest magnitude of a leg-shape motor's torque, N m, > 0
  HoppingResolutions resolution;
  LegAngleSource leg_angle = LegAngleSource::joints;       ///< of q_LA in S4, S7 and S9
  LegAngleSource leg_angle_rate = LegAngleSource::joints;  ///< of q_LA's derivative in S4
  RateFilterOptions leg_angle_filter;                      ///< gives q_LA's derivative
  RateFilterOptions leg_shape_filter;                      ///< gives q_mLS's derivative
  RateFilterOptions hip_filter;                            ///< gives the hip's vertical velocity of S8
  HoppingSupplements supplements;
  HoppingWorkspace workspace;
};

/// Throws std::invalid_argument naming the value that is not finite or outside the range given with it. The
/// filters' options are checked where the filters are made.
void validate(const HoppingConfig& config);

}  // namespace plumbline::controllers
