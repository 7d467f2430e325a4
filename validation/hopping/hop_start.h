// Where a hopping run begins: the pose of the flight phase, above the floor.
#pragma once

#include <Eigen/Core>

#include "controllers/mabel_hopping/hopping_config.h"
#include "simulator/model/plant.h"

namespace plumbline::validation {

struct HopStart {
  double drop = 0.05;   ///< of the lower foot above the floor, m
  double speed = -0.3;  ///< of the hip, forward positive, m/s
  double torso = 0.0;   ///< beyond h_T0, backward positive, rad
};

/// State of a plant at the start: legs at the references of phase I (S5), springs and cables slack, at rest
/// but for the hip's speed. Throws std::runtime_error when the pose cannot be reached.
Eigen::VectorXd start_state(model::Plant& plant, const controllers::HoppingConfig& config,
                            const HopStart& start);

}  // namespace plumbline::validation
