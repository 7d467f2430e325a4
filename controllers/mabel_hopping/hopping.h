// Hopping on two legs: the controller of the MABEL paper's sidebar 2. Pure: encoder counts in, torques out.
#pragma once

#include <array>
#include <cstdint>

#include "controllers/blocks/rate_filter.h"
#include "controllers/mabel_hopping/hopping_config.h"
#include "controllers/mabel_hopping/hopping_phases.h"

namespace plumbline::controllers {

/// One leg's encoders, counts (HoppingResolutions says of what).
struct LegCounts {
  std::int64_t mLA = 0;
  std::int64_t mLS = 0;
  std::int64_t thigh = 0;
  std::int64_t knee = 0;
};

/// Everything that is measured at one sample.
struct HoppingSample {
  LegCounts left;
  LegCounts right;
  std::int64_t torso = 0;
  std::int64_t tower = 0;
  std::int64_t boom_pitch = 0;
  bool left_contact = false;   ///< either switch of the left foot
  bool right_contact = false;  ///< either switch of the right foot
};

/// One value for each controlled variable, in the order of S3.
struct HoppingVector {
  double LA_left = 0.0;
  double mLS_left = 0.0;
  double LA_right = 0.0;
  double mLS_right = 0.0;
};

/// The switch of a hard stop that turned the power off.
enum class StopSwitch { none, leg_angle_left, leg_shape_left, leg_angle_right, leg_shape_right };
/// "leg angle, left" and so on; "none".
const char* to_string(StopSwitch stop) noexcept;

/// Motor torques, N m, held until the next sample.
struct HoppingTorques {
  double mLA_left = 0.0;
  double mLS_left = 0.0;
  double mLA_right = 0.0;
  double mLS_right = 0.0;
};

/// The PD controller
///   u = K_p (h_X^ref - h) - K_d dh/dt   (S4),  h = [q_LA_L, q_mLS_L, q_LA_R, q_mLS_R]   (S3)
/// with h from the encoder counts, its derivative from RateFilters, and a reference for each phase X. With g
/// for gamma_LS_to_mLS, a leg angle of 0 straight down, and left and right in place of L and R:
///   q_LA_left:   I  -delta_LA/2 - h_T^d  (S5);  II, III  q_T + q_LA_R - h_T^d - delta_LA  (S7, S9)
///   q_LA_right:  I  +delta_LA/2 - h_T^d  (S5);  II, III  q_T + q_LA_R - h_T^d             (S7, S9)
///                IVa, IVb, V: what the equations of III give at the sample that ends III (S13, S15, S17)
///   q_mLS:       g h_LS in I and II; g (h_LS - delta_LS_minus) in III, and in IVa and IVb for the foot that
///                is still down; g (h_LS + delta_LS_plus) in V, and in IVa and IVb for the foot that is up
/// The leg angles' part of u is a joint torque; it reaches the motor divided by gamma_LA_to_mLA. Each motor's
/// torque is held within its limit.
///
/// At each landing k = 0, 1, ... the tower's angle phi[k] is taken, and for k >= 1
///   h_T^d = h_T0 + K_T (phi[k] - phi[k-1] - delta_phi_d),
/// the addition held within delta_h_T_limit. Travel is backward and delta_phi_d < 0: after too short a hop
/// the bracket is positive, and with K_T > 0 the torso leans further backward, as the paper wants it.
///
/// When a leg leaves the workspace the power goes off: from that sample on all torques are 0, until reset().
///
/// HoppingPhases says when phases change. After construction nothing allocates, blocks or throws.
class Hopping {
 public:
  /// Throws std::invalid_argument as validate(HoppingConfig) and RateFilter do.
  explicit Hopping(const HoppingConfig& config);

  /// One sample: call it once every period with the newest counts. The first sample's velocities are 0.
  HoppingTorques command(const HoppingSample& sample) noexcept;
  /// As just constructed.
  void reset() noexcept;
  /// What outlasts a hop: h_T^d, the tower's counts at the last landing, and whether there has been one.
  void remember(double h_T_d, std::int64_t tower, bool landed) noexcept;
  /// As just constructed, but as if in flight behind a landing at `tower` counts that left h_T^d at `h_T_d`.
  void resume(double h_T_d, std::int64_t tower) noexcept;

  /// For logs, all as of the last command.
  HoppingPhase phase() const noexcept { return phases_.phase(); }
  double time_in_phase() const noexcept;            ///< s since the transition into it
  long hops() const noexcept;                       ///< k, landings without the first; 0 before that too
  double h_T_d() const noexcept { return h_T_d_; }  ///< h_T^d, rad
  /// Why the power is off; none while it is on.
  StopSwitch power_off() const noexcept { return power_off_; }
  std::int64_t tower_at_landing() const noexcept { return tower_at_landing_; }  ///< counts, of the last one
  bool landed() const noexcept { return landed_; }                              ///< at least once
  double hip_velocity() const noexcept { return hip_velocity_; }                ///< upward, m/s
  const HoppingVector& controlled() const noexcept { return h_; }               ///< h, rad
  const HoppingVector& rates() const noexcept { return rates_; }                ///< dh/dt, rad/s
  const HoppingVector& reference() const noexcept { return reference_; }        ///< h_X^ref, rad

 private:
  double leg_angle(const LegCounts& counts, LegAngleSource source) const noexcept;
  void measure(const HoppingSample& sample) noexcept;
  StopSwitch stop_switch(const HoppingSample& sample) const noexcept;
  void land(std::int64_t tower_counts) noexcept;
  void refer_leg_angles(HoppingPhase before, double q_T) noexcept;
  void refer_leg_shapes() noexcept;
  HoppingTorques torques() const noexcept;

  HoppingConfig config_;
  HoppingPhases phases_;
  std::array<RateFilter, 4> filters_;  // order of S3
  RateFilter hip_filter_;
  HoppingVector h_, rates_, reference_;
  double hip_velocity_ = 0.0;
  double h_T_d_;
  std::int64_t tower_at_landing_ = 0;
  bool landed_ = false;  // tower_at_landing_ is one
  StopSwitch power_off_ = StopSwitch::none;
};

}  // namespace plumbline::controllers
