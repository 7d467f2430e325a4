#include "controllers/driver/supervisor.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace plumbline::driver {
namespace {

constexpr int kWindow = 1000;
constexpr double kLargestCount = 9007199254740992.0;  // 2^53: whole numbers beyond are not exact

}  // namespace

void RecentCount::add(bool bad) noexcept {
  const auto word = static_cast<std::size_t>(next_ / 64);
  const std::uint64_t bit = std::uint64_t{1} << static_cast<unsigned>(next_ % 64);
  if ((bits_[word] & bit) != 0U) --bad_;
  bits_[word] = bad ? bits_[word] | bit : bits_[word] & ~bit;
  if (bad) ++bad_;
  next_ = (next_ + 1) % kWindow;
}

Supervisor::Supervisor(const Plan& plan)
    : plan_(plan),
      last_channels_(plan.channels.size(), 0.0),
      last_commands_(plan.commands.size(), 0.0),
      rested_(plan.channels.size(), 0.0),
      reaches_(plan.workspace.size()) {}

void Supervisor::stop(Cause cause, const char* detail) noexcept { stop_with(cause, "%s", detail); }

void Supervisor::stop_with(Cause cause, const char* format, ...) noexcept {
  if (stopped()) return;
  fault_.cause = cause;
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(fault_.detail, sizeof fault_.detail, format, arguments);
  va_end(arguments);
}

void Supervisor::reset() noexcept {
  fault_ = Fault();
  for (RecentCount* count : {&lost_, &duplicated_, &reordered_, &corrupt_, &late_}) count->clear();
  std::fill(last_commands_.begin(), last_commands_.end(), 0.0);
  std::fill(rested_.begin(), rested_.end(), 0.0);
  channels_known_ = false;
  for (ReachState& reach : reaches_) reach = ReachState();
}

void Supervisor::packet(std::uint32_t missing) noexcept {
  for (std::uint32_t k = 0; k < std::min<std::uint32_t>(missing, kWindow); ++k) lost_.add(true);
  for (RecentCount* count : {&lost_, &duplicated_, &reordered_, &corrupt_}) count->add(false);
  if (missing > static_cast<std::uint32_t>(plan_.packets.lost_in_succession)) {
    stop_with(Cause::lost, "%u packets in succession did not come, allowed: %d", missing,
              plan_.packets.lost_in_succession);
  } else if (lost_.bad() > plan_.packets.lost) {
    stop_with(Cause::lost, "%d of 1000 packets did not come, allowed: %d", lost_.bad(), plan_.packets.lost);
  }
}

void Supervisor::packet_twice() noexcept {
  duplicated_.add(true);
  if (duplicated_.bad() > plan_.packets.duplicated) {
    stop_with(Cause::duplicated, "%d of 1000 packets came twice, allowed: %d", duplicated_.bad(),
              plan_.packets.duplicated);
  }
}

void Supervisor::packet_behind() noexcept {
  reordered_.add(true);
  if (reordered_.bad() > plan_.packets.reordered) {
    stop_with(Cause::reordered, "%d of 1000 packets came behind newer ones, allowed: %d", reordered_.bad(),
              plan_.packets.reordered);
  }
}

void Supervisor::packet_corrupt() noexcept {
  corrupt_.add(true);
  if (corrupt_.bad() > plan_.packets.corrupt) {
    stop_with(Cause::corrupt, "%d of 1000 packets were corrupt, allowed: %d", corrupt_.bad(),
              plan_.packets.corrupt);
  }
}

void Supervisor::silence(double seconds) noexcept {
  if (seconds > plan_.silence) {
    stop_with(Cause::stale, "no packet for %.1f ms, allowed: %.1f ms", 1e3 * seconds, 1e3 * plan_.silence);
  }
}

void Supervisor::sensors(const double* channels, std::uint32_t periods, bool moving) noexcept {
  periods = std::max<std::uint32_t>(periods, 1);
  periods_ += periods;
  check_channels(channels, periods, moving);
  for (std::size_t k = 0; k < reaches_.size(); ++k) check_reach(k, channels);
  std::copy(channels, channels + last_channels_.size(), last_channels_.begin());
  channels_known_ = true;
}

void Supervisor::check_channels(const double* channels, std::uint32_t periods, bool moving) noexcept {
  for (std::size_t k = 0; k < last_channels_.size(); ++k) {
    const Channel& channel = plan_.channels[k];
    if (!std::isfinite(channels[k])) {
      stop_with(Cause::not_a_number, "sensor %s", channel.name.c_str());
      continue;
    }
    if (channel.kind == ChannelKind::contact && channels[k] != 0.0 && channels[k] != 1.0) {
      stop_with(Cause::corrupt, "switch %s reads %g, which is neither 0 nor 1", channel.name.c_str(),
                channels[k]);
    }
    if (channel.kind == ChannelKind::count && std::abs(channels[k]) > kLargestCount) {
      stop_with(Cause::count_jump, "sensor %s reads %g counts", channel.name.c_str(), channels[k]);
    }
    if (!channels_known_) continue;
    const double change = std::abs((channels[k] - last_channels_[k]) * channel.scale);
    // One count of quantisation at either end is no motion.
    const double slack = channel.kind == ChannelKind::count ? std::abs(channel.scale) : 0.0;
    const double most = channel.speed * periods * plan_.period + slack;
    if (change > most) {
      stop_with(Cause::count_jump, "sensor %s moved by %.4g %s in %u samples, at most %.4g",
                channel.name.c_str(), change, channel.unit.c_str(), periods, most);
    }
    rested_[k] = moving && change == 0.0 ? rested_[k] + periods : 0.0;
    if (rested_[k] * plan_.period > channel.rest) {
      stop_with(Cause::frozen_sensor, "sensor %s has not changed for %.0f ms, allowed: %.0f ms",
                channel.name.c_str(), 1e3 * rested_[k] * plan_.period, 1e3 * channel.rest);
    }
  }
}

void Supervisor::check_reach(std::size_t index, const double* channels) noexcept {
  const Reach& reach = plan_.workspace[index];
  ReachState& state = reaches_[index];
  double now = 0.0;
  for (const Reach::Term& term : reach.of) {
    const auto channel = static_cast<std::size_t>(term.channel);
    now += term.factor * plan_.channels[channel].scale * channels[channel];
  }
  state.position = now;
  std::copy_backward(state.positions.begin(), state.positions.end() - 1, state.positions.end());
  std::copy_backward(state.times.begin(), state.times.end() - 1, state.times.end());
  state.positions[0] = now;
  state.times[0] = periods_;
  state.known = std::min(state.known + 1, kSpan + 1);
  const std::size_t oldest = state.known - 1;
  state.rate = oldest == 0 ? 0.0
                           : (state.positions[0] - state.positions[oldest]) /
                                 ((state.times[0] - state.times[oldest]) * plan_.period);
  // A constant deceleration a brings the rate v to rest after the way v^2 / 2 a.
  state.stopping = now + 0.5 * state.rate * std::abs(state.rate) / reach.deceleration;
  if (now < reach.from || now > reach.to) {
    stop_with(Cause::workspace, "%s at %.4g, allowed: %.4g to %.4g", reach.name.c_str(), now, reach.from,
              reach.to);
  } else if (state.stopping < reach.from || state.stopping > reach.to) {
    stop_with(Cause::stopping_position,
              "%s at %.4g with %.4g per second would stop at %.4g, allowed: %.4g to %.4g", reach.name.c_str(),
              now, state.rate, state.stopping, reach.from, reach.to);
  }
}

void Supervisor::command(double* commands) noexcept {
  for (std::size_t k = 0; k < last_commands_.size() && !stopped(); ++k) {
    const CommandChannel& command = plan_.commands[k];
    const double change = std::abs(commands[k] - last_commands_[k]);
    if (!std::isfinite(commands[k])) {
      stop_with(Cause::not_a_number, "command %s", command.name.c_str());
    } else if (std::abs(commands[k]) > command.limit) {
      stop_with(Cause::command_limit, "%s = %.4g %s, allowed: %.4g", command.name.c_str(), commands[k],
                command.unit.c_str(), command.limit);
    } else if (change > command.slew * plan_.period) {
      stop_with(Cause::slew_limit, "%s changed by %.4g %s in one sample, allowed: %.4g", command.name.c_str(),
                change, command.unit.c_str(), command.slew * plan_.period);
    }
  }
  if (stopped()) std::fill(commands, commands + last_commands_.size(), 0.0);
  std::copy(commands, commands + last_commands_.size(), last_commands_.begin());
}

void Supervisor::cycle(double seconds) noexcept {
  late_.add(seconds > plan_.answer);
  if (late_.bad() > plan_.late) {
    stop_with(Cause::late_cycle,
              "%d of 1000 commands left later than %.2f ms after their sample (now %.2f ms), allowed: %d",
              late_.bad(), 1e3 * plan_.answer, 1e3 * seconds, plan_.late);
  }
}

}  // namespace plumbline::driver
