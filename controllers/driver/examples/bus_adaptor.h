// A worked example: the driver on a field bus that exchanges process data, as EtherCAT, CANopen and the
// hardware interfaces of ros2_control do. docs/driving.md goes through it line by line.
#pragma once

#include <cstdint>
#include <vector>

#include "controllers/driver/packet.h"
#include "controllers/driver/transport.h"

namespace plumbline::driver {

/// What such a bus offers: one exchange of all drives' data each cycle. `inputs` and `outputs` are the bus's
/// own process data: encoder counts of 32 bits that wrap, torques in thousandths of each drive's rated
/// torque.
class ProcessBus {
 public:
  virtual ~ProcessBus() = default;
  /// Sends the outputs and takes the inputs; false when the frame was lost or a drive did not answer (of
  /// EtherCAT: the working counter is wrong). Must not block for longer than the bus's own cycle.
  virtual bool exchange(const std::int16_t* outputs, std::int32_t* inputs) noexcept = 0;
  /// The drives' state machines (CiA 402): switched on and enabled, or not.
  virtual void enable(bool on) noexcept = 0;
  virtual bool enabled() const noexcept = 0;
};

/// One motor with its encoder on the bus.
struct BusAxis {
  double rated_torque = 1.0;  ///< N m that 1000 stands for
};

/// Looks to the driver like a robot at the other end of a cable. Each wait() makes one exchange; an exchange
/// that fails makes no packet, so that the driver counts it as lost.
class BusAdaptor : public Transport {
 public:
  /// `layout`: of the certificate's channels and commands, one of each for every axis, in the same order.
  /// `period`: of the bus, ns.
  BusAdaptor(ProcessBus& bus, const std::vector<BusAxis>& axes, std::uint32_t layout, std::int64_t period);

  bool send(const std::uint8_t* data, std::size_t size) noexcept override;
  std::size_t receive(std::uint8_t* buffer, std::size_t size) noexcept override;
  bool wait(std::int64_t deadline) noexcept override;
  std::int64_t arrived() const noexcept override { return arrived_; }

 private:
  ProcessBus& bus_;
  std::vector<BusAxis> axes_;
  std::int64_t period_, next_ = 0, arrived_ = 0;
  std::vector<std::int16_t> outputs_;
  std::vector<std::int32_t> inputs_, before_;
  std::vector<std::int64_t> counts_;
  Packet newest_, out_;
  bool known_ = false, fresh_ = false;
};

}  // namespace plumbline::driver
