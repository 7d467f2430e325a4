// Faults that a simulated robot brings about on purpose, to see what the driver does about them.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "controllers/driver/packet.h"
#include "simulator/model/model.h"

namespace plumbline::validation {

/// One fault of one run. Times count from the hand-over to the controller.
struct WireFault {
  enum class Kind {
    none,
    corrupt,         ///< so many packets with a flipped bit
    lost,            ///< so many packets in succession are not sent
    duplicated,      ///< so many packets are sent twice
    reordered,       ///< so many packets come behind their successor
    silence,         ///< nothing is sent any more, for s
    frozen,          ///< a sensor stays where it is
    jump,            ///< a sensor jumps by so many counts
    drift,           ///< a sensor moves away by so many counts a second
    layout,          ///< the robot says that it has other channels
    emergency_stop,  ///< its button is pressed
    power,           ///< it switches its motors off
  };
  Kind kind = Kind::none;
  double time = 0.0;    ///< s
  double amount = 1.0;  ///< packets, seconds, counts or counts per second
  int channel = -1;     ///< of a sensor's fault: its place in the packet
  std::string text;     ///< as it was written
};

/// "KIND@SECONDS", "KIND@SECONDS:AMOUNT", and of a sensor's fault "KIND@SECONDS:SENSOR" or
/// "KIND@SECONDS:SENSOR:AMOUNT". Throws InputError with the known kinds or sensors.
WireFault parse_fault(const std::string& text, const model::Model& model);

/// Applies a fault to the packets of one run.
class FaultInjector {
 public:
  explicit FaultInjector(const WireFault& fault, std::uint64_t seed) : fault_(fault), random_(seed) {}

  /// The packet at `time` of the run; returns the datagrams that are to be sent in its place.
  std::vector<std::vector<std::uint8_t>> datagrams(driver::Packet packet, double time);
  /// The motors are to lose their power at this time.
  bool cuts_power(double time) const { return fault_.kind == WireFault::Kind::power && time >= fault_.time; }
  /// Sequence of the first packet that the fault has touched; of one that does not touch any, of the packet
  /// at its time. -1: it has not begun.
  std::int64_t begun() const { return begun_; }
  const WireFault& fault() const { return fault_; }

 private:
  void change(driver::Packet& packet, double since);

  WireFault fault_;
  std::mt19937_64 random_;
  std::int64_t begun_ = -1;
  std::uint64_t frozen_ = 0;
  int left_ = 0;
  std::vector<std::uint8_t> kept_;
};

}  // namespace plumbline::validation
