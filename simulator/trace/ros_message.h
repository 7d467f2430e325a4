// ROS 2 messages: definitions as text, and values out of their serialised form.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace plumbline {

struct RosField {
  std::string type;
  std::string name;
  bool is_array = false;
  long fixed_length = -1;  ///< of an array; -1: the message says it
};

/// Fields by message type, `package/Name`.
using RosDefinitions = std::map<std::string, std::vector<RosField>>;

/// ros2msg text: the fields of `type`, and behind lines of = the types it uses (`MSG: package/Name`).
/// Throws InputError (file, type) for a line that is no field.
RosDefinitions parse_ros_definitions(const std::string& file, const std::string& type,
                                     const std::string& text);

/// Joint states, IMU, odometry, wrenches and arrays of numbers, for bags that carry no definitions.
const RosDefinitions& common_ros_definitions();

struct RosValues {
  std::vector<std::pair<std::string, double>> numbers;  ///< by path; items of an array from 1
  std::map<std::string, std::string> texts;
};

/// Values of a message in CDR (OMG DDSI-RTPS 10.2: four bytes that say the order of bytes, then each value
/// aligned to its size). Times become seconds. Throws InputError for a message that ends early.
RosValues decode_ros_message(const std::string& file, const std::string& type,
                             const RosDefinitions& definitions, std::string_view bytes);

}  // namespace plumbline
