// Messages of ROS by hand, for tests of what reads them.
#pragma once

#include <cstdint>
#include <string>

namespace plumbline::test {

/// CDR: each value aligned to its size behind the four bytes of encapsulation.
class Cdr {
 public:
  template <typename T>
  Cdr& put(T value) {
    while ((bytes_.size() - 4) % sizeof(T) != 0) {
      bytes_.push_back('\0');
    }
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
    return *this;
  }
  Cdr& text(const std::string& text) {
    put(static_cast<std::uint32_t>(text.size() + 1));
    bytes_.append(text.c_str(), text.size() + 1);
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_ = std::string("\0\1\0\0", 4);
};

/// sensor_msgs/msg/JointState of a hip and a knee, at 1600000000 s and so many ns.
inline std::string joint_state(std::uint32_t nanoseconds, double first, double second) {
  Cdr cdr;
  cdr.put<std::int32_t>(1600000000).put(nanoseconds).text("base");
  cdr.put<std::uint32_t>(2).text("hip").text("knee");
  cdr.put<std::uint32_t>(2).put(first).put(second);
  cdr.put<std::uint32_t>(0).put<std::uint32_t>(0);
  return cdr.bytes();
}

}  // namespace plumbline::test
