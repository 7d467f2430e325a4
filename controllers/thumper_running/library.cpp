// The running controller behind the C interface: which number is which port.
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "controllers/blocks/c_interface.h"
#include "controllers/controller.h"
#include "controllers/monopod/sampled.h"

namespace plumbline::controllers {
namespace {

constexpr double kNone = INFINITY;
constexpr double kTorque = 100.0;  // N m; the constants leg_angle_torque and leg_shape_torque may be less

constexpr plumbline_port kInputs[] = {
    {"mLS", "rad", PLUMBLINE_COUNT, -kNone, kNone},  {"thigh", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"knee", "rad", PLUMBLINE_COUNT, -kNone, kNone}, {"torso", "rad", PLUMBLINE_COUNT, -kNone, kNone},
    {"hip_x", "m", PLUMBLINE_COUNT, -kNone, kNone},  {"hip_z", "m", PLUMBLINE_COUNT, -kNone, kNone},
    {"contact", "1", PLUMBLINE_SWITCH, 0.0, 1.0},
};

constexpr plumbline_port kOutputs[] = {
    {"mLA", "N m", PLUMBLINE_VALUE, -kTorque, kTorque},
    {"mLS", "N m", PLUMBLINE_VALUE, -kTorque, kTorque},
};

// Controlled: torso and leg-shape motor in stance, centre of mass ahead of the toe and leg shape in flight.
constexpr plumbline_port kLog[] = {
    {"phase", "1", PLUMBLINE_VALUE, 0.0, 3.0},
    {"first_wanted", "1", PLUMBLINE_VALUE, -kNone, kNone},
    {"first_error", "1", PLUMBLINE_VALUE, -kNone, kNone},
    {"second_wanted", "rad", PLUMBLINE_VALUE, -kNone, kNone},
    {"second_error", "rad", PLUMBLINE_VALUE, -kNone, kNone},
    {"beta_torso", "rad", PLUMBLINE_VALUE, -kNone, kNone},
    {"beta_motor", "rad", PLUMBLINE_VALUE, -kNone, kNone},
    {"beta_toe", "m", PLUMBLINE_VALUE, -kNone, kNone},
};

constexpr plumbline_port kMemory[] = {
    {"beta_torso", "rad", PLUMBLINE_VALUE, -kNone, kNone},
    {"beta_motor", "rad", PLUMBLINE_VALUE, -kNone, kNone},
    {"beta_toe", "m", PLUMBLINE_VALUE, -kNone, kNone},
};

constexpr std::array<plumbline_port, monopod::kParameterCount> constant_ports() {
  std::array<plumbline_port, monopod::kParameterCount> ports{};
  for (std::size_t i = 0; i < ports.size(); ++i) {
    ports[i] = {monopod::kParameters[i].name, monopod::kParameters[i].unit, PLUMBLINE_VALUE, -kNone, kNone};
  }
  return ports;
}
constexpr std::array<plumbline_port, monopod::kParameterCount> kConstants = constant_ports();

void require(bool holds, const char* message) {
  if (!holds) {
    throw std::invalid_argument(message);
  }
}

monopod::Parameters parameters_of(const plumbline_setup& setup) {
  monopod::Parameters p;
  const auto all = monopod::slots(p);
  for (std::size_t i = 0; i < all.size(); ++i) {
    *all[i] = setup.constants[i];
  }
  const monopod::Constants& c = p.model;
  require(c.torso.mass > 0.0 && c.thigh.mass > 0.0 && c.shin.mass > 0.0,
          "a mass that is not positive, expected kg");
  require(c.torso.inertia > 0.0 && c.thigh.inertia > 0.0 && c.shin.inertia > 0.0,
          "an inertia that is not positive, expected kg m^2");
  require(c.angle_ratio != 0.0 && c.shape_ratio != 0.0, "a ratio of 0, expected another number");
  require(c.shape_inertia > 0.0, "leg_shape_inertia that is not positive, expected kg m^2");
  require(p.gait.epsilon > 0.0, "epsilon that is not positive, expected more than 0");
  for (const double share : {p.position_share, p.rate_share}) {
    require(share > 0.0 && share <= 1.0,
            "position_share or rate_share outside its range, expected above 0 and up to 1");
  }
  for (const double limit : {p.angle_torque, p.shape_torque}) {
    require(limit > 0.0 && limit <= kTorque,
            "a torque limit outside its range, expected above 0 and up to 100 N m");
  }
  return p;
}

class RunningPorts {
 public:
  explicit RunningPorts(const plumbline_setup& setup) : running_(parameters_of(setup), setup.period) {
    for (std::size_t i = 0; i < scales_.size(); ++i) {
      scales_[i] = setup.input_scales[i];
    }
  }

  void reset() noexcept { running_.reset(); }

  int step(const double* in, double* out, double* log) noexcept {
    monopod::Sample sample;
    double* const positions[] = {&sample.motor, &sample.thigh, &sample.knee,
                                 &sample.torso, &sample.hip_x, &sample.hip_z};
    for (std::size_t i = 0; i < 6; ++i) {
      *positions[i] = in[i] * scales_[i];
    }
    sample.contact = in[6] != 0.0;
    const monopod::Vector2 torque = running_.step(sample);
    out[0] = torque[0];
    out[1] = torque[1];
    if (log != nullptr) {
      const monopod::Running& r = running_.running();
      log[0] = static_cast<double>(r.phase());
      log[1] = r.wanted()[0];
      log[2] = r.output()[0];
      log[3] = r.wanted()[1];
      log[4] = r.output()[1];
      get_memory(log + 5);
    }
    return running_.fault();
  }

  static const char* fault(int code) noexcept {
    switch (code) {
      case monopod::SampledRunning::kNone:
        return "none";
      case monopod::SampledRunning::kTorsoFell:
        return "the torso has fallen over, power off";
      case monopod::SampledRunning::kLegFolded:
        return "the leg has folded, power off";
      default:
        return "unknown";
    }
  }

  void get_memory(double* memory) const noexcept {
    for (int i = 0; i < 3; ++i) {
      memory[i] = running_.running().beta()[i];
    }
  }
  void set_memory(const double* memory) noexcept {
    running_.running().set_beta({memory[0], memory[1], memory[2]});
  }

 private:
  monopod::SampledRunning running_;
  std::array<double, 7> scales_{};
};

constexpr plumbline_controller_api kApi = CFunctions<RunningPorts>::api(
    "thumper_running", "1", ports(kInputs), ports(kOutputs),
    Ports<monopod::kParameterCount>{kConstants.data()}, ports(kLog), ports(kMemory));

}  // namespace
}  // namespace plumbline::controllers

extern "C" const plumbline_controller_api* plumbline_controller() { return &plumbline::controllers::kApi; }
