#include "controllers/driver/packet.h"

namespace plumbline::driver {
namespace {

constexpr std::size_t kHeader = 40;
constexpr std::uint8_t kMagic[4] = {'P', 'L', 'B', '1'};

constexpr std::array<std::uint32_t, 256> crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t n = 0; n < 256; ++n) {
    std::uint32_t c = n;
    for (int k = 0; k < 8; ++k) c = (c & 1U) != 0U ? 0x82F63B78U ^ (c >> 1U) : c >> 1U;
    table[n] = c;
  }
  return table;
}

constexpr std::array<std::uint32_t, 256> kTable = crc_table();

template <typename T>
void put(std::uint8_t* at, T value) noexcept {
  for (std::size_t k = 0; k < sizeof(T); ++k) at[k] = static_cast<std::uint8_t>(value >> (8 * k));
}

template <typename T>
T get(const std::uint8_t* at) noexcept {
  T value = 0;
  for (std::size_t k = 0; k < sizeof(T); ++k)
    value = static_cast<T>(value | (static_cast<T>(at[k]) << (8 * k)));
  return value;
}

}  // namespace

std::uint32_t crc32c(const std::uint8_t* data, std::size_t size) noexcept {
  std::uint32_t c = 0xFFFFFFFFU;
  for (std::size_t k = 0; k < size; ++k) c = kTable[(c ^ data[k]) & 0xFFU] ^ (c >> 8U);
  return c ^ 0xFFFFFFFFU;
}

std::uint32_t layout_of(const std::vector<std::string>& channels, const std::vector<std::string>& commands) {
  std::string text;
  for (const std::string& name : channels) text += name + "\n";
  text += "\n";
  for (const std::string& name : commands) text += name + "\n";
  return crc32c(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

std::size_t encode(const Packet& packet, std::uint8_t* buffer) noexcept {
  std::memcpy(buffer, kMagic, 4);
  put(buffer + 4, Packet::version);
  put(buffer + 6, packet.kind);
  put(buffer + 8, packet.session);
  put(buffer + 12, packet.sequence);
  put(buffer + 16, packet.echo);
  put(buffer + 20, packet.layout);
  put(buffer + 24, packet.time);
  put(buffer + 32, packet.flags);
  put(buffer + 36, packet.count);
  put(buffer + 38, std::uint16_t{0});
  for (std::size_t k = 0; k < packet.count; ++k) put(buffer + kHeader + 8 * k, packet.values[k]);
  const std::size_t end = kHeader + 8U * packet.count;
  put(buffer + end, crc32c(buffer, end));
  return end + 4;
}

bool decode(const std::uint8_t* data, std::size_t size, Packet& packet) noexcept {
  if (size < kHeader + 4 || std::memcmp(data, kMagic, 4) != 0) return false;
  const auto count = get<std::uint16_t>(data + 36);
  const std::size_t end = kHeader + 8U * count;
  if (count > Packet::most_values || size != end + 4 || get<std::uint16_t>(data + 4) != Packet::version ||
      get<std::uint16_t>(data + 38) != 0 || get<std::uint32_t>(data + end) != crc32c(data, end)) {
    return false;
  }
  packet.kind = get<std::uint16_t>(data + 6);
  if (packet.kind != Packet::sensors && packet.kind != Packet::commands) return false;
  packet.session = get<std::uint32_t>(data + 8);
  packet.sequence = get<std::uint32_t>(data + 12);
  packet.echo = get<std::uint32_t>(data + 16);
  packet.layout = get<std::uint32_t>(data + 20);
  packet.time = get<std::uint64_t>(data + 24);
  packet.flags = get<std::uint32_t>(data + 32);
  packet.count = count;
  for (std::size_t k = 0; k < count; ++k) packet.values[k] = get<std::uint64_t>(data + kHeader + 8 * k);
  return true;
}

}  // namespace plumbline::driver
