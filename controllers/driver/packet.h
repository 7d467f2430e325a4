// What goes over the wire between driver and robot: one fixed layout, little-endian, both ways.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace plumbline::driver {

/// A packet of n values has 44 + 8 n bytes:
///
///   offset  bytes  what
///   0       4      "PLB1"
///   4       2      version of the layout, 1
///   6       2      kind: 1 sensors (robot to driver), 2 commands (driver to robot)
///   8       4      session: chosen by the driver at its start, repeated by the robot
///   12      4      sequence: grows by 1 with each packet of this kind; a robot's time is sequence times
///   period 16      4      echo: sequence of the newest packet that the sender has accepted from the other
///   side 20      4      layout: CRC-32C of the channels' and commands' names (layout_of) 24      8 sender's
///   monotonic clock, ns 32      4      flags: below 36      2      n, at most 128 38      2      0 40      8
///   n    values: signed whole numbers for counts and switches, IEEE 754 doubles for the others 40+8n   4
///   CRC-32C of all bytes before
struct Packet {
  static constexpr std::size_t most_values = 128;
  static constexpr std::size_t largest = 44 + 8 * most_values;
  static constexpr std::uint16_t version = 1;
  enum Kind : std::uint16_t { sensors = 1, commands = 2 };

  std::uint16_t kind = sensors;
  std::uint32_t session = 0;
  std::uint32_t sequence = 0;
  std::uint32_t echo = 0;
  std::uint32_t layout = 0;
  std::uint64_t time = 0;
  std::uint32_t flags = 0;
  std::uint16_t count = 0;
  std::array<std::uint64_t, most_values> values{};  ///< as on the wire

  std::int64_t whole(std::size_t k) const { return static_cast<std::int64_t>(values[k]); }
  double real(std::size_t k) const {
    double value = 0.0;
    std::memcpy(&value, &values[k], sizeof value);
    return value;
  }
  void set_whole(std::size_t k, std::int64_t value) { values[k] = static_cast<std::uint64_t>(value); }
  void set_real(std::size_t k, double value) { std::memcpy(&values[k], &value, sizeof value); }
};

/// Flags of a robot's packet.
namespace robot_flag {
constexpr std::uint32_t power = 1;           ///< the motors' power is on
constexpr std::uint32_t emergency_stop = 2;  ///< a button is pressed
constexpr std::uint32_t tripped = 4;         ///< the robot's watchdog has cut the power; a reset clears it
constexpr std::uint32_t held = 8;            ///< something (a stand, a crane) holds the robot
}  // namespace robot_flag

/// Flags of a driver's packet.
namespace driver_flag {
constexpr std::uint32_t power = 1;    ///< the driver asks for power: it holds or runs
constexpr std::uint32_t running = 2;  ///< the controller commands
constexpr std::uint32_t reset = 4;    ///< forget that the watchdog has cut the power
}  // namespace driver_flag

/// Castagnoli's CRC as in RFC 3720 (iSCSI): reflected polynomial 0x82F63B78, start and end inverted.
std::uint32_t crc32c(const std::uint8_t* data, std::size_t size) noexcept;

/// The names in their order, each followed by a line feed, those of the commands behind an empty line.
std::uint32_t layout_of(const std::vector<std::string>& channels, const std::vector<std::string>& commands);

/// Writes into a buffer of Packet::largest bytes; returns how many.
std::size_t encode(const Packet& packet, std::uint8_t* buffer) noexcept;

/// False for anything but a whole packet of this version with the right CRC.
bool decode(const std::uint8_t* data, std::size_t size, Packet& packet) noexcept;

}  // namespace plumbline::driver
