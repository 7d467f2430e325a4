// The hopping controller behind the C interface: which number is which port.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "controllers/blocks/c_interface.h"
#include "controllers/controller.h"
#include "controllers/mabel_hopping/hopping.h"

namespace plumbline::controllers {
namespace {

constexpr double kNone = INFINITY;
constexpr double kTorque = 30.0;  // N m; torque_limit_mLA and _mLS may be less

constexpr plumbline_port kInputs[] = {
    {"mLA_left", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"mLS_left", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"thigh_left", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"knee_left", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"mLA_right", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"mLS_right", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"thigh_right", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"knee_right", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"torso", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"tower", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"boom_pitch", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"contact_left", "1", PLUMBLINE_SWITCH, 0.0, 1.0},
    {"contact_right", "1", PLUMBLINE_SWITCH, 0.0, 1.0},
};

constexpr plumbline_port kOutputs[] = {
    {"mLA_left", "N m", PLUMBLINE_VALUE, -kTorque, kTorque},
    {"mLS_left", "N m", PLUMBLINE_VALUE, -kTorque, kTorque},
    {"mLA_right", "N m", PLUMBLINE_VALUE, -kTorque, kTorque},
    {"mLS_right", "N m", PLUMBLINE_VALUE, -kTorque, kTorque},
};

constexpr plumbline_port kLog[] = {
    {"phase", "1", PLUMBLINE_VALUE, 1.0, 6.0},
    {"torso_wanted", "rad", PLUMBLINE_VALUE, -kNone, kNone},
    {"hip_velocity", "m/s", PLUMBLINE_VALUE, -kNone, kNone},
    {"LA_left", "rad", PLUMBLINE_VALUE, -kNone, kNone},
    {"LA_left_wanted", "rad", PLUMBLINE_VALUE, -kNone, kNone},
    {"LA_right", "rad", PLUMBLINE_VALUE, -kNone, kNone},
    {"LA_right_wanted", "rad", PLUMBLINE_VALUE, -kNone, kNone},
    {"mLS_left_wanted", "rad", PLUMBLINE_VALUE, -kNone, kNone},
    {"mLS_right_wanted", "rad", PLUMBLINE_VALUE, -kNone, kNone},
};

constexpr plumbline_port kMemory[] = {
    {"torso_wanted", "rad", PLUMBLINE_VALUE, -kNone, kNone},
    {"tower_at_landing", "rad", PLUMBLINE_VALUE, -kNone, kNone},
    {"landed", "1", PLUMBLINE_VALUE, 0.0, 1.0},
};

/// A constant and where it goes. HoppingConfig's own checks say what else it must be.
struct Constant {
  plumbline_port port;
  void (*set)(HoppingConfig& config, double value);
};

constexpr Constant number(const char* name, const char* unit, void (*set)(HoppingConfig&, double)) {
  return {{name, unit, PLUMBLINE_VALUE, -kNone, kNone}, set};
}
constexpr Constant ranged(const char* name, const char* unit, double lower, double upper,
                          void (*set)(HoppingConfig&, double)) {
  return {{name, unit, PLUMBLINE_VALUE, lower, upper}, set};
}

int whole(double value) {
  if (value != std::floor(value)) {
    throw std::invalid_argument("samples and orders of filters and switches must be whole numbers");
  }
  return static_cast<int>(value);
}

LegAngleSource source_of(double at_motor) {
  return at_motor != 0.0 ? LegAngleSource::motor : LegAngleSource::joints;
}

using Config = HoppingConfig;

constexpr Constant kList[] = {
    number("boom_length", "m", [](Config& c, double v) { c.boom_length = v; }),
    ranged("torque_limit_mLA", "N m", 0.0, kTorque, [](Config& c, double v) { c.torque_limit_mLA = v; }),
    ranged("torque_limit_mLS", "N m", 0.0, kTorque, [](Config& c, double v) { c.torque_limit_mLS = v; }),
    number("delta_LA", "rad", [](Config& c, double v) { c.parameters.delta_LA = v; }),
    number("h_T0", "rad", [](Config& c, double v) { c.parameters.h_T0 = v; }),
    number("h_LS_left", "rad", [](Config& c, double v) { c.parameters.h_LS_left = v; }),
    number("h_LS_right", "rad", [](Config& c, double v) { c.parameters.h_LS_right = v; }),
    number("delta_LS_minus_left", "rad", [](Config& c, double v) { c.parameters.delta_LS_minus_left = v; }),
    number("delta_LS_minus_right", "rad", [](Config& c, double v) { c.parameters.delta_LS_minus_right = v; }),
    number("delta_LS_plus_left", "rad", [](Config& c, double v) { c.parameters.delta_LS_plus_left = v; }),
    number("delta_LS_plus_right", "rad", [](Config& c, double v) { c.parameters.delta_LS_plus_right = v; }),
    number("gamma_LA_to_mLA", "1", [](Config& c, double v) { c.parameters.gamma_LA_to_mLA = v; }),
    number("gamma_LS_to_mLS", "1", [](Config& c, double v) { c.parameters.gamma_LS_to_mLS = v; }),
    number("hip_velocity_band", "m/s", [](Config& c, double v) { c.parameters.hip_velocity_band = v; }),
    number("retract_time", "s", [](Config& c, double v) { c.parameters.retract_time = v; }),
    ranged("event_update", "1", 0.0, 1.0, [](Config& c, double v) { c.parameters.event_update = v != 0.0; }),
    number("K_T", "1", [](Config& c, double v) { c.parameters.K_T = v; }),
    number("delta_phi_d", "rad", [](Config& c, double v) { c.parameters.delta_phi_d = v; }),
    number("delta_h_T_limit", "rad", [](Config& c, double v) { c.parameters.delta_h_T_limit = v; }),
    number("kp_LA_left", "N m/rad", [](Config& c, double v) { c.left.kp_LA = v; }),
    number("kd_LA_left", "N m s/rad", [](Config& c, double v) { c.left.kd_LA = v; }),
    number("kp_mLS_left", "N m/rad", [](Config& c, double v) { c.left.kp_mLS = v; }),
    number("kd_mLS_left", "N m s/rad", [](Config& c, double v) { c.left.kd_mLS = v; }),
    number("kp_LA_right", "N m/rad", [](Config& c, double v) { c.right.kp_LA = v; }),
    number("kd_LA_right", "N m s/rad", [](Config& c, double v) { c.right.kd_LA = v; }),
    number("kp_mLS_right", "N m/rad", [](Config& c, double v) { c.right.kp_mLS = v; }),
    number("kd_mLS_right", "N m s/rad", [](Config& c, double v) { c.right.kd_mLS = v; }),
    ranged("leg_angle_at_motor", "1", 0.0, 1.0, [](Config& c, double v) { c.leg_angle = source_of(v); }),
    ranged("leg_angle_rate_at_motor", "1", 0.0, 1.0,
           [](Config& c, double v) { c.leg_angle_rate = source_of(v); }),
    ranged("leg_angle_samples", "1", 2.0, 32.0,
           [](Config& c, double v) { c.leg_angle_filter.samples = whole(v); }),
    ranged("leg_angle_order", "1", 1.0, 2.0,
           [](Config& c, double v) { c.leg_angle_filter.order = whole(v); }),
    number("leg_angle_time_constant", "s", [](Config& c, double v) { c.leg_angle_filter.time_constant = v; }),
    ranged("leg_shape_samples", "1", 2.0, 32.0,
           [](Config& c, double v) { c.leg_shape_filter.samples = whole(v); }),
    ranged("leg_shape_order", "1", 1.0, 2.0,
           [](Config& c, double v) { c.leg_shape_filter.order = whole(v); }),
    number("leg_shape_time_constant", "s", [](Config& c, double v) { c.leg_shape_filter.time_constant = v; }),
    ranged("hip_samples", "1", 2.0, 32.0, [](Config& c, double v) { c.hip_filter.samples = whole(v); }),
    ranged("hip_order", "1", 1.0, 2.0, [](Config& c, double v) { c.hip_filter.order = whole(v); }),
    number("hip_time_constant", "s", [](Config& c, double v) { c.hip_filter.time_constant = v; }),
    ranged("contact_samples", "1", 1.0, 1e6,
           [](Config& c, double v) { c.supplements.contact_samples = whole(v); }),
    number("touchdown_time_min", "s", [](Config& c, double v) { c.supplements.touchdown_time_min = v; }),
    number("bounce_time", "s", [](Config& c, double v) { c.supplements.bounce_time = v; }),
    number("kickoff_time_max", "s", [](Config& c, double v) { c.supplements.kickoff_time_max = v; }),
    number("liftoff_time_max", "s", [](Config& c, double v) { c.supplements.liftoff_time_max = v; }),
    number("leg_angle_from", "rad", [](Config& c, double v) { c.workspace.leg_angle_from = v; }),
    number("leg_angle_to", "rad", [](Config& c, double v) { c.workspace.leg_angle_to = v; }),
    number("leg_shape_from", "rad", [](Config& c, double v) { c.workspace.leg_shape_from = v; }),
    number("leg_shape_to", "rad", [](Config& c, double v) { c.workspace.leg_shape_to = v; }),
};

constexpr std::size_t kCount = sizeof kList / sizeof kList[0];

constexpr std::array<plumbline_port, kCount> constant_ports() {
  std::array<plumbline_port, kCount> ports{};
  for (std::size_t k = 0; k < kCount; ++k) {
    ports[k] = kList[k].port;
  }
  return ports;
}
constexpr std::array<plumbline_port, kCount> kConstants = constant_ports();

HoppingConfig config_of(const plumbline_setup& setup) {
  HoppingConfig config;
  config.period = setup.period;
  for (std::size_t k = 0; k < kCount; ++k) {
    kList[k].set(config, setup.constants[k]);
  }
  // Both legs carry the same encoders. Where they do not, the left one's would be taken for the right one.
  for (std::size_t k = 0; k < 4; ++k) {
    if (setup.input_scales[k] != setup.input_scales[k + 4]) {
      throw std::invalid_argument(std::string("encoder ") + kInputs[k + 4].name +
                                  ": another resolution than the other leg's, expected the same");
    }
  }
  const double* scale = setup.input_scales;
  config.resolution = {scale[0], scale[1], scale[2], scale[3], scale[8], scale[9], scale[10]};
  return config;
}

class HoppingPorts {
 public:
  explicit HoppingPorts(const plumbline_setup& setup)
      : hopping_(config_of(setup)), tower_resolution_(setup.input_scales[9]) {}

  void reset() noexcept { hopping_.reset(); }

  int step(const double* in, double* out, double* log) noexcept {
    const HoppingTorques torques = hopping_.command(sample_of(in));
    out[0] = torques.mLA_left;
    out[1] = torques.mLS_left;
    out[2] = torques.mLA_right;
    out[3] = torques.mLS_right;
    if (log != nullptr) {
      write(log);
    }
    return static_cast<int>(hopping_.power_off());
  }

  static const char* fault(int code) noexcept {
    switch (static_cast<StopSwitch>(code)) {
      case StopSwitch::none:
        return "none";
      case StopSwitch::leg_angle_left:
        return "the switch of a hard stop closed (leg angle, left), power off";
      case StopSwitch::leg_shape_left:
        return "the switch of a hard stop closed (leg shape, left), power off";
      case StopSwitch::leg_angle_right:
        return "the switch of a hard stop closed (leg angle, right), power off";
      case StopSwitch::leg_shape_right:
        return "the switch of a hard stop closed (leg shape, right), power off";
    }
    return "unknown";
  }

  void get_memory(double* memory) const noexcept {
    memory[0] = hopping_.h_T_d();
    memory[1] = static_cast<double>(hopping_.tower_at_landing()) * tower_resolution_;
    memory[2] = hopping_.landed() ? 1.0 : 0.0;
  }
  void set_memory(const double* memory) noexcept {
    hopping_.remember(memory[0], std::llround(memory[1] / tower_resolution_), memory[2] != 0.0);
  }

 private:
  static LegCounts leg_of(const double* in) noexcept {
    return {std::llround(in[0]), std::llround(in[1]), std::llround(in[2]), std::llround(in[3])};
  }
  static HoppingSample sample_of(const double* in) noexcept {
    HoppingSample sample;
    sample.left = leg_of(in);
    sample.right = leg_of(in + 4);
    sample.torso = std::llround(in[8]);
    sample.tower = std::llround(in[9]);
    sample.boom_pitch = std::llround(in[10]);
    sample.left_contact = in[11] != 0.0;
    sample.right_contact = in[12] != 0.0;
    return sample;
  }
  void write(double* log) const noexcept {
    log[0] = static_cast<double>(hopping_.phase());
    log[1] = hopping_.h_T_d();
    log[2] = hopping_.hip_velocity();
    log[3] = hopping_.controlled().LA_left;
    log[4] = hopping_.reference().LA_left;
    log[5] = hopping_.controlled().LA_right;
    log[6] = hopping_.reference().LA_right;
    log[7] = hopping_.reference().mLS_left;
    log[8] = hopping_.reference().mLS_right;
  }

  Hopping hopping_;
  double tower_resolution_;
};

constexpr plumbline_controller_api kApi =
    CFunctions<HoppingPorts>::api("mabel_hopping", "1", ports(kInputs), ports(kOutputs),
                                  Ports<kCount>{kConstants.data()}, ports(kLog), ports(kMemory));

}  // namespace
}  // namespace plumbline::controllers

extern "C" const plumbline_controller_api* plumbline_controller() { return &plumbline::controllers::kApi; }
