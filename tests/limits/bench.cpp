#include "tests/limits/bench.h"

#include <cmath>

namespace plumbline::limits {

model::Model leg_bench() {
  return model::read_model(std::string(PLUMBLINE_ROOT) + "/robots/mabel/leg_bench.yaml",
                           effects::Catalogue::all());
}

validation::Experiment both_motors(const model::Model& model, double duration) {
  validation::Experiment experiment =
      validation::read_experiment(std::string(PLUMBLINE_ROOT) + "/robots/mabel/experiments/mimo.yaml", model);
  const auto samples = static_cast<Eigen::Index>(std::lround(duration / experiment.period)) + 1;
  experiment.duration = duration;
  experiment.time.conservativeResize(samples);
  for (validation::Command& command : experiment.commands) {
    command.values.conservativeResize(samples);
  }
  return experiment;
}

model::Model with_effect(model::Model model, const std::shared_ptr<const effects::Law>& law,
                         const std::string& at, const effects::Values& values) {
  model::EffectUse use;
  use.law = law;
  use.at = at;
  for (const double value : values) {
    model::Quantity quantity;
    quantity.value = value;
    use.values.push_back(quantity);
  }
  model.effects.push_back(use);
  return model;
}

model::Model with_effect(const model::Model& model, const std::string& law, const std::string& at,
                         const effects::Values& values) {
  return with_effect(model, effects::Catalogue::all().find(law), at, values);
}

run::CommandedOptions options_at(double relative_tolerance) {
  run::CommandedOptions options;
  options.integrator.relative_tolerance = relative_tolerance;
  options.integrator.absolute_tolerance = Eigen::VectorXd::Constant(1, 1e-2 * relative_tolerance);
  return options;
}

run::CommandedRun simulate(const model::Model& model, const validation::Experiment& experiment,
                           const run::CommandedOptions& options) {
  model::Plant plant(model, validation::locks_of(model, experiment));
  Eigen::MatrixXd commands = Eigen::MatrixXd::Zero(plant.motors(), experiment.time.size());
  for (int m = 0; m < plant.motors(); ++m) {
    for (const validation::Command& command : experiment.commands) {
      if (command.motor == model.motors[static_cast<std::size_t>(m)].name) {
        commands.row(m) = command.values.transpose();
      }
    }
  }
  return run::run_commands(plant, validation::start_state(plant, experiment), commands, experiment.period,
                           0.0, {}, nullptr, options);
}

NamedMap named_map(const model::Plant& plant, const std::vector<std::string>& names) {
  const auto rows = static_cast<Eigen::Index>(names.size());
  NamedMap result{Eigen::MatrixXd(rows, plant.positions()), Eigen::VectorXd(rows)};
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  for (Eigen::Index r = 0; r < rows; ++r) {
    const std::string& name = names[static_cast<std::size_t>(r)];
    result.offset[r] = plant.position_of(name, x.data());
    for (Eigen::Index i = 0; i < plant.positions(); ++i) {
      x[plant.positions() + i] = 1.0;
      result.map(r, i) = plant.velocity_of(name, x.data());
      x[plant.positions() + i] = 0.0;
    }
  }
  return result;
}

double largest_difference(const run::CommandedRun& one, const run::CommandedRun& other) {
  return (one.outputs - other.outputs).cwiseAbs().maxCoeff();
}

effects::Scales scales_of(const model::Model& model, const run::CommandedRun& run, effects::Place place,
                          const std::string& at) {
  const std::string seen = place == effects::Place::ratio ? model.find_ratio(at)->motor : at;
  model::Plant plant(model, {});
  const NamedMap named = named_map(plant, {seen});
  const Eigen::Index nz = plant.positions();
  const Eigen::VectorXd position =
      ((named.map * run.states.topRows(nz)).array() + named.offset[0]).matrix().transpose();
  const Eigen::VectorXd velocity = (named.map * run.states.middleRows(nz, nz)).transpose();
  Eigen::VectorXd rate(plant.states());
  const Eigen::VectorXd idle = Eigen::VectorXd::Zero(plant.motors());
  plant.rate(run.states.col(0).data(), idle.data(), rate.data());
  effects::Scales scales;
  scales.position = 0.5 * (position.maxCoeff() - position.minCoeff());
  scales.center = position.mean();
  scales.velocity = velocity.norm() / std::sqrt(static_cast<double>(velocity.size()));
  scales.inertia = plant.inertia_of(seen) * (place == effects::Place::ratio ? 0.25 : 1.0);
  // The force that accelerates the place: root mean square of its velocity's change.
  const Eigen::Index n = velocity.size() - 1;
  const double acceleration = (velocity.tail(n) - velocity.head(n)).norm() /
                              std::sqrt(static_cast<double>(n)) / (run.time[1] - run.time[0]);
  scales.force = scales.inertia * acceleration;
  return scales;
}

effects::Values tenth_of_typical(const effects::Law& law, const effects::Scales& scales) {
  effects::Values values = law.starts(scales).front();
  const effects::Values typical = law.typical(scales);
  for (std::size_t p = 0; p < values.size(); ++p) {
    const effects::Parameter& parameter = law.declaration().parameters[p];
    if (!parameter.structural && parameter.scale == effects::Scale::linear &&
        values[p] == parameter.null_value) {
      values[p] += 0.1 * typical[p];
    }
  }
  return values;
}

}  // namespace plumbline::limits
