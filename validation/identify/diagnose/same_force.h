// Effects that are one force under two names.
#pragma once

#include <vector>

#include "validation/identify/diagnose/diagnose.h"

namespace plumbline::validation {

/// Sets Rival::same where either of the two laws changes the rates of the model's states, at whatever state
/// and command, by the same multiple of what the other changes them by: a torque bias at a motor and a
/// preload at the coordinate that it turns rigidly. Looked at for laws with one value; of laws with more only
/// those at places that are tied rigidly are known to be one (they are marked already).
void mark_same_forces(const model::Model& model, const effects::Catalogue& catalogue,
                      std::vector<Finding>& findings);

}  // namespace plumbline::validation
