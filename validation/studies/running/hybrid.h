// Thumper as the paper models it, under its controller in continuous time: pinned toe, rigid impact, spring
// locked in flight, internal impact where B_Spring reaches its stop (Poulakakis and Grizzle, ICRA 2009,
// section III).
//
// This is what gaits are designed on: the equations are the controller's own.
#pragma once

#include <vector>

#include "controllers/monopod/running.h"

namespace plumbline::validation {

/// The closed loop in continuous time at one state: pinned toe in stance, spring on its stop in flight.
struct ControlledState {
  monopod::State rate;         ///< q', q''
  monopod::Vector2 torque;     ///< of leg-angle and leg-shape motor, N m
  monopod::Vector2 force;      ///< of the ground on the toe, N; zero in flight
  monopod::Dynamics dynamics;  ///< at the state
};
ControlledState closed_loop(monopod::Running& control, const monopod::State& state);

/// One step of the classical method of Runge and Kutta.
monopod::State runge_kutta(monopod::Running& control, const monopod::State& state, double step);

/// B_Spring meets its stop: what is left of its deflection is given up, and the motor is carried along in an
/// internal impact (section III-C.2). Returns the state after it.
monopod::State internal_impact(const monopod::Constants& c, const monopod::State& state);

/// The state just before a touchdown on the ground z = 0, with the centre of mass of a section.
monopod::State state_at(const monopod::Constants& c, const monopod::Section& section);

struct HybridSample {
  double time = 0.0;
  monopod::Phase phase = monopod::Phase::flight;
  monopod::State state;
  monopod::Vector2 torque, force, com, com_rate, toe;
};

/// What one stride was like.
struct StrideFacts {
  double flight = 0.0, stance = 0.0, compression = 0.0;  ///< s
  double least_normal = 1e9;                             ///< of the ground's force, N
  double most_friction = 0.0;          ///< tangential over normal force where that is above 5 % of the weight
  double last_normal = 0.0;            ///< just before lift-off, N
  double most_torque[2] = {0.0, 0.0};  ///< at the leg-angle and the leg-shape motor, N m
  bool spring_at_rest = false;  ///< lift-off because B_Spring met its stop, not because the force ended
  monopod::Section section = monopod::Section::Zero();  ///< just before touchdown
  double impulse_ratio = 0.0;                           ///< tangential over normal impulse of the touchdown
  double lift = 0.0;                                    ///< the toe's upward speed after lift-off, m/s
  double scuff = 0.0;             ///< how deep the toe is in the ground after lift-off at most, m
  double travel = 0.0;            ///< of the centre of mass in flight, m
  double torso_at_liftoff = 0.0;  ///< rad
  double motor_at_liftoff = 0.0;  ///< leg-shape motor before the internal impact, rad
};

class HybridRun {
 public:
  HybridRun(const monopod::Running& running, double step) : control(running), step_(step) {}

  /// The touchdown, and stance up to after the next lift-off. False: the robot falls.
  bool stand();
  /// From after a lift-off to just before a touchdown; a toe that touches the ground within 2 ms after
  /// lift-off has not left it. False: the toe does not come down within a second.
  bool fly();

  monopod::Running control;
  monopod::State state;
  double time = 0.0;
  StrideFacts facts;  ///< of the stance that was last begun and the flight behind it
  std::vector<HybridSample>* record = nullptr;

 private:
  monopod::State stepped(double step) { return runge_kutta(control, state, step); }
  void watch(const ControlledState& r);
  void lift_off(double begin, bool at_rest);

  double step_;
};

}  // namespace plumbline::validation
