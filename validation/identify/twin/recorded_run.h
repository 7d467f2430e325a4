// A run as the robot's own sensors recorded it.
#pragma once

#include "simulator/run/scenario.h"
#include "simulator/trace/table.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::validation {

/// The trial of a run's record (run::Recorder): commands as they were given, readings of all sensors and
/// contact switches as the controller saw them, and the terrain it ran on. Throws InputError when the record
/// is shorter than two samples.
Trial recorded_run(const model::Model& model, const Table& record, const run::Scenario& scenario);

}  // namespace plumbline::validation
