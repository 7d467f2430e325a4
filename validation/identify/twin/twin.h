// Synthetic measurements: an experiment run on a model, seen through its sensors.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "simulator/model/plant.h"
#include "validation/identify/twin/experiment.h"

namespace plumbline::validation {

/// "EFFECT@WHERE:param=value,param=value" as on the command line, values in SI units of the place.
/// Parameters not named take the law's first start (shape) or null value. Throws InputError with the nearest
/// names when effect, place or parameter is unknown, and when a value is outside its bounds.
model::EffectUse parse_effect(const std::string& text, const model::Model& model,
                              const effects::Catalogue& catalogue);

/// What a sensor shows for its true position: with its noise, in its counts.
double sensor_reading(const model::Sensor& sensor, double actual, std::mt19937_64& random);

struct TwinOptions {
  std::uint64_t seed = 1;            ///< of the sensors' noise
  double relative_tolerance = 1e-9;  ///< tighter than what diagnosis uses
  bool quantise = true;
};

/// Runs the experiment on the model and returns the trial its sensors would have recorded, with every sensor
/// of the model as a channel. Starts at rest at the experiment's positions.
/// Throws std::runtime_error when the model cannot be integrated.
Trial twin(const model::Model& model, const Experiment& experiment, const TwinOptions& options);

/// State at rest with the experiment's coordinates at their start positions, hidden states settled.
Eigen::VectorXd start_state(model::Plant& plant, const Experiment& experiment);

/// Locked coordinates at the values that the start positions give them.
std::vector<model::Lock> locks_of(const model::Model& model, const Experiment& experiment);

}  // namespace plumbline::validation
