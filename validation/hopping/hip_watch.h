// Where the hip is, from the sensors' true positions.
#pragma once

#include <Eigen/Core>
#include <string>

#include "controllers/mabel_hopping/hopping_config.h"
#include "simulator/model/model.h"

namespace plumbline::validation {

/// How the hip moves: at a boom (turn of the tower, boom pitch) or in the plane (hip_x, hip_z).
struct HipAxes {
  bool in_the_plane;
  std::string travel, height;  ///< names of the coordinates and of their sensors
};
HipAxes hip_axes(const model::Model& model);

/// For a robot at its boom (sensors tower and boom_pitch) or in the plane (hip_x and hip_z).
class HipWatch {
 public:
  HipWatch(const model::Model& model, const controllers::HoppingConfig& config);

  double torso(const Eigen::VectorXd& outputs) const { return outputs[torso_]; }  ///< rad
  double travel(const Eigen::VectorXd& outputs) const;  ///< along the hip's circle, forward positive, m
  double height(const Eigen::VectorXd& outputs) const;  ///< above a level boom, m

 private:
  bool in_the_plane_;
  double boom_length_;
  int torso_, travel_, height_;
};

}  // namespace plumbline::validation
