// Where a law may sit in a model, for readers that report file and line themselves.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulator/model/model.h"

namespace plumbline::model {

/// Names of the places of this kind where the law may sit, in file order: at sensors the laws of encoders sit
/// at position sensors, those of inertial sensors at gyroscopes and accelerometers of three axes.
std::vector<std::string> places_of(const Model& model, const effects::Law& law, effects::Place place);

/// First of the law's kinds of place where the name is known.
std::optional<effects::Place> find_place(const Model& model, const effects::Law& law, const std::string& at);

/// "the name of a coordinate or motor; did you mean ...?"
std::string expected_place(const Model& model, const effects::Law& law, const std::string& at);

}  // namespace plumbline::model
