// MABEL's walking controller: virtual constraints, feedforward and PD, leg exchange at touchdown.
#pragma once

#include <array>
#include <cstddef>

#include "controllers/blocks/virtual_constraints.h"

namespace plumbline::controllers {

/// What one leg's sensors say, rad; `contact`: its switch is closed.
struct WalkLegReading {
  double mLA = 0.0, mLS = 0.0, bsp = 0.0, thigh = 0.0, knee = 0.0;
  bool contact = false;
};
struct WalkReading {
  WalkLegReading left, right;
  double torso = 0.0;
};

/// Commands of mLA and mLS of the left leg, then of the right, N m.
using WalkTorques = std::array<double, 4>;

struct WalkConstants {
  WalkingGait gait;
  std::array<double, 4> kp{}, kd{};         ///< by WalkOutput, N m/rad and N m s/rad
  double angle_ratio = 0.0;                 ///< of mLA to the leg angle
  double limit_mLA = 0.0, limit_mLS = 0.0;  ///< N m
  double rate_samples = 1.0;                ///< over which a rate is the mean, 1 to 16
  double latest_sc = 0.0;                   ///< sc ends so long after theta_mc at the latest, rad
  double touchdown_from = 0.0;  ///< share of the way from theta_begin to theta_end before which no foot lands
  double first_stance = 0.0;    ///< 0: left, 1: right
  double angle_from = 0.0,
         angle_to = 0.0;  ///< of the leg angle, rad: beyond, a switch at a hard stop turns the power off
  double shape_from = 0.0, shape_to = 0.0;  ///< of the leg shape, rad
  // For one step after a step down (Park, Ramezani, Grizzle, ICRA 2012, equation 12).
  double absorb = 0.0;       ///< 1: switch; 0: never
  double absorb_from = 0.0;  ///< height of the step down, m
  double absorb_kp = 0.0, absorb_kd = 0.0,
         absorb_rest = 0.0;  ///< stance leg-shape motor: N m/rad, N m s/rad, rad
  Curve absorb_torso;        ///< over the whole step
};

enum class WalkFault { none = 0, leg_angle = 1, leg_shape = 2, backwards = 3 };
const char* to_string(WalkFault fault) noexcept;

/// theta = -(leg angle of the stance leg + torso), leg angle = thigh + knee/2, leg shape = -knee/2. The foot
/// of a leg is cos(shape) cos(angle + torso) below the hip (links of 0.5 m).
class Walking {
 public:
  /// Throws std::invalid_argument (one line) for a constant that cannot be.
  Walking(const WalkConstants& constants, double period);
  void reset() noexcept;
  WalkTorques step(const WalkReading& reading) noexcept;

  struct State {
    WalkPhase phase = WalkPhase::motor_compress;
    bool right_stance = false;
    bool absorbing = false;
    double theta = 0.0;
    std::array<double, 4> y{};  ///< by WalkOutput, rad
    double height = 0.0;        ///< by which the last step went down, m
    double steps = 0.0;         ///< touchdowns so far
    WalkFault fault = WalkFault::none;
  };
  const State& state() const noexcept { return state_; }
  void set_stance(bool right) noexcept { state_.right_stance = right; }

 private:
  static constexpr std::size_t kSignals = 7;  // LA, mLS, bsp of each leg, torso
  static constexpr std::size_t kLongest = 17;
  using Signals = std::array<double, kSignals>;

  void differentiate(const Signals& now) noexcept;
  void exchange(const WalkReading& reading) noexcept;
  void guard(const WalkReading& reading) noexcept;
  WalkTorques torques(const Signals& q) noexcept;

  WalkConstants constants_;
  double period_;
  std::size_t samples_;
  State state_;
  std::array<Signals, kLongest> past_{};
  std::size_t known_ = 0, head_ = 0;
  Signals rates_{};
};

}  // namespace plumbline::controllers
