// The running controller on the robot's sensors, one sample after the other.
#pragma once

#include "controllers/monopod/parameters.h"

namespace plumbline::monopod {

/// Positions that the encoders show (rad, m), and the toe's switch.
struct Sample {
  double thigh = 0.0, knee = 0.0, motor = 0.0, torso = 0.0, hip_x = 0.0, hip_z = 0.0;
  bool contact = false;
};

/// Rates come from the counts: a filter that foretells each sample by the robot's own equations of motion and
/// is corrected by what was measured (an alpha-beta filter with the model's acceleration). At touchdown and
/// lift-off it goes through the model's impact, as the robot does, so that no difference quotient spans the
/// blow.
class SampledRunning {
 public:
  SampledRunning(const Parameters& parameters, double period);
  void reset();
  /// Commands of leg-angle and leg-shape motor, N m. Sets fault().
  Vector2 step(const Sample& sample);

  enum Fault : int { kNone = 0, kTorsoFell = 1, kLegFolded = 2 };
  int fault() const { return fault_; }
  const Running& running() const { return running_; }
  Running& running() { return running_; }
  const State& estimate() const { return state_; }

 private:
  void filter(const Sample& sample);
  void follow_events(const Sample& sample);

  Parameters p_;
  double period_;
  Running running_;
  State state_;
  Vector6 acceleration_ = Vector6::Zero();
  int samples_ = 0;
  int open_ = 0;       // samples since the switch has opened
  int flown_for_ = 0;  // samples since the last lift-off
  bool flown_ = false;
  int fault_ = kNone;
};

}  // namespace plumbline::monopod
