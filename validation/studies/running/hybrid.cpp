#include "validation/studies/running/hybrid.h"

#include <algorithm>
#include <cmath>

namespace plumbline::validation {

using namespace monopod;

namespace {

constexpr double kLongestPhase = 1.0;      // s
constexpr double kShortestFlight = 0.002;  // s; a toe that touches before has not left the ground
constexpr double kLoaded = 0.05;           // share of the weight above which friction is looked at

/// The part of a step after which `value` becomes positive; it is not before it and is after it.
template <class Value>
double crossing(double step, const Value& value) {
  double below = 0.0, above = step, at_below = value(0.0), at_above = value(step);
  for (int i = 0; i < 60 && above - below > 1e-13; ++i) {
    // Illinois: the secant, with the standing end halved.
    double middle = above - at_above * (above - below) / (at_above - at_below);
    if (!(middle > below && middle < above)) {
      middle = 0.5 * (below + above);
    }
    const double there = value(middle);
    if (there == 0.0) {
      return middle;
    }
    if (there > 0.0) {
      above = middle;
      at_above = there;
      at_below *= 0.5;
    } else {
      below = middle;
      at_below = there;
      at_above *= 0.5;
    }
  }
  return above;
}

}  // namespace

ControlledState closed_loop(Running& control, const State& state) {
  ControlledState r;
  r.dynamics = dynamics(control.constants(), state);
  r.torque = control.torque(state, r.dynamics);
  const bool flies = control.phase() == Phase::flight;
  const Acceleration a = flies ? accelerations(r.dynamics, flight(control.constants(), r.dynamics))
                               : accelerations(r.dynamics, stance(r.dynamics));
  r.rate.q = state.v;
  r.rate.v = a.drift + a.gain * r.torque;
  r.force = Vector2::Zero();
  if (!flies) {
    r.force = ground_force(r.dynamics, r.rate.v);
  }
  return r;
}

State runge_kutta(Running& control, const State& state, double step) {
  const auto moved = [&](const State& rate, double h) {
    State to = state;
    to.q += h * rate.q;
    to.v += h * rate.v;
    return to;
  };
  const State k1 = closed_loop(control, state).rate;
  const State k2 = closed_loop(control, moved(k1, 0.5 * step)).rate;
  const State k3 = closed_loop(control, moved(k2, 0.5 * step)).rate;
  const State k4 = closed_loop(control, moved(k3, step)).rate;
  State to = state;
  to.q += step / 6.0 * (k1.q + 2.0 * k2.q + 2.0 * k3.q + k4.q);
  to.v += step / 6.0 * (k1.v + 2.0 * k2.v + 2.0 * k3.v + k4.v);
  return to;
}

State internal_impact(const Constants& c, const State& state) {
  State after = state;
  after.q[kMotor] = c.shape_ratio * after.q[kLegShape];
  const Dynamics d = dynamics(c, after);
  after.v = impact(d, flight(c, d), after.v);
  return after;
}

State state_at(const Constants& c, const Section& section) {
  State state;
  state.q << section[0], section[1], c.shape_ratio * section[1], section[2], 0.0, 0.0;
  state.v << section[3], section[4], c.shape_ratio * section[4], section[5], 0.0, 0.0;
  stand_on_origin(c, state, false);
  state.v.tail<2>() = section.tail<2>() - dynamics(c, state).com_jacobian * state.v;
  return state;
}

void HybridRun::watch(const ControlledState& r) {
  for (int i = 0; i < 2; ++i) {
    facts.most_torque[i] = std::max(facts.most_torque[i], std::abs(r.torque[i]));
  }
  if (control.phase() != Phase::flight) {
    facts.least_normal = std::min(facts.least_normal, r.force[1]);
    const Constants& c = control.constants();
    if (r.force[1] > kLoaded * total_mass(c) * c.gravity) {
      facts.most_friction = std::max(facts.most_friction, std::abs(r.force[0]) / r.force[1]);
    }
  }
  if (record != nullptr) {
    const Dynamics& d = r.dynamics;
    record->push_back(
        {time, control.phase(), state, r.torque, r.force, d.com, d.com_jacobian * state.v, d.toe});
  }
}

bool HybridRun::fly() {
  const double begin = time, from = dynamics(control.constants(), state).com[0];
  const auto below = [&](const State& s) { return -dynamics(control.constants(), s).toe[1]; };
  while (time - begin < kLongestPhase) {
    watch(closed_loop(control, state));
    const State next = stepped(step_);
    if (!next.q.allFinite() || !next.v.allFinite()) {
      return false;
    }
    const bool off_the_ground = time - begin > kShortestFlight;
    facts.scuff = off_the_ground ? facts.scuff : std::max(facts.scuff, below(next));
    if (below(next) > 0.0 && below(state) <= 0.0 && off_the_ground) {
      const double part = crossing(step_, [&](double h) { return below(stepped(h)); });
      state = stepped(part);
      time += part;
      watch(closed_loop(control, state));
      facts.flight = time - begin;
      facts.travel = dynamics(control.constants(), state).com[0] - from;
      facts.section = section_of(control.constants(), state);
      return true;
    }
    state = next;
    time += step_;
  }
  return false;
}

void HybridRun::lift_off(double begin, bool at_rest) {
  const Constants& c = control.constants();
  const ControlledState last = closed_loop(control, state);
  watch(last);
  facts.last_normal = last.force[1];
  facts.spring_at_rest = at_rest;
  facts.stance = time - begin;
  facts.torso_at_liftoff = state.q[kTorso];
  facts.motor_at_liftoff = state.q[kMotor];
  state = internal_impact(c, state);
  const Dynamics d = dynamics(c, state);
  facts.lift = (d.toe_jacobian * state.v)[1];
  control.lift_off(state, d.com[1] - d.toe[1]);
}

bool HybridRun::stand() {
  const Constants& c = control.constants();
  facts = StrideFacts();
  const State before = state;
  const Dynamics d = dynamics(c, before);
  state.v = impact(d, stance(d), before.v);
  const Vector2 impulse = (d.mass * (state.v - before.v)).tail<2>();
  facts.impulse_ratio = impulse[0] / impulse[1];
  control.touch_down(before, state);
  const double begin = time, hip = 0.5 * (c.upper_length + c.lower_length);
  while (time - begin < kLongestPhase) {
    const ControlledState now = closed_loop(control, state);
    watch(now);
    const State next = stepped(step_);
    if (!next.q.allFinite() || next.q[kHipZ] - d.toe[1] < hip) {
      return false;
    }
    if (control.phase() == Phase::compression && deflection(c, next.v) < 0.0) {
      const double part = crossing(step_, [&](double h) { return -deflection(c, stepped(h).v); });
      state = stepped(part);
      time += part;
      facts.compression = time - begin;
      control.inject(state);
      continue;
    }
    if (control.phase() == Phase::injection && control.injected(next)) {
      // The polynomials end with neither slope nor curvature: the step may go across.
      control.decompress();
    }
    // A foot that is pulled at just after touchdown is a fault of the gait, not a lift-off.
    const bool may_lift = control.phase() != Phase::compression;
    const bool at_rest = may_lift && deflection(c, next.q) < 0.0;
    const bool unloaded = may_lift && now.force[1] > 0.0 && closed_loop(control, next).force[1] < 0.0;
    if (at_rest || unloaded) {
      const double never = 2.0 * step_;
      const double rest_part =
          at_rest ? crossing(step_, [&](double h) { return -deflection(c, stepped(h).q); }) : never;
      const double force_part =
          unloaded ? crossing(step_, [&](double h) { return -closed_loop(control, stepped(h)).force[1]; })
                   : never;
      const double part = std::min(rest_part, force_part);
      state = stepped(part);
      time += part;
      lift_off(begin, rest_part <= force_part);
      return true;
    }
    state = next;
    time += step_;
  }
  return false;
}

}  // namespace plumbline::validation
