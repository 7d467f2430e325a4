// What the one-step methods share: a step at a time, and switches located by stepping there again.
#pragma once

#include "simulator/integrate/backend.h"

namespace plumbline::integrate {

class OneStepBackend : public Backend {
 public:
  /// Every step begins with the rate at its own beginning: nothing old is kept that a new input would
  /// falsify.
  void input_changed(bool /*keep_history*/) override {}
  bool advance(double t_stop) override;
  bool step_once(double t_stop) override;

 protected:
  OneStepBackend(Bridge& bridge, const Options& options)
      : Backend(bridge, options),
        x_before_(x_),
        g_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(directions_.size()))),
        g_before_(g_) {}

  /// One step towards t_stop, not beyond it; t_ and x_ are moved.
  virtual void step(double t_stop) = 0;
  /// Steps until t_stop.
  virtual void steps(double t_stop) = 0;
  /// t_ and x_ have been set from outside: the next step begins there.
  virtual void moved() = 0;
  /// A start: the switching functions are not known yet.
  void forget_switches() {
    restarts_ = 0;
    switches_known_ = false;
  }

  long restarts_ = 0;

 private:
  void go_to(double t, const Eigen::VectorXd& x, double t_stop);
  void locate(double t_before, double t_after);

  bool switches_known_ = false;  // g_ belongs to the present state
  Eigen::VectorXd x_before_, g_, g_before_;
};

}  // namespace plumbline::integrate
