// The motion that ATRIAS is led along: hops on a vertical spring, and foot placements that bring the wanted
// speed in one step. Wu, "The Theory, Implementation, and Evaluation of Spring Mass Running on ATRIAS"
// (2017), sections 5.3, 5.4.1 and 5.7.
#pragma once

#include <array>
#include <cstddef>

#include "controllers/blocks/riccati.h"

namespace plumbline::controllers::atrias {

/// The gait's numbers, by their source in the thesis.
struct GaitNumbers {
  double mass = 64.0;          ///< kg, section 5.3.1
  double gravity = 9.81;       ///< m/s^2
  double stiffness = 16000.0;  ///< N/m, section 5.3.1
  double landing = 1.09;       ///< m, height of the centre of mass at touchdown
  double hop = 0.03;           ///< m, apex above it
  double inertia = 3.87;       ///< kg m^2, pitch, of what turns with the trunk
  double reach = 0.36;         ///< m, farthest placement before or behind the centre of mass (section 4.4.3)
};

/// z*(t) and F_z*(t) of equation 5.2 in closed form, from touchdown (t = 0) to lift-off.
class VerticalHop {
 public:
  explicit VerticalHop(const GaitNumbers& gait);
  double stance_time() const { return stance_time_; }
  double landing_speed() const { return landing_speed_; }
  double height(double time) const;
  double rate(double time) const;
  double force(double time) const;

 private:
  double mass_, gravity_, stiffness_, landing_, landing_speed_, omega_, sag_, stance_time_;
};

/// One moment of the planned stance: foot at the origin.
struct Reference {
  double x = 0.0, x_rate = 0.0, z = 0.0, z_rate = 0.0;  ///< m, m/s
  double force_x = 0.0, force_z = 0.0;                  ///< N
};

/// x'' = F_z*(t)/m x/z*(t) (equation 5.1) is linear in x: with the transition matrix of one stance the return
/// map and its inverse are closed, and the deadbeat placement needs no table.
class Planner {
 public:
  static constexpr int samples = 256;  ///< of the transition matrix over a stance
  explicit Planner(const GaitNumbers& gait);
  const VerticalHop& hop() const { return hop_; }

  /// Where the mass must be relative to the foot at touchdown (m, negative: behind it) so that a speed `now`
  /// becomes `wanted` (m/s), as far as the leg reaches.
  double placement(double now, double wanted) const;
  /// The speed at lift-off after touchdown at `x` with `speed`.
  double next_speed(double x, double speed) const;
  double speed_by_placement() const { return end_(1, 0); }  ///< 1/s
  double speed_by_speed() const { return end_(1, 1); }
  /// Moment `time` of the stance that begins at `x` with `speed`.
  Reference at(double time, double x, double speed) const;

 private:
  GaitNumbers gait_;
  VerticalHop hop_;
  std::array<Matrix<2, 2>, static_cast<std::size_t>(samples) + 1> transition_;
  Matrix<2, 2> end_;
};

/// Stance feedback: constant vertical gains, time-varying horizontal ones by finite- or infinite-horizon LQR
/// (section 5.4.1, 6.3).
class StanceRegulator {
 public:
  static constexpr int samples = 256;
  struct Design {
    double q_z = 100.0, q_z_rate = 1.0, r_z = 2.5e-6;  ///< the group's repository, 25326a2
    std::array<double, 4> q{1.0, 1.0, 25.0, 1.0};      ///< x, its rate, pitch, its rate; the same, d619fec
    std::array<double, 4> h{0.0, 0.0, 5.0, 0.03};
    double r_x = 0.4e-4;
    bool infinite = false;  ///< jump Riccati with deadbeat placement between the stances
  };
  StanceRegulator(const GaitNumbers& gait, const Design& design);
  double gain_z() const { return gain_z_; }
  double gain_z_rate() const { return gain_z_rate_; }
  /// The horizontal gains at this time of the stance.
  Matrix<1, 4> gains(double time) const;

 private:
  double stance_time_, gain_z_, gain_z_rate_;
  std::array<Matrix<1, 4>, static_cast<std::size_t>(samples) + 1> gains_;
};

/// Line through the speed errors of past steps, e = e1 wanted + e0 by recursive least squares
/// (equation 5.10), and the placement that cancels what it foretells.
class SpeedAdaptation {
 public:
  explicit SpeedAdaptation(int steps_before_use) : wait_(steps_before_use) {}
  void learn(double wanted, double achieved);
  double foretold(double wanted) const;  ///< m/s; 0 until enough steps are seen
  int steps() const { return count_; }

 private:
  int wait_, count_ = 0;
  double sum_ww_ = 0.0, sum_w_ = 0.0, sum_we_ = 0.0, sum_e_ = 0.0;
};

}  // namespace plumbline::controllers::atrias
