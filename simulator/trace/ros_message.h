// Messages of ROS: definitions as text, and values out of their serialised form.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace plumbline {

/// pkg/msg/Name and pkg/Name are one type: the second.
std::string short_ros_type(std::string type);

struct RosField {
  std::string type;
  std::string name;
  bool is_array = false;
  long fixed_length = -1;  ///< of an array; -1: the message says it
};

/// Fields by message type, `package/Name`.
using RosDefinitions = std::map<std::string, std::vector<RosField>>;

/// ros2msg or ros1msg text: the fields of `type`, and behind lines of = the types it uses (`MSG:
/// package/Name`). Throws InputError (file, type) for a line that is no field.
RosDefinitions parse_ros_definitions(const std::string& file, const std::string& type,
                                     const std::string& text);

/// Joint states, IMU, odometry, wrenches and arrays of numbers, for bags that carry no definitions.
const RosDefinitions& common_ros_definitions();

struct RosValues {
  std::vector<std::pair<std::string, double>> numbers;  ///< by path; items of an array from 1
  std::map<std::string, std::string> texts;
};

/// cdr: OMG DDSI-RTPS 10.2, four bytes that say the order of bytes, then each value aligned to its size.
/// ros1: values one behind the other, low byte first.
enum class RosEncoding { cdr, ros1 };

/// Where a message comes from, for what is said of it.
struct RosSource {
  std::string file, topic;
};

/// Values of a message. Times and durations become seconds. Throws InputError (file, topic) for a message
/// that ends early, whose type has no definition, or that has more than 100000 values (a picture).
RosValues decode_ros_message(const RosSource& source, const std::string& type,
                             const RosDefinitions& definitions, std::string_view bytes,
                             RosEncoding encoding = RosEncoding::cdr);

}  // namespace plumbline
