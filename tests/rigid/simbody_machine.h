// A model's whole mechanism in Simbody alone: its mobilizers, its constraints, its operators.
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "simulator/model/model.h"

namespace plumbline::rigid_tests {

/// Links hang on pins, sliders and welds; every motor and pulley is a body of its own that turns about a
/// fixed axis; rigid ratios are coordinate couplers, pinned feet points in planes. Nothing of the project
/// computes anything here. For models without effects.
class SimbodyMachine {
 public:
  /// axes[f]: world axes (0 to 2) in which foot `feet[f]` is held.
  SimbodyMachine(const model::Model& model, const std::vector<int>& feet,
                 const std::vector<std::vector<int>>& axes);
  ~SimbodyMachine();

  /// Position and velocity of joints, motors and pulleys by their name.
  void set(const std::map<std::string, std::pair<double, double>>& states);
  struct Answer {
    std::map<std::string, double> coordinate;  ///< acceleration, or velocity after the impact
    Eigen::VectorXd at_feet;                   ///< force, or impulse, along each foot's axes
  };
  /// Under gravity and the motors' torques.
  Answer accelerate(const Eigen::VectorXd& torques);
  /// After the feet have been caught.
  Answer strike();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumbline::rigid_tests
