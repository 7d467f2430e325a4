// The step size of a one-step method between stops that come often.
#pragma once

namespace plumbline::integrate {

/// Elementary error control, h' = h * safety * error^(-1/order) (Hairer, Norsett, Wanner, Solving ODEs I,
/// II.4), that knows the stops: what is left to the next one is divided evenly, and a step cut short by a
/// stop does not make the next one short.
class StepControl {
 public:
  StepControl() = default;
  /// order: of the local error of the method's error estimate.
  explicit StepControl(int order) : exponent_(-1.0 / order) {}

  /// From now on t is integrated to t_stop; the stretch behind that is taken to be as long, until it is
  /// known.
  void set_stop(double t, double t_stop);
  /// The step to take after one of size h, which led to time t (a rejected one: would have led away from t),
  /// with scaled error (<= 1: accepted).
  double next(double t, double h, double error);

 private:
  double even(double t) const;

  double exponent_ = -0.25;
  double wanted_ = 0.0;  // by the error alone
  double stop_ = 0.0;
  double stretch_ = 0.0;
  bool rejected_ = false;  // the step before this one
};

}  // namespace plumbline::integrate
