// Where a law may sit in a model, for readers that report file and line themselves.
#pragma once

#include <optional>
#include <string>

#include "simulator/model/model.h"

namespace plumbline::model {

/// First of the law's kinds of place where the name is known.
std::optional<effects::Place> find_place(const Model& model, const effects::Law& law, const std::string& at);

/// "the name of a coordinate or motor; did you mean ...?"
std::string expected_place(const Model& model, const effects::Law& law, const std::string& at);

}  // namespace plumbline::model
