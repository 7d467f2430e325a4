// A whole recording or experiment simulated from its start to its end, in one piece.
#pragma once

#include <string>
#include <vector>

#include "simulator/run/commanded_run.h"
#include "simulator/trace/table.h"
#include "validation/identify/predict/problem.h"
#include "validation/identify/trial/trial.h"
#include "validation/identify/twin/experiment.h"

namespace plumbline::validation {

struct ReplayOptions {
  integrate::Options integrator;
  bool closed_loop = false;  ///< the trial's controllers command their motors, in place of the recording
  const StopFlag* stop = nullptr;  ///< raised: Stopped is thrown at the next sample
};

/// Simulated against measured over the whole recording: without windows, so an unstable motion drifts away.
struct ReplayError {
  std::string sensor, unit;
  double rms = 0.0;    ///< SI
  double floor = 0.0;  ///< SI
};

struct Replay {
  run::CommandedRun run;
  /// t; q_SENSOR: what the sensors would read without quantisation and noise; u_MOTOR: commands; x_NAME and
  /// v_NAME: position and velocity of each coordinate and motor; F_FOOT_x, _y, _z: force of the ground. SI.
  Table trace;
  std::vector<ReplayError> errors;  ///< empty for experiments
  double duration = 0.0;            ///< simulated, s
  double seconds = 0.0;             ///< wall clock
};

/// Runs the trial's recorded commands from the state that its first samples show (predict/flight_start.h). In
/// closed loop the trial's controllers run instead, sample and hold, on readings quantised as the sensors
/// quantise them; motors without a controller keep their recorded commands. Throws InputError when a closed
/// loop is asked for and the trial names no controller or the model no such sensor, std::runtime_error when
/// the integrator fails.
Replay replay(const model::Model& model, const Trial& trial, const ReplayOptions& options);

/// Runs the experiment's commands from its start, at rest.
Replay replay(const model::Model& model, const Experiment& experiment, const ReplayOptions& options);

}  // namespace plumbline::validation
