#include <pybind11/stl.h>

#include "python/bindings.h"
#include "simulator/model/known_effects.h"
#include "validation/api/adding.h"
#include "validation/api/describing.h"
#include "validation/api/effects_json.h"
#include "validation/identify/fit/free_parameters.h"

namespace plumbline::python {
namespace {

namespace py = pybind11;

ModelHandle add_effect(const ModelHandle& model, const std::string& effect, const std::string& at,
                       const std::vector<std::string>& set, const TrialHandle* trial) {
  std::optional<validation::Trial> motion;
  if (trial != nullptr) {
    motion = trial->trial;
  }
  return std::make_shared<api::ChangedModel>(
      api::with_effect(*model, api::added_effect({effect, at, set}, model->model, motion)));
}

std::vector<std::string> parameter_labels(const ModelHandle& model) {
  std::vector<std::string> labels;
  for (const validation::FreeParameter& parameter : validation::free_parameters(model->model)) {
    labels.push_back(parameter.label);
  }
  return labels;
}

py::object description(const ModelHandle& model) {
  return to_python(api::to_json(model->model, api::freedom_of(model->model, {})));
}

}  // namespace

void bind_models(py::module_& module) {
  py::class_<api::ChangedModel, ModelHandle>(module, "Model")
      .def_property_readonly("file", [](const ModelHandle& model) { return model->model.file; });
  module.def("read_model", [](const std::string& file) -> ModelHandle {
    return std::make_shared<api::ChangedModel>(api::read_model(file));
  });
  module.def("describe_model", description);
  module.def("parameter_labels", parameter_labels);
  module.def("add_effect", add_effect, py::arg("model"), py::arg("effect"), py::arg("at"), py::arg("set"),
             py::arg("trial").none(true));
  module.def("save_model", [](const ModelHandle& model, const std::string& file, const std::string& note) {
    api::save(*model, file, note);
  });
  module.def("effects",
             [](const std::string& name) { return to_python(api::effects_json(api::named_effects(name))); });
}

}  // namespace plumbline::python
