// The running controller behind the C interface: which number is which port.
#include <cmath>
#include <cstddef>
#include <vector>

#include "controllers/atrias_running/running.h"
#include "controllers/blocks/c_interface.h"
#include "controllers/controller.h"

namespace plumbline::controllers::atrias {
namespace {

constexpr double kNone = INFINITY;
constexpr double kCurrent = 200.0;  // A; current_limit may be less

constexpr plumbline_port count_of(const char* name) { return {name, "rad", PLUMBLINE_COUNT, -kNone, kNone}; }
constexpr plumbline_port number(const char* name, const char* unit) {
  return {name, unit, PLUMBLINE_VALUE, -kNone, kNone};
}

constexpr plumbline_port kInputs[] = {
    count_of("thigh_motor_left"),  count_of("thigh_left"),        count_of("shin_motor_left"),
    count_of("shin_left"),         count_of("thigh_motor_right"), count_of("thigh_right"),
    count_of("shin_motor_right"),  count_of("shin_right"),        count_of("trunk"),
    number("speed_wanted", "m/s"),
};
constexpr std::size_t kInputCount = sizeof kInputs / sizeof kInputs[0];

constexpr plumbline_port kOutputs[] = {
    {"thigh_motor_left", "A", PLUMBLINE_VALUE, -kCurrent, kCurrent},
    {"shin_motor_left", "A", PLUMBLINE_VALUE, -kCurrent, kCurrent},
    {"thigh_motor_right", "A", PLUMBLINE_VALUE, -kCurrent, kCurrent},
    {"shin_motor_right", "A", PLUMBLINE_VALUE, -kCurrent, kCurrent},
};

struct LogEntry {
  plumbline_port port;
  double (*of)(const Running& running);
};
using S = const Running&;
constexpr LogEntry kLogged[] = {
    {number("phase", "1"), [](S r) { return r.state().stance ? 1.0 : 0.0; }},
    {number("leg", "1"), [](S r) { return static_cast<double>(r.state().leg); }},
    {number("steps", "1"), [](S r) { return r.state().steps; }},
    {number("speed_wanted", "m/s"), [](S r) { return r.state().wanted; }},
    {number("steps_since_change", "1"), [](S r) { return r.state().since_change; }},
    {number("flight_speed", "m/s"), [](S r) { return r.state().flight_speed; }},
    {number("speed_missed", "m/s"), [](S r) { return std::abs(r.state().speed_missed); }},
    {number("speed_missed_first", "m/s"), [](S r) { return r.state().missed_first; }},
    {number("apex_missed", "m"), [](S r) { return std::abs(r.state().apex - r.apex_wanted()); }},
    {number("apex", "m"), [](S r) { return r.state().apex; }},
    {number("placement_wanted", "m"), [](S r) { return r.state().placement; }},
    {number("placement", "m"), [](S r) { return r.state().placed; }},
    {number("x", "m"), [](S r) { return r.along().position(); }},
    {number("x_rate", "m/s"), [](S r) { return r.along().rate(); }},
    {number("z", "m"), [](S r) { return r.up().position(); }},
    {number("z_rate", "m/s"), [](S r) { return r.up().rate(); }},
    {number("lean", "rad"), [](S r) { return r.lean(); }},
    {number("x_planned", "m"), [](S r) { return r.state().plan.x; }},
    {number("z_planned", "m"), [](S r) { return r.state().plan.z; }},
    {number("force_x_wanted", "N"), [](S r) { return r.state().force.first; }},
    {number("force_z_wanted", "N"), [](S r) { return r.state().force.second; }},
    {number("force_x_shown", "N"), [](S r) { return r.state().shown[r.state().leg].first; }},
    {number("force_z_shown", "N"), [](S r) { return r.state().shown[r.state().leg].second; }},
    {number("mean_x_error", "m"), [](S r) { return r.state().means.x; }},
    {number("mean_z_error", "m"), [](S r) { return r.state().means.z; }},
    {number("mean_lean", "rad"), [](S r) { return r.state().means.lean; }},
    {number("mean_force_change", "N"), [](S r) { return r.state().means.force; }},
    {number("mean_force_error", "N"), [](S r) { return r.state().means.force_missed; }},
    {number("mean_torque_error", "N m"), [](S r) { return r.state().means.torque_missed; }},
    {number("peak_force", "N"), [](S r) { return r.state().peak; }},
};
constexpr std::size_t kLogCount = sizeof kLogged / sizeof kLogged[0];

constexpr plumbline_port kMemory[] = {{"leg", "1", PLUMBLINE_VALUE, 0.0, 1.0}};

/// A constant and where it goes.
struct Constant {
  plumbline_port port;
  double* (*in)(RunningNumbers& numbers);
};
using N = RunningNumbers&;
constexpr plumbline_port yes_or_no(const char* name) { return {name, "1", PLUMBLINE_VALUE, 0.0, 1.0}; }

constexpr Constant kConstants[] = {
    {number("mass", "kg"), [](N n) { return &n.gait.mass; }},
    {number("gravity", "m/s^2"), [](N n) { return &n.gait.gravity; }},
    {number("inertia", "kg m^2"), [](N n) { return &n.gait.inertia; }},
    {number("stiffness", "N/m"), [](N n) { return &n.gait.stiffness; }},
    {number("landing", "m"), [](N n) { return &n.gait.landing; }},
    {number("hop", "m"), [](N n) { return &n.gait.hop; }},
    {number("reach", "m"), [](N n) { return &n.gait.reach; }},
    {number("q_z", "1/m^2"), [](N n) { return &n.design.q_z; }},
    {number("q_z_rate", "s^2/m^2"), [](N n) { return &n.design.q_z_rate; }},
    {number("r_z", "1/N^2"), [](N n) { return &n.design.r_z; }},
    {number("q_x", "1/m^2"), [](N n) { return &n.design.q[0]; }},
    {number("q_x_rate", "s^2/m^2"), [](N n) { return &n.design.q[1]; }},
    {number("q_lean", "1/rad^2"), [](N n) { return &n.design.q[2]; }},
    {number("q_lean_rate", "s^2/rad^2"), [](N n) { return &n.design.q[3]; }},
    {number("h_lean", "s/rad^2"), [](N n) { return &n.design.h[2]; }},
    {number("h_lean_rate", "s^3/rad^2"), [](N n) { return &n.design.h[3]; }},
    {number("r_x", "1/N^2"), [](N n) { return &n.design.r_x; }},
    {yes_or_no("horizon_infinite"), [](N n) { return &n.horizon_infinite; }},
    {number("link", "m"), [](N n) { return &n.link; }},
    {number("com_up", "m"), [](N n) { return &n.com_up; }},
    {number("com_ahead", "m"), [](N n) { return &n.com_ahead; }},
    {number("spring_thigh_left", "N m/rad"), [](N n) { return &n.springs[0]; }},
    {number("spring_shin_left", "N m/rad"), [](N n) { return &n.springs[1]; }},
    {number("spring_thigh_right", "N m/rad"), [](N n) { return &n.springs[2]; }},
    {number("spring_shin_right", "N m/rad"), [](N n) { return &n.springs[3]; }},
    {number("leverage_left", "1"), [](N n) { return &n.leverage[0]; }},
    {number("leverage_right", "1"), [](N n) { return &n.leverage[1]; }},
    {number("friction_cone", "1"), [](N n) { return &n.friction_cone; }},
    {number("contact", "1"), [](N n) { return &n.contact; }},
    {number("contact_from", "1"), [](N n) { return &n.contact_from; }},
    {number("clearance", "m"), [](N n) { return &n.clearance; }},
    {number("ready", "1"), [](N n) { return &n.ready; }},
    {number("force_noise", "N"), [](N n) { return &n.filter.force_noise; }},
    {number("loaded_variance", "m^2"), [](N n) { return &n.filter.loaded; }},
    {number("unloaded_variance", "m^2"), [](N n) { return &n.filter.unloaded; }},
    {number("full_load", "1"), [](N n) { return &n.filter.full_load; }},
    {yes_or_no("height_each_step"), [](N n) { return &n.height_each_step; }},
    {number("gear", "1"), [](N n) { return &n.drive.gear; }},
    {number("torque_constant", "N m/A"), [](N n) { return &n.drive.torque_constant; }},
    {number("rotor_inertia", "kg m^2"), [](N n) { return &n.drive.rotor_inertia; }},
    {{"current_limit", "A", PLUMBLINE_VALUE, 0.0, kCurrent}, [](N n) { return &n.drive.current_limit; }},
    {number("speed_gain", "N m s/rad"), [](N n) { return &n.drive.speed_gain; }},
    {number("torque_rate", "1/s"), [](N n) { return &n.drive.torque_rate; }},
    {number("angle_rate", "1/s"), [](N n) { return &n.drive.angle_rate; }},
    {number("friction", "N m"), [](N n) { return &n.drive.friction; }},
    {number("load_friction", "1"), [](N n) { return &n.drive.load_friction; }},
    {number("friction_speed", "rad/s"), [](N n) { return &n.drive.friction_speed; }},
    {number("motor_filter", "s"), [](N n) { return &n.motor_filter; }},
    {number("link_filter", "s"), [](N n) { return &n.link_filter; }},
    {number("aim_filter", "s"), [](N n) { return &n.mirror_filter; }},
    {yes_or_no("learn"), [](N n) { return &n.learn; }},
    {number("learn_from", "1"), [](N n) { return &n.learn_from; }},
    {number("speed_step", "m/s"), [](N n) { return &n.speed_step; }},
    {number("speed_most", "m/s"), [](N n) { return &n.speed_most; }},
    {yes_or_no("speed_back"), [](N n) { return &n.speed_back; }},
    {number("speed_every", "1"), [](N n) { return &n.speed_every; }},
    {number("speed_after", "1"), [](N n) { return &n.speed_after; }},
    {number("fall", "rad"), [](N n) { return &n.fall; }},
};
constexpr std::size_t kConstantCount = sizeof kConstants / sizeof kConstants[0];

template <std::size_t Count, class Entry>
struct PortList {
  constexpr explicit PortList(const Entry (&entries)[Count]) {
    for (std::size_t k = 0; k < Count; ++k) {
      ports[k] = entries[k].port;
    }
  }
  plumbline_port ports[Count]{};
};
constexpr PortList<kLogCount, LogEntry> kLogPorts(kLogged);
constexpr PortList<kConstantCount, Constant> kConstantPorts(kConstants);

RunningNumbers numbers_of(const plumbline_setup& setup) {
  RunningNumbers numbers;
  for (std::size_t k = 0; k < kConstantCount; ++k) {
    *kConstants[k].in(numbers) = setup.constants[k];
  }
  return numbers;
}

class Library {
 public:
  explicit Library(const plumbline_setup& setup) : running_(numbers_of(setup), setup.period) {
    for (std::size_t i = 0; i < kInputCount; ++i) {
      scales_[i] = setup.input_scales[i];
    }
  }
  void reset() noexcept { running_.reset(); }
  int step(const double* inputs, double* outputs, double* log) noexcept {
    double q[kInputCount];
    for (std::size_t i = 0; i < kInputCount; ++i) {
      q[i] = inputs[i] * scales_[i];
    }
    Reading reading;
    reading.legs = {LegReading{q[0], q[1], q[2], q[3]}, LegReading{q[4], q[5], q[6], q[7]}};
    reading.trunk = q[8];
    reading.wanted = q[9];
    const Currents currents = running_.step(reading);
    for (std::size_t m = 0; m < currents.size(); ++m) {
      outputs[m] = currents[m];
    }
    for (std::size_t k = 0; log != nullptr && k < kLogCount; ++k) {
      log[k] = kLogged[k].of(running_);
    }
    return static_cast<int>(running_.state().fault);
  }
  static const char* fault(int code) noexcept { return to_string(static_cast<RunningFault>(code)); }
  void get_memory(double* memory) const noexcept { memory[0] = static_cast<double>(running_.state().leg); }
  void set_memory(const double* memory) noexcept { running_.set_leg(memory[0] != 0.0); }

 private:
  Running running_;
  double scales_[kInputCount];
};

}  // namespace
}  // namespace plumbline::controllers::atrias

extern "C" const plumbline_controller_api* plumbline_controller() {
  using namespace plumbline::controllers;
  using namespace plumbline::controllers::atrias;
  static constexpr plumbline_controller_api kApi =
      CFunctions<Library>::api("atrias_running", "1", ports(kInputs), ports(kOutputs),
                               ports(kConstantPorts.ports), ports(kLogPorts.ports), ports(kMemory));
  return &kApi;
}
