#include "validation/hopping/hip_watch.h"

#include <cmath>

namespace plumbline::validation {

HipWatch::HipWatch(const model::Model& model, const controllers::HoppingConfig& config)
    : in_the_plane_(model.sensor_index("boom_pitch") < 0),
      boom_length_(config.boom_length),
      torso_(model.sensor_index("torso")),
      travel_(model.sensor_index(in_the_plane_ ? "hip_x" : "tower")),
      height_(model.sensor_index(in_the_plane_ ? "hip_z" : "boom_pitch")) {}

double HipWatch::travel(const Eigen::VectorXd& outputs) const {
  return in_the_plane_ ? outputs[travel_] : boom_length_ * outputs[travel_];
}

double HipWatch::height(const Eigen::VectorXd& outputs) const {
  return in_the_plane_ ? outputs[height_] : boom_length_ * std::sin(outputs[height_]);
}

}  // namespace plumbline::validation
