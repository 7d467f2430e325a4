#include "simulator/trace/mat_containers.h"

#include <cstdint>
#include <cstring>

namespace plumbline {
namespace {

constexpr std::size_t kHeader = 128;
constexpr std::size_t kTag = 8;
constexpr std::uint32_t kMatrix = 14;  // miMATRIX
constexpr unsigned kCell = 1, kStruct = 2;

/// Reads the parts of an element one after the other; past the end everything is zero.
class Bytes {
 public:
  Bytes(const std::string& bytes, std::size_t at) : bytes_(bytes), at_(at) {}

  std::uint32_t word(std::size_t offset) const {
    std::uint32_t value = 0;
    if (at_ + offset + sizeof value <= bytes_.size()) {
      std::memcpy(&value, bytes_.data() + at_ + offset, sizeof value);
    }
    return value;
  }
  std::string text(std::size_t offset, std::size_t length) const {
    return at_ + offset + length <= bytes_.size() ? bytes_.substr(at_ + offset, length) : "";
  }
  /// Behind a part with a tag and padding to 8 bytes.
  void skip_part() { at_ += kTag + (word(4) + std::size_t{7}) / 8 * 8; }
  void skip_tag() { at_ += kTag; }

 private:
  const std::string& bytes_;
  std::size_t at_;
};

/// The name of the element, if it is such a container.
std::optional<std::string> overgrown(Bytes element, std::size_t file_bytes) {
  element.skip_tag();
  const unsigned type = element.word(kTag) & 0xffU;
  if (type != kCell && type != kStruct) {
    return std::nullopt;
  }
  element.skip_part();  // array flags
  double count = 1.0;
  for (std::size_t i = 0; i < element.word(4) / 4 && i < 32; ++i) {
    count *= static_cast<double>(element.word(kTag + 4 * i));
  }
  if (count * static_cast<double>(kTag) <= static_cast<double>(file_bytes)) {
    return std::nullopt;
  }
  element.skip_part();  // dimensions
  const std::uint32_t tag = element.word(0);
  const bool small = (tag >> 16U) != 0;  // up to 4 bytes stand in the tag itself
  return small ? element.text(4, tag >> 16U) : element.text(kTag, element.word(4));
}

}  // namespace

std::optional<std::string> overgrown_container(const std::string& bytes) {
  const std::uint16_t one = 1;
  const bool little = reinterpret_cast<const unsigned char*>(&one)[0] == 1;
  if (bytes.size() < kHeader || bytes.substr(kHeader - 2, 2) != (little ? "IM" : "MI")) {
    return std::nullopt;
  }
  for (std::size_t at = kHeader; at + kTag <= bytes.size();) {
    const Bytes element(bytes, at);
    if (element.word(0) == kMatrix) {
      if (auto name = overgrown(element, bytes.size())) {
        return name;
      }
    }
    at += kTag + element.word(4);
  }
  return std::nullopt;
}

}  // namespace plumbline
