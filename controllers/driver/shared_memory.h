// Datagrams through POSIX shared memory, for a robot's process on the same computer.
#pragma once

#include <atomic>
#include <cstdint>

#include "controllers/driver/packet.h"
#include "controllers/driver/transport.h"

namespace plumbline::driver {

/// What lies in the memory: two queues of 8 slots, one for each direction, each with one writer and one
/// reader. A full queue loses the newest datagram, as a network would.
struct SharedQueues {
  static constexpr std::uint32_t slots = 8;
  struct Slot {
    std::uint32_t size;
    std::int64_t time;  ///< CLOCK_MONOTONIC when it was written, ns
    std::uint8_t bytes[Packet::largest];
  };
  struct Queue {
    std::atomic<std::uint32_t> written;  ///< datagrams ever written; a futex
    std::atomic<std::uint32_t> read;
    Slot slot[slots];
  };
  std::atomic<std::uint32_t> magic;  ///< kMagic once the memory is ready
  Queue to_robot, to_driver;
};

class SharedMemory : public Transport {
 public:
  SharedMemory(const std::string& name, Side side);
  ~SharedMemory() override;
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  bool send(const std::uint8_t* data, std::size_t size) noexcept override;
  std::size_t receive(std::uint8_t* buffer, std::size_t size) noexcept override;
  bool wait(std::int64_t deadline) noexcept override;
  std::int64_t arrived() const noexcept override { return arrived_; }

 private:
  std::string name_;
  Side side_;
  SharedQueues* memory_ = nullptr;
  SharedQueues::Queue* out_ = nullptr;
  SharedQueues::Queue* in_ = nullptr;
  std::int64_t arrived_ = 0;
};

}  // namespace plumbline::driver
