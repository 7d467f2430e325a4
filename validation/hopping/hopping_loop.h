// The hopping controller on a simulated robot: sensors as counts in, commands of the motors out.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "controllers/mabel_hopping/hopping.h"
#include "simulator/model/plant.h"

namespace plumbline::validation {

/// Finds the controller's encoders and motors in a model by name: mLA, mLS, thigh, knee with _left and
/// _right, torso, and tower and boom_pitch (or, of a robot in the plane, hip_x and hip_z, which stand for
/// them on a boom of the controller's length); motors mLA and mLS with _left and _right; feet left and right.
class HoppingLoop {
 public:
  /// `config` without resolutions: those are the model's. Throws InputError when the model lacks a name, a
  /// sensor has no resolution or the controller refuses its constants.
  HoppingLoop(const model::Model& model, const controllers::HoppingConfig& config);

  /// One sample. `outputs`: all sensors of the model, true positions; `command` of all motors is written.
  void command(const Eigen::VectorXd& outputs, const std::vector<model::Touch>& touches, double* command);

  /// The controller as it would be in flight at the end of these samples (all sensors, true positions; one a
  /// column), behind a landing at `tower` counts that left h_T^d at `h_T_d`.
  void resume(double h_T_d, std::int64_t tower, const Eigen::MatrixXd& outputs);

  double travel_resolution() const { return tower_.resolution; }  ///< of the travel's sensor, in its unit
  const controllers::Hopping& controller() const { return controller_; }
  const controllers::HoppingTorques& torques() const { return torques_; }  ///< of the last command
  const controllers::HoppingConfig& config() const { return config_; }

 private:
  struct Encoder {
    int sensor = 0;
    double resolution = 1.0;
    std::int64_t counts(const Eigen::VectorXd& outputs) const;
  };
  struct Leg {
    Encoder mLA, mLS, thigh, knee;
    int motor_mLA = 0, motor_mLS = 0, foot = 0;
  };
  static Encoder find_encoder(const model::Model& model, const std::string& name);
  static Leg find_leg(const model::Model& model, const std::string& side);
  controllers::HoppingConfig with_resolutions(controllers::HoppingConfig config) const;
  controllers::HoppingSample sample_of(const Eigen::VectorXd& outputs) const;
  controllers::LegCounts counts(const Leg& leg, const Eigen::VectorXd& outputs) const;

  bool in_the_plane_ = false;
  Leg left_, right_;
  Encoder torso_, tower_, boom_pitch_;
  controllers::HoppingConfig config_;
  controllers::Hopping controller_;
  controllers::HoppingTorques torques_;
};

}  // namespace plumbline::validation
