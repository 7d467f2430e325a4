#include "validation/hopping/hip_watch.h"

#include <cmath>

namespace plumbline::validation {

HipAxes hip_axes(const model::Model& model) {
  const bool in_the_plane = model.sensor_index("boom_pitch") < 0;
  return {in_the_plane, in_the_plane ? "hip_x" : "tower", in_the_plane ? "hip_z" : "boom_pitch"};
}

HipWatch::HipWatch(const model::Model& model, const controllers::HoppingConfig& config)
    : in_the_plane_(hip_axes(model).in_the_plane),
      boom_length_(config.boom_length),
      torso_(model.sensor_index("torso")),
      travel_(model.sensor_index(hip_axes(model).travel)),
      height_(model.sensor_index(hip_axes(model).height)) {}

double HipWatch::travel(const Eigen::VectorXd& outputs) const {
  return in_the_plane_ ? outputs[travel_] : boom_length_ * outputs[travel_];
}

double HipWatch::height(const Eigen::VectorXd& outputs) const {
  return in_the_plane_ ? outputs[height_] : boom_length_ * std::sin(outputs[height_]);
}

}  // namespace plumbline::validation
