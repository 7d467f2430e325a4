// A Plant as the integrator sees it, optionally with its energy accounts as two more states.
#pragma once

#include "simulator/integrate/integrator.h"
#include "simulator/model/plant.h"

namespace plumbline::integrate {

class PlantOde : public Ode {
 public:
  /// with_energy: the state is followed by the work of the motors and the dissipated energy, J.
  PlantOde(model::Plant& plant, bool with_energy, bool with_switches);

  int size() const override;
  void rate(double t, const double* x, double* xdot) override;
  bool has_jacobian() const override { return true; }
  void jacobian(double t, const double* x, Eigen::Ref<Eigen::MatrixXd> J) override;
  int positions() const override { return plant_.positions(); }
  /// Positions: their present magnitude, because stops and contacts answer to where they are. Velocities: the
  /// speed that would hold the largest kinetic energy so far, v_i = sqrt(w' M w / M_ii), so that a light
  /// pulley is not held to its own slow creep. Hidden states: the largest so far.
  void reach(const double* x, double* reach) override;
  std::string state_name(int state) const override;
  std::string stiffest(double t, const double* x) override;
  int switch_count() const override { return with_switches_ ? plant_.switch_count() : 0; }
  void switches(double t, const double* x, double* g) override;
  /// Onto the closed loops, where the model has some.
  bool has_projection() const override { return plant_.has_loops(); }
  double project(double /*t*/, double* x) override { return plant_.close_loops(x); }

  /// The command that holds from now on (command units, one for each motor).
  double* command() { return command_.data(); }

 private:
  model::Plant& plant_;
  bool with_energy_, with_switches_;
  Eigen::VectorXd command_;
};

}  // namespace plumbline::integrate
