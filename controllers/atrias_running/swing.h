// The way of a foot through the air. Wu (2017), section 5.5.
#pragma once

#include <algorithm>

#include "controllers/atrias_running/leg.h"

namespace plumbline::controllers::atrias {

/// One coordinate from (position, rate) to another in a time, with no acceleration at either end; a
/// polynomial of fifth degree. Behind its end it goes on at the end's rate.
class Way {
 public:
  void plan(double from, double from_rate, double to, double to_rate, double time) {
    from_ = from;
    from_rate_ = from_rate;
    to_rate_ = to_rate;
    time_ = time;
    gap_ = to - from - 0.5 * (from_rate + to_rate) * time;
    to_ = to;
  }
  double at(double t) const {
    if (t >= time_) {
      return to_ + to_rate_ * (t - time_);
    }
    const double s = std::max(0.0, t / time_);
    // The rate goes from one to the other by s^3 (10 - 15 s + 6 s^2), whose integral is s^4 (5/2 - 3 s +
    // s^2).
    const double blend = s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
    const double passed = s * s * s * s * (2.5 + s * (-3.0 + s));
    return from_ + time_ * (from_rate_ * s + (to_rate_ - from_rate_) * passed) + gap_ * blend;
  }

 private:
  double from_ = 0.0, from_rate_ = 0.0, to_ = 0.0, to_rate_ = 0.0, time_ = 1.0, gap_ = 0.0;
};

/// A foot relative to the centre of mass, forward and up, until it lands.
class FootPath {
 public:
  /// It arrives at `to` after `landing` s; `ready` (a share of it) earlier it moves with the ground, at
  /// `ground_rate` m/s along.
  void plan(const Pair& from, const Pair& rate, const Pair& to, double ground_rate, double landing,
            double ready) {
    const double until = landing * ready;
    along_.plan(from.first, rate.first, to.first - ground_rate * (landing - until), ground_rate, until);
    up_.plan(from.second, rate.second, to.second, 0.0, until);
    landing_ = landing;
  }
  /// A foot that has not met the ground in time waits where it should have landed.
  Pair at(double t) const { return {along_.at(std::min(t, landing_)), up_.at(t)}; }

 private:
  Way along_, up_;
  double landing_ = 1.0;
};

}  // namespace plumbline::controllers::atrias
