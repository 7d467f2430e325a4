#include "controllers/driver/session.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <ctime>

namespace plumbline::driver {
namespace {

constexpr std::int64_t kSecond = 1000000000;
constexpr std::int64_t kHello = 10000000;     // ns between packets to a robot that does not answer
constexpr std::int64_t kPowerTime = kSecond;  // ns in which the power must come

std::int64_t nanoseconds(double seconds) { return static_cast<std::int64_t>(std::llround(1e9 * seconds)); }

}  // namespace

Session::Session(const Plan& plan, Transport& transport, ControllerProcess& controller, Log* log,
                 const SessionOptions& options)
    : plan_(plan),
      transport_(transport),
      controller_(controller),
      log_(log),
      options_(options),
      supervisor_(plan),
      layout_(layout_of(plan.channel_names(), plan.command_names())),
      channels_(plan.channels.size(), 0.0),
      before_(plan.channels.size(), 0.0),
      commands_(plan.commands.size(), 0.0),
      controller_log_(plan.log.size(), 0.0),
      hold_at_(plan.commands.size(), 0.0),
      inputs_(plan.inputs.size(), 0.0),
      outputs_(plan.outputs.size(), 0.0) {
  begun_ = state_since_ = heard_at_ = tick_ = monotonic_now();
  out_.kind = Packet::commands;
  out_.session = options.session;
  out_.layout = layout_;
  out_.count = static_cast<std::uint16_t>(plan.commands.size());
}

double Session::seconds() const noexcept { return 1e-9 * static_cast<double>(monotonic_now() - begun_); }

void Session::run() noexcept {
  while (!over()) turn();
}

void Session::turn() noexcept {
  take_request();
  if (options_.clock == ClockSource::robot) {
    wait_for_robot();
  } else {
    wait_for_tick();
  }
  note_fault();
}

void Session::say(const char* text) noexcept {
  if (log_ != nullptr) log_->event(seconds(), text);
}

void Session::enter(State state, const char* why) noexcept {
  state_.store(state);
  state_since_ = monotonic_now();
  char text[224];
  std::snprintf(text, sizeof text, "%s: %s", to_string(state), why);
  say(text);
}

void Session::note_fault() noexcept {
  if (!supervisor_.stopped() || fault_noted_) return;
  fault_noted_ = true;
  faults_.fetch_add(1);
  std::fill(commands_.begin(), commands_.end(), 0.0);
  char text[224];
  std::snprintf(text, sizeof text, "%s: %s", to_string(supervisor_.fault().cause),
                supervisor_.fault().detail);
  enter(State::stopped, text);
}

void Session::take_request() noexcept {
  const Request request = request_.exchange(Request::none);
  const State now = state();
  switch (request) {
    case Request::none:
      break;
    case Request::arm:
      arm();
      break;
    case Request::go:
      hand_over();
      break;
    case Request::finish:
      if (now == State::holding || now == State::running) enter(State::idle, "finished");
      break;
    case Request::stop:
      supervisor_.stop(Cause::emergency_stop, "the operator");
      note_fault();
      send();  // at once: the next packet may be long in coming
      break;
    case Request::reset:
      if (now == State::stopped || now == State::idle) {
        supervisor_.reset();
        fault_noted_ = heard_ = power_was_on_ = false;
        ask_reset_ = true;
        reset_sequence_ = out_.sequence + 1;
        enter(State::waiting, "reset");
      }
      break;
    case Request::quit:
      std::fill(commands_.begin(), commands_.end(), 0.0);
      if (now != State::stopped) state_.store(State::idle);
      send();
      over_.store(true);
      break;
  }
}

void Session::arm() noexcept {
  if (state() != State::idle) {
    say("not armed: only an idle driver arms");
    return;
  }
  if (ask_reset_) {
    say("not armed: the robot has not taken the reset yet");
    return;
  }
  if (tripped_) {
    say("not armed: the robot's watchdog has cut the power; reset first");
    return;
  }
  if (expired_.load()) {
    supervisor_.stop(Cause::expired_certificate, "its last day is over");
    note_fault();
    return;
  }
  if (!controller_.reset()) {
    say("the controller did not answer: its process is started again");
    try {
      controller_.restart();
    } catch (const std::exception& error) {
      supervisor_.stop(Cause::controller_crash, error.what());
      note_fault();
      return;
    }
  }
  hold_known_ = power_was_on_ = false;
  heard_at_ = monotonic_now();  // a controller's start takes longer than a robot may be silent
  enter(State::holding, "armed, waiting for power");
}

void Session::hand_over() noexcept {
  if (state() != State::holding || !hold_known_) {
    say("not handed over: only a driver that holds hands over");
    return;
  }
  for (const Reach& reach : plan_.handover) {
    double at = 0.0;
    for (const Reach::Term& term : reach.of) {
      const auto channel = static_cast<std::size_t>(term.channel);
      at += term.factor * plan_.channels[channel].scale * channels_[channel];
    }
    if (at < reach.from || at > reach.to) {
      char text[192];
      std::snprintf(text, sizeof text, "not handed over: %s at %.4g, expected %.4g to %.4g",
                    reach.name.c_str(), at, reach.from, reach.to);
      say(text);
      return;
    }
  }
  steps_of_run_ = 0;
  enter(State::running, "handed over to the controller");
}

void Session::wait_for_robot() noexcept {
  const std::int64_t limit = nanoseconds(plan_.silence);
  const std::int64_t wake_at =
      heard_ ? std::min(heard_at_ + limit + 1000, monotonic_now() + kHello) : monotonic_now() + kHello;
  transport_.wait(std::max(wake_at, monotonic_now() + 1000));
  if (!receive()) {
    const std::int64_t now = monotonic_now();
    if (heard_ && !supervisor_.stopped()) supervisor_.silence(1e-9 * static_cast<double>(now - heard_at_));
    note_fault();
    if (now - sent_at_ >= kHello || (fault_noted_ && state_since_ > sent_at_)) send();
  }
}

void Session::wait_for_tick() noexcept {
  tick_ += nanoseconds(plan_.period);
  timespec until{};
  until.tv_sec = tick_ / kSecond;
  until.tv_nsec = tick_ % kSecond;
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
  const std::int64_t late = monotonic_now() - tick_;
  wake_.add(late);
  if (late > kSecond) tick_ = monotonic_now();  // the computer slept: no burst of cycles
  if (receive()) return;
  if (heard_ && !supervisor_.stopped())
    supervisor_.silence(1e-9 * static_cast<double>(monotonic_now() - heard_at_));
  note_fault();
  send();  // a heartbeat with the commands as they are
}

// Takes all that has come, each packet as a cycle of its own; false when no good one was among them.
bool Session::receive() noexcept {
  bool any = false;
  for (int k = 0; k < 64; ++k) {
    const std::size_t size = transport_.receive(buffer_, sizeof buffer_);
    if (size == 0) break;
    const std::int64_t now = monotonic_now();
    const std::int64_t arrival = options_.clock == ClockSource::robot ? transport_.arrived() : tick_;
    if (options_.clock == ClockSource::robot) wake_.add(now - arrival);
    if (!decode(buffer_, size, in_) || in_.kind != Packet::sensors) {
      ++counts_.corrupt;
      if (heard_) supervisor_.packet_corrupt();
      note_fault();
      if (fault_noted_) send();
      continue;
    }
    if (in_.session != options_.session) {
      ++counts_.foreign;  // of an earlier session of this robot
      continue;
    }
    std::uint32_t missing = 0;
    if (accept(missing)) {
      cycle(missing, arrival);
      any = true;
    } else {
      note_fault();
      if (fault_noted_) send();
    }
  }
  return any;
}

bool Session::accept(std::uint32_t& missing) noexcept {
  if (in_.layout != layout_ || in_.count != channels_.size()) {
    supervisor_.stop(Cause::wrong_layout,
                     "the robot's channels or commands are not those of the certificate");
    return false;
  }
  const auto ahead = static_cast<std::int32_t>(in_.sequence - sequence_);
  if (heard_ && ahead == 0) {
    ++counts_.duplicated;
    supervisor_.packet_twice();
    return false;
  }
  if (heard_ && ahead < 0) {
    ++counts_.reordered;
    supervisor_.packet_behind();
    return false;
  }
  missing = heard_ ? static_cast<std::uint32_t>(ahead - 1) : 0;
  counts_.lost += missing;
  supervisor_.packet(missing);
  whole_sequence_ += heard_ ? ahead : in_.sequence;
  sequence_ = in_.sequence;
  return true;
}

void Session::cycle(std::uint32_t missing, std::int64_t arrival) noexcept {
  ++counts_.cycles;
  if (heard_) supervisor_.silence(1e-9 * static_cast<double>(arrival - heard_at_));
  heard_at_ = arrival;
  std::swap(before_, channels_);
  for (std::size_t k = 0; k < channels_.size(); ++k) {
    const bool real = plan_.channels[k].kind == ChannelKind::value;
    channels_[k] = real ? in_.real(k) : static_cast<double>(in_.whole(k));
  }
  if (!heard_) {
    heard_ = true;
    if (state() == State::waiting) enter(State::idle, "the robot answers");
  }
  watch_flags();
  // Until the robot has taken a reset it may lie anywhere, and then is elsewhere at once.
  if (!ask_reset_) supervisor_.sensors(channels_.data(), missing + 1, state() == State::running);
  controller_ns_ = 0;
  make_commands();
  supervisor_.command(commands_.data());
  supervisor_.cycle(1e-9 * static_cast<double>(monotonic_now() - arrival));
  const State logged = state();
  note_fault();
  send();
  answer_.add(sent_at_ - arrival);
  if (log_ != nullptr) {
    Cycle row;
    row.sequence = whole_sequence_;
    row.state = supervisor_.stopped() ? State::stopped : logged;
    row.cause = supervisor_.fault().cause;
    row.missing = missing;
    row.arrival = arrival;
    row.sent = sent_at_;
    row.controller = controller_ns_;
    row.channels = channels_.data();
    row.commands = commands_.data();
    row.log = controller_log_.data();
    log_->push(row);
  }
}

void Session::watch_flags() noexcept {
  const State now = state();
  if (ask_reset_ && static_cast<std::int32_t>(in_.echo - reset_sequence_) >= 0) ask_reset_ = false;
  tripped_ = (in_.flags & robot_flag::tripped) != 0U;
  if ((in_.flags & robot_flag::emergency_stop) != 0U)
    supervisor_.stop(Cause::emergency_stop, "the robot's button");
  const bool wanted = now == State::holding || now == State::running;
  const bool on = (in_.flags & robot_flag::power) != 0U;
  if (!wanted) return;
  if (!on && power_was_on_) {
    supervisor_.stop(Cause::power_cut, tripped_ ? "the robot's watchdog has cut the power"
                                                : "the robot has switched its motors off");
  } else if (!on && monotonic_now() - state_since_ > kPowerTime) {
    supervisor_.stop(Cause::power_cut, "the robot did not switch its motors on within 1 s");
  }
  power_was_on_ = power_was_on_ || on;
}

void Session::make_commands() noexcept {
  if (supervisor_.stopped()) return;
  std::fill(commands_.begin(), commands_.end(), 0.0);
  if (state() == State::holding) hold();
  if (state() == State::running) step_controller();
}

void Session::hold() noexcept {
  if (!power_was_on_) return;
  if (!hold_known_) say("holding: the power is on");
  for (std::size_t k = 0; k < commands_.size(); ++k) {
    const Hold& hold = plan_.commands[k].hold;
    if (hold.channel < 0) continue;
    const auto channel = static_cast<std::size_t>(hold.channel);
    const double scale = plan_.channels[channel].scale;
    if (!hold_known_) hold_at_[k] = scale * channels_[channel];
    const double rate = hold_known_ ? scale * (channels_[channel] - before_[channel]) / plan_.period : 0.0;
    const double torque = hold.stiffness * (hold_at_[k] - scale * channels_[channel]) - hold.damping * rate;
    commands_[k] = std::clamp(torque, -plan_.commands[k].limit, plan_.commands[k].limit);
  }
  hold_known_ = true;
}

void Session::step_controller() noexcept {
  for (std::size_t k = 0; k < inputs_.size(); ++k) {
    inputs_[k] = plan_.inputs[k].fixed;
    for (const int channel : plan_.inputs[k].from) {
      const double value = channels_[static_cast<std::size_t>(channel)];
      inputs_[k] = plan_.inputs[k].from.size() > 1 ? std::max(inputs_[k], value) : value;
    }
  }
  const std::int64_t deadline = monotonic_now() + nanoseconds(plan_.controller_time);
  const Answer answer = controller_.step(inputs_.data(), outputs_.data(), controller_log_.data(), deadline);
  ++counts_.steps;
  if (answer == Answer::done) {
    controller_ns_ = controller_.nanoseconds();
    controller_time_.add(static_cast<std::int64_t>(controller_ns_));
    for (std::size_t k = 0; k < outputs_.size(); ++k) {
      commands_[static_cast<std::size_t>(plan_.outputs[k].to)] = outputs_[k];
    }
  } else if (answer == Answer::gave_up) {
    supervisor_.stop(Cause::controller_gave_up, controller_.message());
  } else if (answer == Answer::crashed) {
    supervisor_.stop(Cause::controller_crash, "its process has ended");
  } else {
    char text[96];
    std::snprintf(text, sizeof text, "no answer within %.2f ms", 1e3 * plan_.controller_time);
    supervisor_.stop(Cause::controller_overrun, text);
  }
  ++steps_of_run_;
  if (options_.run_for > 0.0 && static_cast<double>(steps_of_run_) * plan_.period >= options_.run_for) {
    request_.store(Request::finish);
  }
}

void Session::send() noexcept {
  const State now = state();
  const bool power = !supervisor_.stopped() && (now == State::holding || now == State::running);
  out_.flags = (power ? driver_flag::power : 0U) |
               (power && now == State::running ? driver_flag::running : 0U) |
               (ask_reset_ ? driver_flag::reset : 0U);
  ++out_.sequence;
  out_.echo = sequence_;
  out_.time = static_cast<std::uint64_t>(monotonic_now());
  for (std::size_t k = 0; k < commands_.size(); ++k) out_.set_real(k, power ? commands_[k] : 0.0);
  std::uint8_t bytes[Packet::largest];
  const std::size_t size = encode(out_, bytes);
  if (!transport_.send(bytes, size) && heard_) ++counts_.unsent;
  sent_at_ = monotonic_now();
}

}  // namespace plumbline::driver
