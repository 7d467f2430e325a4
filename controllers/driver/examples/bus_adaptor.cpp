#include "controllers/driver/examples/bus_adaptor.h"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace plumbline::driver {

BusAdaptor::BusAdaptor(ProcessBus& bus, const std::vector<BusAxis>& axes, std::uint32_t layout,
                       std::int64_t period)
    : bus_(bus),
      axes_(axes),
      period_(period),
      next_(monotonic_now()),
      outputs_(axes.size(), 0),
      inputs_(axes.size(), 0),
      before_(axes.size(), 0),
      counts_(axes.size(), 0) {
  out_.kind = Packet::sensors;
  out_.layout = layout;
  out_.count = static_cast<std::uint16_t>(axes.size());
}

// 1. Commands: from the driver's packet to the bus's own numbers, for the next exchange.
bool BusAdaptor::send(const std::uint8_t* data, std::size_t size) noexcept {
  if (!decode(data, size, newest_) || newest_.count != axes_.size()) return false;
  const bool power = (newest_.flags & driver_flag::power) != 0U;
  bus_.enable(power);
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    const double thousandths = 1000.0 * newest_.real(k) / axes_[k].rated_torque;
    outputs_[k] =
        power ? static_cast<std::int16_t>(std::lround(std::clamp(thousandths, -32767.0, 32767.0))) : 0;
  }
  return true;
}

// 2. Time: the bus's cycle is the clock. Sleep until its next one, exchange, and note when the data came.
bool BusAdaptor::wait(std::int64_t deadline) noexcept {
  if (fresh_) return true;
  next_ += period_;
  if (next_ < monotonic_now() - period_) next_ = monotonic_now();  // no burst behind a pause
  const std::int64_t until = std::min(next_, deadline);
  timespec time{};
  time.tv_sec = until / 1000000000;
  time.tv_nsec = until % 1000000000;
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr);
  if (until < next_) {
    next_ -= period_;
    return false;
  }
  ++out_.sequence;  // a lost exchange leaves a gap that the driver sees
  if (!bus_.exchange(outputs_.data(), inputs_.data())) return false;
  arrived_ = monotonic_now();
  fresh_ = true;
  return true;
}

// 3. Sensors: counts that do not wrap, and the drives' state, as a robot's packet.
std::size_t BusAdaptor::receive(std::uint8_t* buffer, std::size_t size) noexcept {
  if (!fresh_ || size < Packet::largest) return 0;
  fresh_ = false;
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    // The difference of two counts of 32 bits is right even where they wrapped between.
    const auto change = static_cast<std::int32_t>(static_cast<std::uint32_t>(inputs_[k]) -
                                                  static_cast<std::uint32_t>(before_[k]));
    counts_[k] = known_ ? counts_[k] + change : inputs_[k];
    before_[k] = inputs_[k];
    out_.set_whole(k, counts_[k]);
  }
  known_ = true;
  out_.session = newest_.session;
  out_.echo = newest_.sequence;
  out_.time = static_cast<std::uint64_t>(arrived_);
  out_.flags = bus_.enabled() ? robot_flag::power : 0U;
  return encode(out_, buffer);
}

}  // namespace plumbline::driver
