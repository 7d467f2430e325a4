#include "validation/studies/aslip/aslip.h"

#include <cmath>
#include <stdexcept>

namespace plumbline::validation {
namespace {

using Vector = std::array<double, 6>;

constexpr double kLongestPhase = 1.0;  // s; a stance or flight that lasts longer has no end

struct Forces {
  double leg_force = 0.0, actuator_force = 0.0, hip_torque = 0.0;
  Vector rate{};
};

Vector as_vector(const AslipState& s) { return {s.x, s.y, s.pitch, s.x_rate, s.y_rate, s.pitch_rate}; }
AslipState as_state(const Vector& v) { return {v[0], v[1], v[2], v[3], v[4], v[5]}; }

Vector moved(const Vector& from, const Vector& rate, double time) {
  Vector to = from;
  for (std::size_t i = 0; i < to.size(); ++i) {
    to[i] += time * rate[i];
  }
  return to;
}

/// Stance with the toe at x = 0. The leg has no mass: the ground's force is u1 along it and u2/l across it.
Forces forces(const AslipModel& p, const SlipEmbedding& c, const Vector& s) {
  const double pitch = s[2], pitch_rate = s[5], L = p.hip_to_com;
  const double hip_x = s[0] - L * std::cos(pitch), hip_y = s[1] - L * std::sin(pitch);
  const double hip_x_rate = s[3] + L * std::sin(pitch) * pitch_rate;
  const double hip_y_rate = s[4] - L * std::cos(pitch) * pitch_rate;
  const double l = std::hypot(hip_x, hip_y), lean = std::atan2(-hip_x, hip_y), phi = lean - pitch;
  const double l_rate = (hip_x * hip_x_rate + hip_y * hip_y_rate) / l;
  const double phi_rate = -(hip_x_rate * std::cos(lean) + hip_y_rate * std::sin(lean)) / l - pitch_rate;

  // Equations 55 to 57, 60 with l, phi and their rates for z1 to z4, and the actual pitch. On the zero
  // dynamics this is the same as equations 39, 40 say; off it the paper's own curves (Figure 6) show that
  // this was meant.
  const double r = std::sqrt(L * L + l * l - 2.0 * L * l * std::sin(phi));
  const double r_rate = (l - L * std::sin(phi)) / r * l_rate - L * l * std::cos(phi) / r * phi_rate;
  const double height = l * std::cos(phi + pitch) + L * std::sin(pitch);
  const double energy = 0.5 * p.mass * (l_rate * l_rate + l * l * phi_rate * phi_rate) +
                        p.mass * p.gravity * height +
                        0.5 * c.stiffness * std::pow(c.radius + c.pretension - r, 2);

  Forces f;
  const double target =
      c.stiffness * (c.radius + c.pretension - r) - c.energy_gain * r_rate * (energy - c.energy);
  f.leg_force = (l - L * std::sin(phi)) / r * target;                         // equation 58
  f.actuator_force = f.leg_force - p.spring_stiffness * (p.spring_rest - l);  // equation 76
  const double by_leg = -L * std::cos(phi) / p.inertia,
               by_hip = (L * std::sin(phi) - l) / (p.inertia * l);  // 34
  const double wanted = -c.pitch_gain * (pitch - c.pitch) / (c.epsilon * c.epsilon) -
                        c.pitch_rate_gain * pitch_rate / c.epsilon;  // equation 42
  f.hip_torque = (wanted - by_leg * f.leg_force) / by_hip;           // equation 41

  const double force_x = -std::sin(lean) * f.leg_force - std::cos(lean) * f.hip_torque / l;
  const double force_y = std::cos(lean) * f.leg_force - std::sin(lean) * f.hip_torque / l;
  const double moment = -f.hip_torque - L * (std::cos(pitch) * force_y - std::sin(pitch) * force_x);
  f.rate = {s[3], s[4], s[5], force_x / p.mass, force_y / p.mass - p.gravity, moment / p.inertia};
  return f;
}

Vector stepped(const AslipModel& p, const SlipEmbedding& c, const Vector& s, double step) {
  const Vector k1 = forces(p, c, s).rate;
  const Vector k2 = forces(p, c, moved(s, k1, 0.5 * step)).rate;
  const Vector k3 = forces(p, c, moved(s, k2, 0.5 * step)).rate;
  const Vector k4 = forces(p, c, moved(s, k3, step)).rate;
  Vector to = s;
  for (std::size_t i = 0; i < to.size(); ++i) {
    to[i] += step / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
  }
  return to;
}

class Runner {
 public:
  Runner(const AslipModel& model, const SlipEmbedding& control, double step)
      : model_(model), control_(control), step_(step) {}

  /// Equations 64, 72, 73. False: the toe does not come down.
  bool fly(AslipState& state, double& toe, double& time) {
    const double psi = control_.touchdown + control_.speed_gain * (state.x_rate - control_.speed);
    const double toe_ahead = control_.radius * std::sin(psi), height = control_.radius * std::cos(psi);
    // The pitch turns on while the leg is set for what it will be: the line from centre of mass to toe is
    // held, so that the height at touchdown depends on psi alone.
    const double fall = state.y_rate * state.y_rate + 2.0 * model_.gravity * (state.y - height);
    if (fall < 0.0) {
      return false;
    }
    const double duration = (state.y_rate + std::sqrt(fall)) / model_.gravity;
    constexpr int kSamples = 60;
    for (int i = 0; i < kSamples; ++i) {
      record(time + duration * i / kSamples, flown(state, duration * i / kSamples), nullptr);
    }
    state = flown(state, duration);
    time += duration;
    toe = state.x + toe_ahead;
    return duration > 0.0 && duration < kLongestPhase;
  }

  bool stand(AslipState& state, double toe, double& time) {
    state.x -= toe;
    Vector now = as_vector(state);
    const double end = time + kLongestPhase;
    while (time < end) {
      const Forces f = forces(model_, control_, now);
      AslipState shown = as_state(now);
      shown.x += toe;
      record(time, shown, &f);
      Vector next = stepped(model_, control_, now, step_);
      double taken = step_;
      if (std::hypot(next[0], next[1]) >= control_.radius && next[0] * next[3] + next[1] * next[4] > 0.0) {
        taken = last_step(now);
        state = as_state(stepped(model_, control_, now, taken));
        time += taken;
        const Forces last = forces(model_, control_, as_vector(state));
        state.x += toe;
        record(time, state, &last);
        return true;
      }
      if (next[1] < model_.hip_to_com) {
        return false;
      }
      now = next;
      time += taken;
    }
    return false;
  }

  AslipRun run;

 private:
  AslipState flown(const AslipState& s, double t) const {
    return {s.x + s.x_rate * t,
            s.y + s.y_rate * t - 0.5 * model_.gravity * t * t,
            s.pitch + s.pitch_rate * t,
            s.x_rate,
            s.y_rate - model_.gravity * t,
            s.pitch_rate};
  }

  double last_step(const Vector& from) const {
    double below = 0.0, above = step_;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (below + above);
      const Vector there = stepped(model_, control_, from, middle);
      (std::hypot(there[0], there[1]) < control_.radius ? below : above) = middle;
    }
    return above;
  }

  void record(double time, const AslipState& state, const Forces* f) {
    AslipSample sample{time, state, f != nullptr, 0.0, 0.0, 0.0};
    if (f != nullptr) {
      sample.leg_force = f->leg_force;
      sample.actuator_force = f->actuator_force;
      sample.hip_torque = f->hip_torque;
    }
    run.samples.push_back(sample);
  }

  const AslipModel& model_;
  const SlipEmbedding& control_;
  double step_;
};

}  // namespace

AslipRun run_aslip(const AslipModel& model, const SlipEmbedding& control, const AslipState& start,
                   int strides, const AslipPush& push, double step) {
  Runner runner(model, control, step);
  AslipState state = start;
  double time = 0.0, toe = 0.0;
  for (int stride = 0; stride < strides; ++stride) {
    if (stride == push.liftoff) {
      // The hip stays where it is.
      state.x += model.hip_to_com * (std::cos(state.pitch + push.pitch) - std::cos(state.pitch));
      state.y += model.hip_to_com * (std::sin(state.pitch + push.pitch) - std::sin(state.pitch));
      state.pitch += push.pitch;
      state.x_rate += push.x_rate;
    }
    runner.run.liftoffs.push_back(time);
    if (!runner.fly(state, toe, time)) {
      runner.run.fell = true;
      break;
    }
    runner.run.touchdowns.push_back(time);
    if (!runner.stand(state, toe, time)) {
      runner.run.fell = true;
      break;
    }
  }
  return runner.run;
}

AslipOrbit find_aslip_orbit(const AslipModel& model, const AslipReadings& readings, SlipEmbedding gains) {
  AslipOrbit orbit;
  SlipEmbedding& c = orbit.control;
  c = gains;
  c.pitch = readings.pitch;
  c.speed = readings.speed;
  const double hip_x = -readings.half_travel - model.hip_to_com * std::cos(readings.pitch);
  const double hip_y = std::sqrt(model.leg_length * model.leg_length - hip_x * hip_x);
  const double y = hip_y + model.hip_to_com * std::sin(readings.pitch),
               y_rate = 0.5 * model.gravity * readings.flight;
  c.radius = std::hypot(readings.half_travel, y);
  c.touchdown = std::atan2(readings.half_travel, y);
  // u1 = (l - L sin phi)/r F, and F = k Delta r at touchdown.
  const double phi = std::atan2(-hip_x, hip_y) - readings.pitch;
  const double target_force =
      readings.touchdown_force * c.radius / (model.leg_length - model.hip_to_com * std::sin(phi));
  orbit.liftoff = {readings.half_travel, y, readings.pitch, readings.speed, y_rate, 0.0};

  const auto asymmetry = [&](double stiffness) {
    c.stiffness = stiffness;
    c.pretension = target_force / stiffness;
    c.energy = 0.5 * model.mass * (readings.speed * readings.speed + y_rate * y_rate) +
               model.mass * model.gravity * y + 0.5 * stiffness * c.pretension * c.pretension;
    const AslipRun run = run_aslip(model, c, orbit.liftoff, 1);
    if (run.fell) {
      throw std::runtime_error("no lift-off on the way to the orbit of the ASLIP");
    }
    return run.samples.back().state.y_rate - y_rate;
  };
  // A softer leg lifts off later, when the torso has already gone past: it rises less there.
  double soft = 0.6 * model.spring_stiffness, stiff = 1.6 * model.spring_stiffness;
  const bool rising = asymmetry(stiff) > 0.0;
  if (rising == (asymmetry(soft) > 0.0)) {
    throw std::runtime_error("no periodic orbit of the ASLIP has these readings");
  }
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (soft + stiff);
    ((asymmetry(middle) > 0.0) == rising ? stiff : soft) = middle;
  }
  asymmetry(0.5 * (soft + stiff));
  return orbit;
}

}  // namespace plumbline::validation
