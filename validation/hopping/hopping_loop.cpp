#include "validation/hopping/hopping_loop.h"

#include <cmath>
#include <stdexcept>

#include "simulator/trace/error.h"
#include "validation/hopping/hip_watch.h"

namespace plumbline::validation {
namespace {

int foot_index(const model::Model& model, const std::string& name) {
  for (std::size_t f = 0; f < model.feet.size(); ++f) {
    if (model.feet[f].name == name) {
      return static_cast<int>(f);
    }
  }
  throw InputError({model.file, 0, "feet"}, "no foot \"" + name + "\"", "feet left and right for hopping");
}

int motor_index(const model::Model& model, const std::string& name) {
  const int index = model.motor_index(name);
  if (index < 0) {
    throw InputError({model.file, 0, "motors"}, "no motor \"" + name + "\"", "it, for hopping");
  }
  return index;
}

controllers::Hopping make(const controllers::HoppingConfig& config, const std::string& file) {
  try {
    return controllers::Hopping(config);
  } catch (const std::invalid_argument& error) {
    throw InputError(file + ": the hopping controller refuses its constants: " + error.what());
  }
}

}  // namespace

HoppingLoop::HoppingLoop(const model::Model& model, const controllers::HoppingConfig& config)
    : in_the_plane_(hip_axes(model).in_the_plane),
      left_(find_leg(model, "left")),
      right_(find_leg(model, "right")),
      torso_(find_encoder(model, "torso")),
      tower_(find_encoder(model, hip_axes(model).travel)),
      boom_pitch_(find_encoder(model, hip_axes(model).height)),
      config_(with_resolutions(config)),
      controller_(make(config_, model.file)) {}

std::int64_t HoppingLoop::Encoder::counts(const Eigen::VectorXd& outputs) const {
  return std::llround(outputs[sensor] / resolution);
}

HoppingLoop::Encoder HoppingLoop::find_encoder(const model::Model& model, const std::string& name) {
  Encoder encoder;
  encoder.sensor = model.sensor_index(name);
  if (encoder.sensor < 0) {
    throw InputError({model.file, 0, "sensors"}, "no sensor \"" + name + "\"", "it, for hopping");
  }
  encoder.resolution = model.sensors[static_cast<std::size_t>(encoder.sensor)].resolution;
  if (!(encoder.resolution > 0.0)) {
    throw InputError({model.file, 0, name}, "a sensor without resolution", "counts, for the controller");
  }
  return encoder;
}

HoppingLoop::Leg HoppingLoop::find_leg(const model::Model& model, const std::string& side) {
  return {find_encoder(model, "mLA_" + side),
          find_encoder(model, "mLS_" + side),
          find_encoder(model, "thigh_" + side),
          find_encoder(model, "knee_" + side),
          motor_index(model, "mLA_" + side),
          motor_index(model, "mLS_" + side),
          foot_index(model, side)};
}

controllers::HoppingConfig HoppingLoop::with_resolutions(controllers::HoppingConfig config) const {
  const double arm = in_the_plane_ ? config.boom_length : 1.0;
  controllers::HoppingResolutions& resolution = config.resolution;
  resolution.mLA = left_.mLA.resolution;
  resolution.mLS = left_.mLS.resolution;
  resolution.thigh = left_.thigh.resolution;
  resolution.knee = left_.knee.resolution;
  resolution.torso = torso_.resolution;
  resolution.tower = tower_.resolution / arm;
  resolution.boom_pitch = boom_pitch_.resolution / arm;
  return config;
}

controllers::LegCounts HoppingLoop::counts(const Leg& leg, const Eigen::VectorXd& outputs) const {
  return {leg.mLA.counts(outputs), leg.mLS.counts(outputs), leg.thigh.counts(outputs),
          leg.knee.counts(outputs)};
}

controllers::HoppingSample HoppingLoop::sample_of(const Eigen::VectorXd& outputs) const {
  controllers::HoppingSample sample;
  sample.left = counts(left_, outputs);
  sample.right = counts(right_, outputs);
  sample.torso = torso_.counts(outputs);
  sample.tower = tower_.counts(outputs);
  sample.boom_pitch = boom_pitch_.counts(outputs);
  return sample;
}

void HoppingLoop::resume(double h_T_d, std::int64_t tower, const Eigen::MatrixXd& outputs) {
  controller_.resume(h_T_d, tower);
  for (const auto& column : outputs.colwise()) {
    torques_ = controller_.command(sample_of(column));
  }
}

void HoppingLoop::command(const Eigen::VectorXd& outputs, const std::vector<model::Touch>& touches,
                          double* command) {
  controllers::HoppingSample sample = sample_of(outputs);
  sample.left_contact = touches[static_cast<std::size_t>(left_.foot)].depth > 0.0;
  sample.right_contact = touches[static_cast<std::size_t>(right_.foot)].depth > 0.0;
  torques_ = controller_.command(sample);
  command[left_.motor_mLA] = torques_.mLA_left;
  command[left_.motor_mLS] = torques_.mLS_left;
  command[right_.motor_mLA] = torques_.mLA_right;
  command[right_.motor_mLS] = torques_.mLS_right;
}

}  // namespace plumbline::validation
