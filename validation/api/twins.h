// Synthetic measurements of a model with hidden effects.
#pragma once

#include <string>
#include <vector>

#include "simulator/model/model.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::api {

/// The model with further effects ("cable_stretch@knee:stiffness=3,damping=0.1"). Throws InputError with the
/// nearest names.
model::Model with_effects(const model::Model& model, const std::vector<std::string>& texts);

/// What the sensors of `robot` record in the experiment of `file`, which is read for `model`: the model
/// without the hidden effects.
validation::Trial twin(const model::Model& model, const model::Model& robot, const std::string& file,
                       const validation::TwinOptions& options);

}  // namespace plumbline::api
