// The parts of the Python module; each file bind_NAME.cpp has one.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "validation/api/changed_model.h"

namespace plumbline::python {

/// What Python holds of a model; results make new ones and leave it as it is.
using ModelHandle = std::shared_ptr<api::ChangedModel>;

struct TrialHandle {
  validation::Trial trial;
};

void bind_models(pybind11::module_& module);
void bind_trials(pybind11::module_& module);
void bind_results(pybind11::module_& module);

/// As Python's own dicts and lists; "inf" and "-inf" become numbers.
pybind11::object to_python(const nlohmann::json& json);

}  // namespace plumbline::python
