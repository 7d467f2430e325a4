#include "validation/identify/closed_loop/controllers.h"

#include <string>

#include "simulator/trace/error.h"

namespace plumbline::validation {
namespace {

void require(int index, const std::string& name, const std::string& kind,
             const std::vector<std::string>& names, const Trial& trial) {
  if (index < 0) {
    throw InputError({trial.file, 0, "controllers"}, name,
                     "a " + kind + " of the model" + nearest_names(name, names));
  }
}

}  // namespace

controllers::CascadePd law_of(const Controller& c, double period) {
  return controllers::CascadePd({c.position_gain, c.velocity_gain, c.command_limit, period, c.velocity_over});
}

TrialControllers::TrialControllers(model::Plant& plant, const Trial& trial, const Eigen::VectorXd& x0) {
  const model::Model& model = plant.model();
  Eigen::VectorXd y(plant.sensors());
  plant.outputs(x0.data(), y.data());
  Eigen::MatrixXd slope;
  plant.output_jacobian(x0.data(), slope);
  const Eigen::VectorXd rate =
      slope.leftCols(plant.positions()) * x0.segment(plant.positions(), plant.positions());
  for (const Controller& known : trial.controllers) {
    Loop loop{model.sensor_index(known.sensor), model.motor_index(known.motor), law_of(known, trial.period),
              &known};
    require(loop.sensor, known.sensor, "sensor", model.places(effects::Place::sensor), trial);
    require(loop.motor, known.motor, "motor", model.places(effects::Place::motor), trial);
    loop.law.reset(y[loop.sensor], rate[loop.sensor]);
    loops_.push_back(loop);
  }
}

void TrialControllers::command(Eigen::Index sample, const Eigen::VectorXd& readings, double* command) {
  for (Loop& loop : loops_) {
    const Eigen::VectorXd& added = loop.known->disturbance;
    command[loop.motor] = loop.law.command(loop.known->reference[sample], readings[loop.sensor],
                                           added.size() > 0 ? added[sample] : 0.0);
  }
}

}  // namespace plumbline::validation
