// How packets reach the other side. An adaptor for another bus is one class with these functions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace plumbline::driver {

/// Datagrams, each whole or not at all; they may be lost, doubled or overtaken. After construction nothing
/// allocates, and send and receive never block.
class Transport {
 public:
  virtual ~Transport() = default;
  /// False when it could not be handed on; it is lost then.
  virtual bool send(const std::uint8_t* data, std::size_t size) noexcept = 0;
  /// The next datagram that has come; 0: there is none. One larger than the buffer is cut off.
  virtual std::size_t receive(std::uint8_t* buffer, std::size_t size) noexcept = 0;
  /// When the datagram that receive() gave last had come, CLOCK_MONOTONIC in ns: its wait for a late reader
  /// counts.
  virtual std::int64_t arrived() const noexcept = 0;
  /// Sleeps until something has come (true) or CLOCK_MONOTONIC shows `deadline`, ns (false).
  virtual bool wait(std::int64_t deadline) noexcept = 0;
};

/// CLOCK_MONOTONIC, ns.
std::int64_t monotonic_now() noexcept;

/// Sides of a connection.
enum class Side { driver, robot };

/// "udp:HOST:PORT" or "shm:NAME". The robot's side listens at the port or makes the shared memory; the
/// driver's side sends to the port or opens it. Throws DriverError with one line.
std::unique_ptr<Transport> open_transport(const std::string& address, Side side);

}  // namespace plumbline::driver
