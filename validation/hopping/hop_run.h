// The hopping robot simulated until it falls or has hopped enough.
#pragma once

#include <string>
#include <vector>

#include "contact/terrain.h"
#include "controllers/mabel_hopping/hopping_config.h"
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
  contact::Terrain terrain;        ///< level ground at 0 m unless set
  bool trace = false;              ///< keep every sample
  bool energy = false;             ///< whether the energy adds up, too; the steps are then a little different
  const StopFlag* stop = nullptr;  ///< raised: Stopped is thrown
  HopOptions();
};

struct HopRun {
  std::vector<Hop> hops;
  double time = 0.0;  ///< simulated, s
  bool fell = false;
  std::string end;             ///< how and when it fell, for people; empty when it did not
  double time_at_limit = 0.0;  ///< summed over the motors, that a command was at its limit, s
  integrate::Summary summary;
  double energy_error = 0.0, energy_exchanged = 0.0;  ///< as of integrate::RunResult, J; 0 unless asked for
  double seconds = 0.0;                               ///< wall time
  Table trace;
};

/// Simulates `model` under the hopping controller, one sample of the controller at a time, until it has
/// hopped enough or the HopWatchdog ends it. When the integrator gives up, the run ends there and `end` says
/// why. Throws InputError for a model that cannot hop, and when the terrain reaches a foot at the start.
HopRun hop(const model::Model& model, const controllers::HoppingConfig& config, const HopStart& start,
           const HopOptions& options);

}  // namespace plumbline::validation
