// Typical magnitudes at a place, for an effect that is already named.
#pragma once

#include <memory>
#include <string>

#include "validation/identify/predict/problem.h"

namespace plumbline::validation {

/// From the motion of the train trials. Throws InputError when there is none.
effects::Scales scales_at(const model::Model& model, const std::shared_ptr<const effects::Law>& law,
                          const std::string& at, const Data& data);

/// From the model alone: the inertia that the place feels and the torque limit of its motor; what only a
/// motion can show stays at one unit.
effects::Scales scales_at(const model::Model& model, const effects::Law& law, const std::string& at);

}  // namespace plumbline::validation
