// The layout on the wire, byte by byte, and the two ways to send it.
#include "controllers/driver/packet.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <random>

#include "controllers/driver/json.h"
#include "controllers/driver/shared_memory.h"
#include "controllers/driver/udp.h"

namespace plumbline::driver {
namespace {

std::uint32_t crc(const std::vector<std::uint8_t>& bytes) { return crc32c(bytes.data(), bytes.size()); }

// RFC 3720, appendix B.4.
TEST(Packet, CrcIsThatOfRfc3720) {
  EXPECT_EQ(crc(std::vector<std::uint8_t>(32, 0)), 0x8A9136AAU);
  EXPECT_EQ(crc(std::vector<std::uint8_t>(32, 0xFF)), 0x62A8AB43U);
  std::vector<std::uint8_t> rising(32);
  for (std::size_t k = 0; k < 32; ++k) rising[k] = static_cast<std::uint8_t>(k);
  EXPECT_EQ(crc(rising), 0x46DD794EU);
}

Packet example() {
  Packet packet;
  packet.kind = Packet::sensors;
  packet.session = 0x01020304;
  packet.sequence = 5;
  packet.echo = 6;
  packet.layout = 7;
  packet.time = 8;
  packet.flags = robot_flag::power;
  packet.count = 2;
  packet.set_whole(0, -1);
  packet.set_real(1, 1.0);
  return packet;
}

TEST(Packet, LiesOnTheWireAsDocumented) {
  std::uint8_t bytes[Packet::largest];
  ASSERT_EQ(encode(example(), bytes), 60U);
  const std::vector<std::uint8_t> head(bytes, bytes + 56);
  const std::vector<std::uint8_t> expected = {
      'P', 'L', 'B',  '1',  1,    0,    1,    0,    4,    3,    2, 1, 5, 0, 0, 0, 6,    0,   0,
      0,   7,   0,    0,    0,    8,    0,    0,    0,    0,    0, 0, 0, 1, 0, 0, 0,    2,   0,
      0,   0,   0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0, 0, 0, 0, 0, 0, 0xF0, 0x3F};
  EXPECT_EQ(head, expected);
  Packet back;
  ASSERT_TRUE(decode(bytes, 60, back));
  EXPECT_EQ(back.session, 0x01020304U);
  EXPECT_EQ(back.whole(0), -1);
  EXPECT_EQ(back.real(1), 1.0);
}

// A CRC of 32 bits finds every single flipped bit, and every burst of up to 32.
TEST(Packet, EveryFlippedBitIsFound) {
  std::uint8_t bytes[Packet::largest];
  const std::size_t size = encode(example(), bytes);
  Packet back;
  for (std::size_t bit = 0; bit < 8 * size; ++bit) {
    bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1U << (bit % 8)));
    EXPECT_FALSE(decode(bytes, size, back)) << bit;
    bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1U << (bit % 8)));
  }
  for (std::size_t length = 0; length < size; ++length) EXPECT_FALSE(decode(bytes, length, back));
}

TEST(Packet, LayoutTellsNamesAndTheirOrder) {
  EXPECT_NE(layout_of({"a", "b"}, {"c"}), layout_of({"b", "a"}, {"c"}));
  EXPECT_NE(layout_of({"a", "b"}, {"c"}), layout_of({"a"}, {"b", "c"}));
}

void exchange(Transport& driver, Transport& robot) {
  std::uint8_t buffer[Packet::largest];
  EXPECT_EQ(robot.receive(buffer, sizeof buffer), 0U);
  EXPECT_FALSE(robot.wait(monotonic_now() + 1000000));
  std::uint8_t bytes[3] = {1, 2, 3};
  ASSERT_TRUE(driver.send(bytes, 3));
  ASSERT_TRUE(robot.wait(monotonic_now() + 1000000000));
  ASSERT_EQ(robot.receive(buffer, sizeof buffer), 3U);
  EXPECT_EQ(buffer[2], 3);
  usleep(3000);
  ASSERT_TRUE(robot.send(bytes, 2));
  const std::int64_t sent = monotonic_now();
  usleep(20000);
  ASSERT_TRUE(driver.wait(monotonic_now() + 1000000000));
  ASSERT_EQ(driver.receive(buffer, sizeof buffer), 2U);
  // It had come when it was sent, not when it was read.
  EXPECT_LT(std::abs(static_cast<double>(driver.arrived() - sent)), 15e6);
}

TEST(Transport, Udp) {
  Udp robot("127.0.0.1", "0", Side::robot);
  Udp driver("127.0.0.1", std::to_string(robot.port()), Side::driver);
  exchange(driver, robot);
}

TEST(Transport, SharedMemory) {
  const std::string name = "plumbline-test-" + std::to_string(getpid());
  EXPECT_THROW(SharedMemory(name, Side::driver), DriverError);
  SharedMemory robot(name, Side::robot);
  SharedMemory driver(name, Side::driver);
  exchange(driver, robot);
  std::uint8_t byte = 0;
  for (std::uint32_t k = 0; k < SharedQueues::slots; ++k) EXPECT_TRUE(driver.send(&byte, 1));
  EXPECT_FALSE(driver.send(&byte, 1));  // full: lost, not overwritten
}

TEST(Transport, RefusesOtherAddresses) {
  for (const char* address : {"", "udp", "udp:", "udp:localhost", "tcp:localhost:1", "shm:", "shm:a/b"}) {
    EXPECT_THROW(open_transport(address, Side::driver), DriverError) << address;
  }
}

}  // namespace
}  // namespace plumbline::driver
