#include "validation/control/robot/simulated_robot.h"

#include <fmt/core.h>

#include <cmath>
#include <ctime>

#include "simulator/trace/error.h"

namespace plumbline::validation {
namespace {

using driver::Packet;

constexpr std::int64_t kSecond = 1000000000;
constexpr double kShortestFlight = 0.02;  // s; a foot that bounces is not in flight

std::int64_t nanoseconds(double seconds) { return static_cast<std::int64_t>(std::llround(1e9 * seconds)); }

void sleep_until(std::int64_t time) {
  timespec until{};
  until.tv_sec = time / kSecond;
  until.tv_nsec = time % kSecond;
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

run::SimulationOptions simulation_options(const RobotOptions& options) {
  run::SimulationOptions simulation;
  simulation.integrator = options.integrator;
  simulation.period = options.period;
  return simulation;
}

run::SensorOptions sensor_options(const RobotOptions& options) {
  run::SensorOptions sensors;
  sensors.seed = options.seed;
  return sensors;
}

}  // namespace

SimulatedRobot::SimulatedRobot(const model::Model& model, const contact::Terrain& terrain,
                               const Eigen::VectorXd& start, const RobotOptions& options)
    : model_(model),
      options_(options),
      plant_(model_, {}, terrain),
      simulation_(std::make_unique<run::Simulation>(plant_, simulation_options(options))),
      sensors_(model_, sensor_options(options)),
      start_(start),
      command_(Eigen::VectorXd::Zero(plant_.motors())),
      none_(command_) {
  const std::size_t channels = model.sensors.size() + model.switches.size();
  if (channels > Packet::most_values || model.motors.size() > Packet::most_values) {
    throw InputError({model.file, 0, "sensors"}, std::to_string(channels) + " channels",
                     "at most " + std::to_string(Packet::most_values) + " in a packet");
  }
  std::vector<std::string> names, motors;
  for (const model::Sensor& sensor : model.sensors) {
    names.push_back(sensor.name);
  }
  for (const model::ContactSwitch& one : model.switches) {
    names.push_back(one.name);
  }
  for (const model::Motor& motor : model.motors) {
    motors.push_back(motor.name);
  }
  out_.kind = Packet::sensors;
  out_.count = static_cast<std::uint16_t>(channels);
  out_.layout = driver::layout_of(names, motors);
  to_stand();
}

SimulatedRobot::~SimulatedRobot() = default;

void SimulatedRobot::to_stand() {
  end_run();
  simulation_->start(start_);
  simulation_->measure();
  released_ = down_ = broken_ = false;
  power_ = tripped_ = false;
  unanswered_ = 0;
  in_air_ = 0.0;
}

void SimulatedRobot::end_run() {
  if (!in_run_) {
    return;
  }
  in_run_ = false;
  RobotRun& run = report_.runs.back();
  run.time = run_time_;
  if (injector_ != nullptr) {
    run.fault_at = injector_->begun();
  }
  injector_.reset();
}

Packet SimulatedRobot::sample() {
  if (released_ && !broken_) {
    simulation_->measure();
    watch_landings();
  }
  sensors_.read(simulation_->outputs(), simulation_->touches(), sensed_);
  std::size_t k = 0;
  for (std::size_t s = 0; s < model_.sensors.size(); ++s, ++k) {
    const auto index = static_cast<Eigen::Index>(s);
    if (model_.sensors[s].resolution > 0.0) {
      out_.set_whole(k, std::llround(sensed_.counts[index]));
    } else {
      out_.set_real(k, sensed_.readings[index]);
    }
  }
  for (Eigen::Index s = 0; s < sensed_.switches.size(); ++s, ++k) {
    out_.set_whole(k, sensed_.switches[s] != 0.0 ? 1 : 0);
  }
  namespace flag = driver::robot_flag;
  out_.flags = (power_ ? flag::power : 0U) | (tripped_ ? flag::tripped : 0U) | (released_ ? 0U : flag::held);
  out_.session = newest_.session;
  out_.echo = newest_.sequence;
  out_.time = static_cast<std::uint64_t>(driver::monotonic_now());
  ++out_.sequence;
  return out_;
}

/// False where a fault has kept the packet back.
bool SimulatedRobot::send(driver::Transport& transport, const Packet& packet) {
  if (injector_ == nullptr) {
    std::uint8_t bytes[Packet::largest];
    transport.send(bytes, driver::encode(packet, bytes));
    return true;
  }
  const bool before = injector_->begun() < 0;
  const std::vector<std::vector<std::uint8_t>> all = injector_->datagrams(packet, run_time_);
  for (const std::vector<std::uint8_t>& bytes : all) {
    transport.send(bytes.data(), bytes.size());
  }
  if (before && injector_->begun() >= 0) {
    fault_wall_ = driver::monotonic_now();
  }
  return !all.empty();
}

/// True when a command newer than all before has come.
bool SimulatedRobot::receive(driver::Transport& transport) {
  bool any = false;
  std::uint8_t bytes[Packet::largest + 1];
  while (const std::size_t size = transport.receive(bytes, sizeof bytes)) {
    Packet packet;
    if (!driver::decode(bytes, size, packet) || packet.kind != Packet::commands ||
        packet.layout != out_.layout || packet.count != model_.motors.size()) {
      ++report_.corrupt;
      continue;
    }
    const bool other_driver = !heard_ || packet.session != newest_.session;
    if (!other_driver && static_cast<std::int32_t>(packet.sequence - newest_.sequence) <= 0) {
      continue;
    }
    if (other_driver && power_) {
      cut_power(false, 0.0);  // nobody takes over a robot that moves
    }
    heard_ = any = true;
    heard_at_ = driver::monotonic_now();
    ++report_.commands;
    take(packet);
  }
  return any;
}

void SimulatedRobot::take(const Packet& command) {
  namespace flag = driver::driver_flag;
  newest_ = command;
  const bool wanted = (command.flags & flag::power) != 0U;
  if ((command.flags & flag::reset) != 0U && !wanted) {
    to_stand();
  }
  if (!wanted && power_) {
    cut_power(false, 0.0);
  }
  if (wanted && !tripped_ && !down_) {
    power_ = true;
  }
  if (power_ && !released_ && (command.flags & flag::running) != 0U) {
    released_ = in_run_ = true;
    run_time_ = 0.0;
    report_.runs.emplace_back();
    if (run_ < options_.faults.size() && options_.faults[run_].kind != WireFault::Kind::none) {
      injector_ = std::make_unique<FaultInjector>(options_.faults[run_], options_.seed + run_);
      report_.runs.back().fault = options_.faults[run_].text;
    }
    ++run_;
  }
  for (Eigen::Index m = 0; m < command_.size(); ++m) {
    const double torque = command.real(static_cast<std::size_t>(m));
    command_[m] = power_ && std::isfinite(torque) ? torque : 0.0;
  }
}

void SimulatedRobot::cut_power(bool by_watchdog, double after) {
  power_ = false;
  down_ = released_;
  tripped_ = tripped_ || by_watchdog;
  command_.setZero();
  if (!in_run_) {
    return;
  }
  RobotRun& run = report_.runs.back();
  run.zero_at =
      by_watchdog ? static_cast<std::int64_t>(out_.sequence) : static_cast<std::int64_t>(newest_.echo);
  run.watchdog = by_watchdog;
  run.watchdog_after = after;
  if (injector_ != nullptr && injector_->begun() >= 0) {
    run.fault_to_zero = 1e-9 * static_cast<double>(driver::monotonic_now() - fault_wall_);
  }
  end_run();
}

void SimulatedRobot::watch_landings() {
  if (!in_run_) {
    return;
  }
  bool touching = false;
  for (const model::Touch& touch : simulation_->touches()) {
    touching = touching || touch.depth > 0.0;
  }
  if (touching && in_air_ > kShortestFlight) {
    ++report_.runs.back().landings;
  }
  in_air_ = touching ? 0.0 : in_air_ + options_.period;
}

void SimulatedRobot::advance() {
  if (!released_ || broken_) {
    return;
  }
  try {
    simulation_->advance(power_ ? command_ : none_);
  } catch (const std::runtime_error&) {
    broken_ = true;  // a robot that has fallen in a heap: nothing more is learned from it
  }
  run_time_ += options_.period;
}

void SimulatedRobot::wait_for_command(driver::Transport& transport, bool sent, std::int64_t next) {
  const std::int64_t begun = driver::monotonic_now();
  if (unanswered_ == 0) {
    unanswered_ = begun;
  }
  const std::int64_t trip = unanswered_ + nanoseconds(options_.watchdog);
  // Without real time a packet that was kept back has no answer to wait for.
  std::int64_t deadline =
      options_.real_time ? std::max(next, begun + 1000) : begun + (sent ? nanoseconds(options_.patience) : 0);
  if (options_.real_time && power_) {
    deadline = std::min(deadline, std::max(trip, begun + 1000));
  }
  while (transport.wait(deadline)) {
    if (receive(transport) && newest_.echo == out_.sequence) {
      report_.round_trip.add(driver::monotonic_now() - static_cast<std::int64_t>(out_.time));
      unanswered_ = 0;
      return;
    }
  }
  const std::int64_t now = driver::monotonic_now();
  if (options_.real_time && power_ && now >= trip) {
    cut_power(true, 1e-9 * static_cast<double>(now - unanswered_));
  }
}

RobotReport SimulatedRobot::serve(driver::Transport& transport, const std::function<bool()>& stop) {
  const std::int64_t period = nanoseconds(options_.period);
  const std::int64_t begun = driver::monotonic_now();
  std::int64_t next = begun;
  while (!stop()) {
    const std::int64_t now = driver::monotonic_now();
    if (options_.longest > 0.0 && now - begun > nanoseconds(options_.longest)) {
      break;
    }
    if (options_.once && heard_ && now - heard_at_ > 2 * kSecond) {
      break;
    }
    if (!heard_) {
      transport.wait(now + kSecond / 50);
      receive(transport);
      next = driver::monotonic_now();
      continue;
    }
    const std::int64_t late = options_.real_time ? now - next : 0;
    if (late > period / 2) {
      ++report_.slipped;
      report_.largest_slip = std::max(report_.largest_slip, 1e-9 * static_cast<double>(late));
    }
    const Packet packet = sample();
    if (injector_ != nullptr && injector_->cuts_power(run_time_) && power_) {
      injector_->datagrams(packet, run_time_);  // notes when it began
      fault_wall_ = driver::monotonic_now();
      cut_power(false, 0.0);
      out_.flags &= ~driver::robot_flag::power;
      std::uint8_t bytes[Packet::largest];
      transport.send(bytes, driver::encode(out_, bytes));
      wait_for_command(transport, true, next + period);
    } else {
      wait_for_command(transport, send(transport, packet), next + period);
    }
    ++report_.samples;
    advance();
    next += period;
    if (options_.real_time) {
      sleep_until(next);
    }
  }
  end_run();
  return report_;
}

}  // namespace plumbline::validation
