// Hopping from many starts: shares instead of single runs.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "validation/hopping/hop_run.h"

namespace plumbline::validation {

/// Starts drawn evenly: drop 3 to 7 cm, forward speed -0.6 to -0.1 m/s, torso within 0.02 rad of h_T0.
std::vector<HopStart> draw_starts(int count, std::uint64_t seed);

/// One run from each start, on all cores. `progress` is told how many are done.
std::vector<HopRun> hop_from(const model::Model& model, const controllers::HoppingConfig& config,
                             const std::vector<HopStart>& starts, const HopOptions& options,
                             const std::function<void(int)>& progress = {});

/// The same for many controllers: runs[controller][start].
std::vector<std::vector<HopRun>> hop_all(const model::Model& model,
                                         const std::vector<controllers::HoppingConfig>& configs,
                                         const std::vector<HopStart>& starts, const HopOptions& options,
                                         const std::function<void(int)>& progress = {});

struct HopStatistics {
  int starts = 0;
  int sustained = 0;         ///< runs with at least `enough` hops
  double median_hops = 0.0;  ///< of all runs
  // Means over the settled hops (settled_hops) of all runs; 0 without one.
  double period = 0.0, travel = 0.0, torso = 0.0, touchdown_gap = 0.0;
  double stretch_LA = 0.0, stretch_LS = 0.0;  ///< largest of each hop, rad of motor
  double torque_mLA = 0.0, torque_mLS = 0.0;  ///< largest of each hop, N m
  double time_at_limit = 0.0;                 ///< of a hop, all motors, s
};
HopStatistics statistics_of(const std::vector<HopRun>& runs, long enough);

}  // namespace plumbline::validation
