#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "python/bindings.h"
#include "python/work.h"
#include "simulator/model/kinds.h"
#include "simulator/trace/error.h"
#include "validation/identify/replay/replay.h"
#include "validation/report/result_json.h"

namespace plumbline::python {
namespace {

namespace py = pybind11;

struct Asked {
  ModelHandle model;
  std::vector<TrialHandle> trials;
  double window = 0.5;
};

api::Loaded load(const Asked& asked, const validation::StopFlag& stop) {
  std::vector<validation::Trial> trials;
  trials.reserve(asked.trials.size());
  for (const TrialHandle& one : asked.trials) {
    trials.push_back(one.trial);
  }
  if (trials.empty()) {
    throw InputError({"", 0, "trials"}, "none", "at least one trial");
  }
  if (!(asked.window > 0.0)) {
    throw InputError({"", 0, "window"}, std::to_string(asked.window), "seconds above zero");
  }
  return api::load(asked.model->model, std::move(trials), asked.window, &stop);
}

/// By trial: time, and for each sensor what was measured and predicted.
py::list curves_of(const api::Loaded& loaded, const std::vector<Eigen::MatrixXd>& predicted) {
  py::list curves;
  std::vector<const validation::Trial*> trials;
  for (const auto* list : {&loaded.data->trials, &loaded.data->tests}) {
    for (const validation::Trial& trial : *list) {
      trials.push_back(&trial);
    }
  }
  for (std::size_t t = 0; t < trials.size(); ++t) {
    const validation::Trial& trial = *trials[t];
    py::dict channels;
    for (std::size_t c = 0; c < trial.measured.size(); ++c) {
      const std::string& sensor = trial.measured[c].sensor;
      py::dict one;
      one["measured"] = py::cast(trial.measured[c].values);
      one["predicted"] = py::cast(Eigen::VectorXd(predicted[t].col(static_cast<Eigen::Index>(c))));
      one["unit"] = model::reading_unit(loaded.model, sensor);
      one["floor"] = sensor_of(loaded.model, trial.measured[c]).floor();
      channels[py::str(sensor)] = one;
    }
    py::dict curve;
    curve["trial"] = trial.name;
    curve["role"] = validation::to_string(trial.role);
    curve["time"] = py::cast(trial.time);
    curve["channels"] = channels;
    curves.append(curve);
  }
  return curves;
}

py::tuple compare(const ModelHandle& model, const std::vector<TrialHandle>& trials, double window,
                  const py::object& progress) {
  std::optional<api::Loaded> loaded;
  validation::Comparison comparison;
  const bool interrupted = run(progress, [&](const validation::StopFlag& stop, const validation::Progress&) {
    loaded = load({model, trials, window}, stop);
    comparison = validation::compare_with_curves(loaded->model, *loaded->data);
  });
  return interrupted ? py::make_tuple(true, py::none(), py::none())
                     : py::make_tuple(false, to_python(validation::to_json(comparison)),
                                      curves_of(*loaded, comparison.predicted));
}

py::tuple fit(const ModelHandle& model, const std::vector<TrialHandle>& trials, double window,
              const std::vector<std::string>& free, int iterations, double confidence,
              const py::object& progress) {
  validation::FitOptions options;
  options.iterations = iterations;
  options.confidence = confidence;
  std::optional<api::Loaded> loaded;
  validation::Fit result;
  const bool interrupted =
      run(progress, [&](const validation::StopFlag& stop, const validation::Progress& report) {
        loaded = load({model, trials, window}, stop);
        result = api::fit(*loaded, free, options, report);
      });
  if (interrupted) {
    return py::make_tuple(true, py::none(), py::none());
  }
  const ModelHandle fitted = std::make_shared<api::ChangedModel>(api::fitted(*model, result, *loaded));
  return py::make_tuple(false, to_python(api::to_json(result, *loaded, options)), fitted);
}

py::tuple diagnose(const ModelHandle& model, const std::vector<TrialHandle>& trials, double window,
                   const std::vector<std::string>& without, int most, unsigned seed,
                   const py::object& progress) {
  validation::Policy options;
  options.most_effects = most;
  options.seed = seed;
  const effects::Catalogue catalogue = api::catalogue_without(without);
  api::Answer answer;
  const bool stopped =
      run(progress, [&](const validation::StopFlag& stop, const validation::Progress& report) {
        const api::Loaded loaded = load({model, trials, window}, stop);
        answer = api::diagnose(loaded, catalogue, options, report);
      });
  if (answer.diagnosis.ladder.empty()) {
    return py::make_tuple(stopped, py::none(), py::none());
  }
  const ModelHandle found =
      std::make_shared<api::ChangedModel>(api::diagnosed(*model, api::with_best(answer)));
  return py::make_tuple(stopped || answer.diagnosis.interrupted, to_python(api::to_json(answer)), found);
}

integrate::Method method_of(const std::string& name) {
  const std::vector<std::pair<std::string, integrate::Method>> methods{
      {"explicit_rk", integrate::Method::explicit_rk},
      {"implicit_rk", integrate::Method::implicit_rk},
      {"rosenbrock", integrate::Method::rosenbrock},
      {"bdf", integrate::Method::bdf}};
  std::vector<std::string> names;
  for (const auto& [known, method] : methods) {
    if (known == name) {
      return method;
    }
    names.push_back(known);
  }
  throw InputError({"", 0, "method"}, "\"" + name + "\"", "an integrator" + nearest_names(name, names));
}

py::tuple simulate(const ModelHandle& model, const TrialHandle* trial, const std::string& experiment,
                   const std::string& method, double tolerance, bool closed_loop,
                   const py::object& progress) {
  validation::ReplayOptions options;
  options.integrator.set_tolerance(tolerance);
  options.integrator.method = method_of(method);
  options.integrator.validate();
  options.closed_loop = closed_loop;
  validation::Replay replay;
  const bool interrupted = run(progress, [&](const validation::StopFlag& stop, const validation::Progress&) {
    options.stop = &stop;
    replay = trial != nullptr
                 ? validation::replay(model->model, trial->trial, options)
                 : validation::replay(model->model, validation::read_experiment(experiment, model->model),
                                      options);
  });
  if (interrupted) {
    return py::make_tuple(true, py::none(), py::none());
  }
  py::dict columns;
  for (const Column& column : replay.trace.columns) {
    columns[py::str(column.name)] = py::make_tuple(py::cast(column.values), column.unit);
  }
  py::dict facts;
  facts["duration"] = replay.duration;
  facts["seconds"] = replay.seconds;
  facts["method"] = replay.run.summary.method;
  facts["steps"] = replay.run.summary.steps;
  facts["energy_error"] = replay.run.energy_error;
  facts["energy_exchanged"] = replay.run.energy_exchanged;
  py::list errors;
  for (const validation::ReplayError& error : replay.errors) {
    py::dict one;
    one["name"] = error.sensor;
    one["unit"] = error.unit;
    one["rms"] = error.rms;
    one["floor"] = error.floor;
    errors.append(one);
  }
  facts["channels"] = errors;
  return py::make_tuple(false, facts, columns);
}

}  // namespace

void bind_results(py::module_& module) {
  module.def("compare", compare);
  module.def("fit", fit);
  module.def("diagnose", diagnose);
  module.def("simulate", simulate, py::arg("model"), py::arg("trial").none(true), py::arg("experiment"),
             py::arg("method"), py::arg("tolerance"), py::arg("closed_loop"), py::arg("progress"));
}

}  // namespace plumbline::python
