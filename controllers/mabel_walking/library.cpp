// The walking controller behind the C interface: which number is which port.
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "controllers/controller.h"
#include "controllers/mabel_walking/walking.h"

namespace plumbline::controllers {
namespace {

constexpr double kNone = INFINITY;
constexpr double kTorque = 60.0;  // N m; torque_limit_mLA and _mLS may be less

constexpr plumbline_port kInputs[] = {
    {"mLA_left", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"mLS_left", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"bsp_left", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"thigh_left", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"knee_left", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"mLA_right", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"mLS_right", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"bsp_right", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"thigh_right", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"knee_right", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"torso", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"contact_left", "1", PLUMBLINE_SWITCH, 0.0, 1.0},
    {"contact_right", "1", PLUMBLINE_SWITCH, 0.0, 1.0},
};
constexpr std::size_t kInputCount = sizeof kInputs / sizeof kInputs[0];

constexpr plumbline_port kOutputs[] = {
    {"mLA_left", "N m", PLUMBLINE_VALUE, -kTorque, kTorque},
    {"mLS_left", "N m", PLUMBLINE_VALUE, -kTorque, kTorque},
    {"mLA_right", "N m", PLUMBLINE_VALUE, -kTorque, kTorque},
    {"mLS_right", "N m", PLUMBLINE_VALUE, -kTorque, kTorque},
};

constexpr plumbline_port kLog[] = {
    {"phase", "1", PLUMBLINE_VALUE, 0.0, 3.0},
    {"right_stance", "1", PLUMBLINE_VALUE, 0.0, 1.0},
    {"theta", "rad", PLUMBLINE_VALUE, -kNone, kNone},
    {"y_stance_shape", "rad", PLUMBLINE_VALUE, -kNone, kNone},
    {"y_swing_angle", "rad", PLUMBLINE_VALUE, -kNone, kNone},
    {"y_swing_shape", "rad", PLUMBLINE_VALUE, -kNone, kNone},
    {"y_torso", "rad", PLUMBLINE_VALUE, -kNone, kNone},
    {"steps", "1", PLUMBLINE_VALUE, 0.0, kNone},
    {"step_down", "m", PLUMBLINE_VALUE, -kNone, kNone},
    {"absorbing", "1", PLUMBLINE_VALUE, 0.0, 1.0},
};

constexpr plumbline_port kMemory[] = {{"right_stance", "1", PLUMBLINE_VALUE, 0.0, 1.0}};

std::vector<GaitNumber> numbers_of(WalkConstants& c) {
  std::vector<GaitNumber> numbers = controllers::numbers_of(c.gait);
  const char* const outputs[] = {"stance_shape", "swing_angle", "swing_shape", "torso"};
  for (std::size_t i = 0; i < 4; ++i) {
    numbers.push_back({std::string("kp_") + outputs[i], "N m/rad", &c.kp[i]});
    numbers.push_back({std::string("kd_") + outputs[i], "N m s/rad", &c.kd[i]});
  }
  numbers.insert(numbers.end(), {{"angle_ratio", "1", &c.angle_ratio},
                                 {"torque_limit_mLA", "N m", &c.limit_mLA},
                                 {"torque_limit_mLS", "N m", &c.limit_mLS},
                                 {"rate_samples", "1", &c.rate_samples},
                                 {"latest_sc", "rad", &c.latest_sc},
                                 {"touchdown_from", "1", &c.touchdown_from},
                                 {"first_stance", "1", &c.first_stance},
                                 {"leg_angle_from", "rad", &c.angle_from},
                                 {"leg_angle_to", "rad", &c.angle_to},
                                 {"leg_shape_from", "rad", &c.shape_from},
                                 {"leg_shape_to", "rad", &c.shape_to},
                                 {"absorb", "1", &c.absorb},
                                 {"absorb_from", "m", &c.absorb_from},
                                 {"absorb_kp", "N m/rad", &c.absorb_kp},
                                 {"absorb_kd", "N m s/rad", &c.absorb_kd},
                                 {"absorb_rest", "rad", &c.absorb_rest}});
  for (std::size_t k = 0; k < 6; ++k) {
    numbers.push_back({"absorb_torso_" + std::to_string(k), "rad", &c.absorb_torso.alpha[k]});
  }
  return numbers;
}

/// The constants' ports, with the texts that they point to.
struct ConstantPorts {
  ConstantPorts() {
    WalkConstants nowhere;
    for (const GaitNumber& number : numbers_of(nowhere)) {
      names.push_back(number.name);
      units.push_back(number.unit);
    }
    for (std::size_t k = 0; k < names.size(); ++k) {
      ports.push_back({names[k].c_str(), units[k], PLUMBLINE_VALUE, -kNone, kNone});
    }
  }
  std::vector<std::string> names;
  std::vector<const char*> units;
  std::vector<plumbline_port> ports;
};

const ConstantPorts& constant_ports() {
  static const ConstantPorts ports;
  return ports;
}

struct Self {
  explicit Self(const plumbline_setup& setup, const WalkConstants& constants)
      : walking(constants, setup.period) {
    for (std::size_t i = 0; i < kInputCount; ++i) scales[i] = setup.input_scales[i];
  }
  Walking walking;
  double scales[kInputCount];
};

void* create(const plumbline_setup* setup, char* message, std::size_t size) {
  try {
    WalkConstants constants;
    std::vector<GaitNumber> numbers = numbers_of(constants);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      *numbers[k].value = setup->constants[k];
    }
    return new Self(*setup, constants);
  } catch (const std::exception& error) {
    std::snprintf(message, size, "%s", error.what());
  }
  return nullptr;
}

Self* of(void* self) noexcept { return static_cast<Self*>(self); }

void reset(void* self) { of(self)->walking.reset(); }

int step(void* self, const double* in, double* out, double* log) {
  double q[kInputCount];
  for (std::size_t i = 0; i < kInputCount; ++i) q[i] = in[i] * of(self)->scales[i];
  const auto leg = [&](std::size_t first, std::size_t contact) {
    return WalkLegReading{q[first],     q[first + 1], q[first + 2],
                          q[first + 3], q[first + 4], in[contact] != 0.0};
  };
  Walking& walking = of(self)->walking;
  const WalkTorques torques = walking.step({leg(0, 11), leg(5, 12), q[10]});
  for (std::size_t m = 0; m < 4; ++m) out[m] = torques[m];
  const Walking::State& now = walking.state();
  if (log != nullptr) {
    log[0] = static_cast<double>(now.phase);
    log[1] = now.right_stance ? 1.0 : 0.0;
    log[2] = now.theta;
    for (std::size_t i = 0; i < 4; ++i) log[3 + i] = now.y[i];
    log[7] = now.steps;
    log[8] = now.height;
    log[9] = now.absorbing ? 1.0 : 0.0;
  }
  return static_cast<int>(now.fault);
}

const char* fault(int code) { return to_string(static_cast<WalkFault>(code)); }

void get_memory(const void* self, double* memory) {
  memory[0] = static_cast<const Self*>(self)->walking.state().right_stance ? 1.0 : 0.0;
}
void set_memory(void* self, const double* memory) { of(self)->walking.set_stance(memory[0] != 0.0); }
void destroy(void* self) { delete of(self); }

template <std::size_t N>
constexpr std::uint32_t count(const plumbline_port (&)[N]) {
  return static_cast<std::uint32_t>(N);
}

}  // namespace

const plumbline_controller_api* walking_api() {
  static const plumbline_controller_api api = {PLUMBLINE_CONTROLLER_INTERFACE,
                                               "mabel_walking",
                                               "1",
                                               kInputs,
                                               count(kInputs),
                                               kOutputs,
                                               count(kOutputs),
                                               constant_ports().ports.data(),
                                               static_cast<std::uint32_t>(constant_ports().ports.size()),
                                               kLog,
                                               count(kLog),
                                               kMemory,
                                               count(kMemory),
                                               &create,
                                               &reset,
                                               &step,
                                               &fault,
                                               &get_memory,
                                               &set_memory,
                                               &destroy};
  return &api;
}

}  // namespace plumbline::controllers

extern "C" const plumbline_controller_api* plumbline_controller() {
  return plumbline::controllers::walking_api();
}
