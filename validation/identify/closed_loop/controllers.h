// A trial's known controllers at work on a model.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "controllers/blocks/cascade_pd.h"
#include "simulator/model/plant.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::validation {

/// The control law of a trial's controller, at rest at zero.
controllers::CascadePd law_of(const Controller& controller, double period);

/// All controllers of a trial, each with the sensor it reads and the motor it commands.
class TrialControllers {
 public:
  /// They arrive with the motion that x0 has: a recording may begin in full swing. Throws InputError when the
  /// plant's model has no such sensor or motor.
  TrialControllers(model::Plant& plant, const Trial& trial, const Eigen::VectorXd& x0);

  /// Commands of a sample, written for the controlled motors only. `readings`: of all sensors of the model.
  void command(Eigen::Index sample, const Eigen::VectorXd& readings, double* command);

 private:
  struct Loop {
    int sensor, motor;
    controllers::CascadePd law;
    const Controller* known;
  };
  std::vector<Loop> loops_;
};

}  // namespace plumbline::validation
