// What the records say of inertial sensors: which were recorded, how much they read, what of a law shows.
#pragma once

#include <string>
#include <vector>

#include "validation/identify/diagnose/candidates.h"

namespace plumbline::validation {

/// Has any trial one of the components of the gyroscope or accelerometer of this name?
bool is_recorded_inertial(const model::Model& model, const std::vector<Trial>& trials,
                          const std::string& sensor);

/// Largest magnitude of its readings in the train trials, rad/s or m/s^2; at least its floor.
double largest_reading(const model::Model& model, const std::vector<Trial>& trials,
                       const std::string& sensor);

/// Parameters of an InertialSensorLaw that, moved by their typical size from their null value, change no
/// recorded component by more than two floors, root mean square: the scale of an axis along which nothing is
/// felt, the bias of a component that was not recorded.
std::vector<int> unseen_parameters(const model::Model& model, const std::vector<Trial>& trials,
                                   const Candidate& candidate);

}  // namespace plumbline::validation
