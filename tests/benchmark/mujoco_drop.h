// The dropped leg in MuJoCo, on the same ground.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>

#include "simulator/model/model.h"
#include "tests/benchmark/replay.h"

namespace plumbline::benchmarks {

enum class MujocoMethod { runge_kutta, implicit, euler };

std::string to_string(MujocoMethod method);

/// A chain of links with one foot, motion in the plane of x and z, springs and dampers at its joints
/// (MuJoCo's own), and the ground of its foot through MuJoCo's callbacks: the laws of contact/, called from
/// mjcb_passive. The bristle along x is the activation of an actuator without force (mjcb_act_dyn), so that
/// every method of MuJoCo integrates it. MuJoCo's contacts, constraints and sensors are switched off.
/// `implicit` and `euler` are implicit in the joints' damping, as always, but not in the ground's: MuJoCo
/// does not ask a callback for slopes. The callbacks are the process's: one object at a time.
class MujocoDrop {
 public:
  /// Throws std::runtime_error for a model that is no such chain, or with MuJoCo's reason.
  explicit MujocoDrop(const model::Model& model);
  ~MujocoDrop();
  MujocoDrop(const MujocoDrop&) = delete;
  MujocoDrop& operator=(const MujocoDrop&) = delete;

  /// d(state)/dt. States are the plant's: joints' positions, velocities, two bristles; the one across the
  /// plane stays zero.
  Eigen::VectorXd rate(const Eigen::VectorXd& x);

  /// Throws std::runtime_error when the motion grows beyond MuJoCo's bounds.
  Course simulate(const Replay& drop, MujocoMethod method, int steps_per_sample);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumbline::benchmarks
