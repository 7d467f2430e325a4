// A Plant on pinned feet as the integrator sees it.
#pragma once

#include <functional>

#include "simulator/integrate/integrator.h"
#include "simulator/model/rigid_contact.h"

namespace plumbline::integrate {

/// The state of the Plant, followed by the work of the motors and the dissipated energy, J. Positions and
/// velocities are moved back onto what is held after each step. The switching functions are given by the run
/// (a foot's height, a normal force, a phase).
class RigidContactOde : public Ode {
 public:
  /// Fills the commands that act at t and x (command units).
  using Commands = std::function<void(double t, const double* x, double* command)>;
  using Switches = std::function<void(double t, const double* x, double* g)>;

  RigidContactOde(model::Plant& plant, model::RigidContact& contact, Commands commands, int switch_count = 0,
                  Switches switches = {});

  int size() const override { return plant_.states() + 2; }
  void rate(double t, const double* x, double* xdot) override;
  std::string state_name(int state) const override;
  int switch_count() const override { return switch_count_; }
  void switches(double t, const double* x, double* g) override { switches_(t, x, g); }
  bool has_projection() const override { return true; }
  double project(double t, double* x) override;

 private:
  model::Plant& plant_;
  model::RigidContact& contact_;
  Commands commands_;
  int switch_count_;
  Switches switches_;
  Eigen::VectorXd command_;
};

}  // namespace plumbline::integrate
