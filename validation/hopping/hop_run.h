// The hopping robot simulated until it falls or has hopped enough.
#pragma once

#include <string>
#include <vector>

#include "controllers/hopping_config.h"
#include "simulator/integrate/integrator.h"
#include "simulator/model/model.h"
#include "simulator/trace/table.h"
#include "validation/hopping/hop.h"
#include "validation/hopping/hop_start.h"
#include "validation/predict/problem.h"

namespace plumbline::validation {

struct HopOptions {
  long hops = 100;         ///< enough
  double longest = 120.0;  ///< s, whatever happens
  integrate::Options integrator;
  bool trace = false;              ///< keep every sample
  const StopFlag* stop = nullptr;  ///< raised: Stopped is thrown
  HopOptions();
};

struct HopRun {
  std::vector<Hop> hops;
  double time = 0.0;  ///< simulated, s
  bool fell = false;
  std::string end;  ///< how it ended, for people
  integrate::Summary summary;
  double seconds = 0.0;  ///< wall time
  Table trace;
};

/// Simulates `model` under the hopping controller, one sample of the controller at a time. The robot has
/// fallen when its hip is below half its height, its torso has turned by more than 1 rad, or it stays in one
/// phase for longer than 1.5 s (a gait that never leaves the ground). When the integrator gives up, the run
/// ends there and `end` says why. Throws InputError for a model that cannot hop.
HopRun hop(const model::Model& model, const controllers::HoppingConfig& config, const HopStart& start,
           const HopOptions& options);

}  // namespace plumbline::validation
