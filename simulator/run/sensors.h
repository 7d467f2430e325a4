// The robot's sensors, read once a sample: controller and record see the same numbers.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <vector>

#include "simulator/model/plant.h"

namespace plumbline::run {

/// What the robot's electronics know at one sample.
struct Sensed {
  Eigen::VectorXd readings;  ///< of each sensor: noise added, then rounded to counts; SI
  Eigen::VectorXd counts;    ///< the same in counts, whole numbers; 0 for a sensor without resolution
  Eigen::VectorXd switches;  ///< of each contact switch: 1 closed (its foot is in the ground), 0 open
  Eigen::VectorXd feet;      ///< 1 for each foot that is in the ground, 0 for the others
};

struct SensorOptions {
  bool noise = true;     ///< as the model states it
  bool quantise = true;  ///< to counts
  std::uint64_t seed = 1;
};

/// reading = resolution * round((position + noise)/resolution), noise drawn anew for each sensor and sample,
/// in the order of the model's sensors. One generator for all of them: a run can be repeated from its seed.
class Sensors {
 public:
  Sensors(const model::Model& model, const SensorOptions& options);

  /// `outputs`: true positions (or forces) of all sensors; `touches`: of all feet.
  void read(const Eigen::VectorXd& outputs, const std::vector<model::Touch>& touches, Sensed& sensed);

 private:
  const model::Model& model_;
  SensorOptions options_;
  std::mt19937_64 random_;
};

}  // namespace plumbline::run
