#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "python/bindings.h"
#include "simulator/trace/error.h"
#include "validation/api/describing.h"
#include "validation/api/trial_arrays.h"
#include "validation/api/twins.h"
#include "validation/identify/trial/trial_file.h"
#include "validation/identify/trial/write_trial.h"

namespace plumbline::python {
namespace {

namespace py = pybind11;
using Arrays = std::vector<std::tuple<std::string, std::string, Eigen::VectorXd>>;

std::vector<api::Channel> channels_of(const Arrays& arrays) {
  std::vector<api::Channel> channels;
  channels.reserve(arrays.size());
  for (const auto& [name, unit, values] : arrays) {
    channels.push_back({name, unit, values});
  }
  return channels;
}

validation::Role role_of(const std::string& name) {
  for (const validation::Role role :
       {validation::Role::train, validation::Role::held_out, validation::Role::test}) {
    if (name == validation::to_string(role)) {
      return role;
    }
  }
  throw InputError({"", 0, "role"}, "\"" + name + "\"", "\"train\", \"held-out\" or \"test\"");
}

TrialHandle from_arrays(const ModelHandle& model, const std::string& name, const std::string& title,
                        const std::string& role, const Eigen::VectorXd& time, const Arrays& measured,
                        const Arrays& commands,
                        const std::vector<std::tuple<std::string, std::string, double>>& locked,
                        const std::vector<double>& events) {
  api::TrialArrays arrays;
  arrays.name = name;
  arrays.title = title;
  arrays.role = role_of(role);
  arrays.time = time;
  arrays.measured = channels_of(measured);
  arrays.commands = channels_of(commands);
  for (const auto& [at, unit, value] : locked) {
    arrays.locked.push_back({at, unit, value});
  }
  arrays.events = events;
  return {api::trial_from(arrays, model->model)};
}

/// By channel: values in SI.
template <typename Channel, typename Name>
py::dict arrays_of(const std::vector<Channel>& channels, Name name) {
  py::dict dict;
  for (const Channel& channel : channels) {
    dict[py::str(channel.*name)] = py::cast(channel.values);
  }
  return dict;
}

py::dict measured_of(const validation::Trial& trial) {
  py::dict dict = arrays_of(trial.measured, &validation::Measured::sensor);
  for (const validation::SwitchRecord& record : trial.switches) {
    dict[py::str(record.name)] = py::cast(record.values);
  }
  return dict;
}

TrialHandle twin(const ModelHandle& model, const std::string& experiment,
                 const std::vector<std::string>& hidden, std::uint64_t seed) {
  const py::gil_scoped_release others_may_run;
  validation::TwinOptions options;
  options.seed = seed;
  const model::Model robot = api::with_effects(model->model, hidden);
  return {api::twin(model->model, robot, experiment, options)};
}

}  // namespace

void bind_trials(py::module_& module) {
  py::class_<TrialHandle>(module, "Trial")
      .def_property_readonly("name", [](const TrialHandle& t) { return t.trial.name; })
      .def_property_readonly("title", [](const TrialHandle& t) { return t.trial.title; })
      .def_property_readonly("role", [](const TrialHandle& t) { return validation::to_string(t.trial.role); })
      .def_property_readonly("period", [](const TrialHandle& t) { return t.trial.period; })
      .def_property_readonly("time", [](const TrialHandle& t) { return t.trial.time; })
      .def_property_readonly("measured", [](const TrialHandle& t) { return measured_of(t.trial); })
      .def_property_readonly("commands", [](const TrialHandle& t) {
        return arrays_of(t.trial.commands, &validation::Command::motor);
      });
  module.def("model_of_trial", &validation::model_of_trial);
  module.def("read_trial",
             [](const std::string& path, const ModelHandle& model, const std::string& data) -> TrialHandle {
               return {validation::read_trial(path, model->model, {data})};
             });
  module.def("trial_from_arrays", from_arrays);
  module.def("write_trial",
             [](const TrialHandle& trial, const ModelHandle& model, const std::string& folder) {
               validation::write_trial(trial.trial, model->model, folder);
             });
  module.def("describe_trial", [](const TrialHandle& trial, const ModelHandle& model) {
    return to_python(
        api::to_json(trial.trial, model->model, api::freedom_of(model->model, trial.trial.locks)));
  });
  module.def("twin", twin);
}

}  // namespace plumbline::python
