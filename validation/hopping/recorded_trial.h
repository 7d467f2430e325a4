// A hopping run as the robot's own sensors would have recorded it.
#pragma once

#include <cstdint>

#include "simulator/model/model.h"
#include "simulator/trace/table.h"
#include "validation/trial/trial.h"

namespace plumbline::validation {

/// The trial of a run's trace (HopRecorder): commands as they were given, every sensor with its noise and in
/// its counts, contact switches from the ground's force. `seed`: of the noise.
/// Throws InputError when the trace is shorter than two samples.
Trial recorded_trial(const model::Model& model, const Table& trace, std::uint64_t seed);

}  // namespace plumbline::validation
