// What a Plant is asked about and what it answers with.
#pragma once

#include <Eigen/Core>
#include <string>

namespace plumbline::model {

/// A parameter of one of the model's effects.
struct ParameterId {
  int effect = 0;     ///< index in Model::effects
  int parameter = 0;  ///< index in the law's declaration
};

/// Motion over a short time in which commands are held.
struct SampleMotion {
  const double* middle;         ///< mean of the states at both ends
  const double* change;         ///< state at the end less state at the start
  const double* command;        ///< of each motor, mean over the sample
  const double* command_slope;  ///< d(command)/d(delay) of each motor, 1/s
  double period;                ///< s
  double hold = 0.0;            ///< s for which a command holds, where that is longer; 0: the period
  bool jumped = false;          ///< a force jumped where it begins
};

/// A foot and the ground under it, in the world's axes.
struct Touch {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s
  double depth = 0.0;                                  ///< in the ground when above 0, m
  /// Of its link (the frame's y) along the ground; of a robot that floats, where friction is alike in all
  /// directions, of the world: a link that tumbles has no left.
  Eigen::Vector2d left = Eigen::Vector2d::UnitY();
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();    ///< angular velocity of its link, rad/s
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< of the ground on the foot, N
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< the same, N m
};

/// How deep a foot is in the ground (under 0: above it), m, and its rate, m/s.
struct FootDepth {
  double depth = 0.0;
  double rate = 0.0;
};

/// Energy of a state and where power goes.
struct Energetics {
  double stored = 0.0;      ///< kinetic, gravity and springs, J
  double input = 0.0;       ///< power of the motors' delivered torques, W
  double dissipated = 0.0;  ///< by all effects, W
};

/// What moves a state fastest.
struct Stiffest {
  std::string element;  ///< "hard_stop at bsp_left"; empty when no effect moves anything
  double rate = 0.0;    ///< 1/s
};

/// A switching function that is zero where a force jumps (ForceLaw::jumps), and whose effect that is.
struct ForceJump {
  int index = 0;   ///< switching function
  int effect = 0;  ///< of the model
};

}  // namespace plumbline::model
