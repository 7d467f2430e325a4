// Hops gathered while a run goes on.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "controllers/mabel_hopping/hopping.h"
#include "simulator/model/plant.h"
#include "validation/hopping/hip_watch.h"
#include "validation/hopping/hop.h"

namespace plumbline::validation {

/// Called once a sample, in this order: feet, load, sample.
class HopCounter {
 public:
  HopCounter(const HipWatch& watch, const controllers::HoppingConfig& config, std::vector<Hop>& hops)
      : watch_(watch), config_(config), hops_(hops) {}

  /// When each of the two feet came down.
  void feet(double t, const std::vector<model::Touch>& touches);
  void load(const controllers::HoppingTorques& torques, double stretch_LA, double stretch_LS);
  /// The hop ends, and the next begins, where the controller has landed.
  void sample(double t, const Eigen::VectorXd& outputs, const controllers::Hopping& controller);

  double time_at_limit() const { return time_at_limit_; }  ///< of all hops, whole and begun, s

 private:
  void land(double t, const Eigen::VectorXd& outputs, const controllers::Hopping& controller);

  const HipWatch& watch_;
  const controllers::HoppingConfig& config_;
  std::vector<Hop>& hops_;
  Hop now_;
  double time_at_limit_ = 0.0;
  bool landed_ = false;
  double last_time_ = 0.0, last_travel_ = 0.0;
  bool down_[2] = {false, false};
  double since_[2] = {0.0, 0.0};
};

}  // namespace plumbline::validation
