#include "simulator/trace/ros_message.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <sstream>

#include "simulator/trace/error.h"

namespace plumbline {
namespace {

class Decoder {
 public:
  Decoder(const RosSource& source, const RosDefinitions& known, std::string_view bytes, RosEncoding encoding)
      : source_(source), known_(known), bytes_(bytes), is_cdr_(encoding == RosEncoding::cdr) {
    if (!is_cdr_) {
      return;
    }
    if (bytes.size() < 4 || bytes[0] != 0 || (bytes[1] != 0 && bytes[1] != 1)) {
      refuse("a message of another encoding", "plain CDR");
    }
    big_endian_ = bytes[1] == 0;
    bytes_.remove_prefix(4);
  }

  void message(const std::string& type, const std::string& path) {
    constexpr int kDeepest = 32;  // a type that holds itself has no end
    if (++depth_ > kDeepest) {
      refuse("types that hold each other without end", "a definition that can be read");
    }
    for (const RosField& field : fields_of(type)) {
      const std::string name = path.empty() ? field.name : path + "." + field.name;
      if (!field.is_array) {
        value(field.type, name);
        continue;
      }
      const long count = field.fixed_length >= 0 ? field.fixed_length : number<std::uint32_t>();
      if (count > static_cast<long>(bytes_.size())) {
        cut_off();
      }
      for (long i = 1; i <= count; ++i) {
        value(field.type, name + "." + std::to_string(i));
      }
    }
    --depth_;
  }

  RosValues result;

 private:
  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    throw InputError({source_.file, 0, source_.topic}, found, expected);
  }

  [[noreturn]] void cut_off() const { refuse("a message that ends early", "all its fields"); }

  const std::vector<RosField>& fields_of(const std::string& type) const {
    auto found = known_.find(short_ros_type(type));
    const std::size_t slash = type.rfind('/');
    if (found == known_.end() && slash != std::string::npos && type.substr(slash) == "/Header") {
      found = known_.find("std_msgs/Header");  // ROS 1 writes it without its package
    }
    if (found == known_.end()) {
      refuse("no definition of " + type, "one in the bag");
    }
    return found->second;
  }

  template <typename T>
  T number() {
    at_ = is_cdr_ ? (at_ + sizeof(T) - 1) / sizeof(T) * sizeof(T) : at_;
    if (at_ + sizeof(T) > bytes_.size()) {
      cut_off();
    }
    char raw[sizeof(T)];
    std::memcpy(raw, bytes_.data() + at_, sizeof(T));
    if (big_endian_) {
      std::reverse(raw, raw + sizeof(T));
    }
    at_ += sizeof(T);
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }

  template <typename T>
  void store(const std::string& path) {
    result.numbers.emplace_back(path, static_cast<double>(number<T>()));
  }

  template <typename Seconds>
  void time(const std::string& path) {
    const double seconds = number<Seconds>();
    result.numbers.emplace_back(path, seconds + 1e-9 * number<std::uint32_t>());
  }

  void text(const std::string& path) {
    const std::size_t length = number<std::uint32_t>();
    if (length > bytes_.size() - at_) {
      cut_off();
    }
    const std::size_t kept = is_cdr_ && length > 0 ? length - 1 : length;  // CDR counts the closing zero
    result.texts[path] = std::string(bytes_.substr(at_, kept));
    at_ += length;
  }

  void value(const std::string& type, const std::string& path) {
    constexpr long kMost = 100000;
    if (++values_ > kMost) {
      refuse("more than 100000 values in a message", "a topic of measurements, not of pictures");
    }
    using Store = void (Decoder::*)(const std::string&);
    static const std::map<std::string, Store> kPrimitives = {
        {"float64", &Decoder::store<double>},       {"float32", &Decoder::store<float>},
        {"int8", &Decoder::store<std::int8_t>},     {"uint8", &Decoder::store<std::uint8_t>},
        {"byte", &Decoder::store<std::uint8_t>},    {"char", &Decoder::store<std::uint8_t>},
        {"bool", &Decoder::store<std::uint8_t>},    {"int16", &Decoder::store<std::int16_t>},
        {"uint16", &Decoder::store<std::uint16_t>}, {"int32", &Decoder::store<std::int32_t>},
        {"uint32", &Decoder::store<std::uint32_t>}, {"int64", &Decoder::store<std::int64_t>},
        {"uint64", &Decoder::store<std::uint64_t>}, {"string", &Decoder::text},
        {"time", &Decoder::time<std::uint32_t>},    {"duration", &Decoder::time<std::int32_t>}};
    const auto primitive = kPrimitives.find(type.substr(0, type.find("<=")));
    if (primitive != kPrimitives.end()) {
      (this->*primitive->second)(path);
    } else if (short_ros_type(type) == "builtin_interfaces/Time" ||
               short_ros_type(type) == "builtin_interfaces/Duration") {
      time<std::int32_t>(path);
    } else {
      message(type, path);
    }
  }

  const RosSource& source_;
  const RosDefinitions& known_;
  std::string_view bytes_;
  bool is_cdr_;
  std::size_t at_ = 0;
  bool big_endian_ = false;
  int depth_ = 0;
  long values_ = 0;
};

}  // namespace

std::string short_ros_type(std::string type) {
  const std::size_t middle = type.find("/msg/");
  return middle == std::string::npos ? type : type.erase(middle, 4);
}

RosDefinitions parse_ros_definitions(const std::string& file, const std::string& type,
                                     const std::string& text) {
  RosDefinitions all;
  std::string current = short_ros_type(type);
  all[current];
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    RosField field;
    if (!(words >> field.type) || field.type.rfind("===", 0) == 0) {
      continue;
    }
    if (!(words >> field.name)) {
      throw InputError({file, 0, type}, "'" + line + "' in its definition", "a type and a name");
    }
    std::string rest;
    words >> rest;
    if (field.type == "MSG:") {
      current = short_ros_type(field.name);
      all[current];
      continue;
    }
    if (field.name.find('=') != std::string::npos || rest.rfind('=', 0) == 0) {
      continue;  // a constant
    }
    const std::size_t bracket = field.type.find('[');
    if (bracket != std::string::npos) {
      field.is_array = true;
      const std::string length = field.type.substr(bracket + 1);
      if (length.find_first_of("0123456789") == 0) {
        field.fixed_length = std::atol(length.c_str());
      }
      field.type.erase(bracket);
    }
    const bool plain = std::islower(static_cast<unsigned char>(field.type[0])) != 0;
    if (!plain && field.type.find('/') == std::string::npos) {
      field.type = current.substr(0, current.find('/') + 1) + field.type;
    }
    all[current].push_back(field);
  }
  return all;
}

const RosDefinitions& common_ros_definitions() {
  static const RosDefinitions kCommon = parse_ros_definitions("", "std_msgs/Header", R"(
builtin_interfaces/Time stamp
string frame_id
MSG: sensor_msgs/JointState
std_msgs/Header header
string[] name
float64[] position
float64[] velocity
float64[] effort
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z
MSG: geometry_msgs/Quaternion
float64 x
float64 y
float64 z
float64 w
MSG: geometry_msgs/Pose
Point position
Quaternion orientation
MSG: geometry_msgs/PoseWithCovariance
Pose pose
float64[36] covariance
MSG: geometry_msgs/Twist
Vector3 linear
Vector3 angular
MSG: geometry_msgs/TwistWithCovariance
Twist twist
float64[36] covariance
MSG: nav_msgs/Odometry
std_msgs/Header header
string child_frame_id
geometry_msgs/PoseWithCovariance pose
geometry_msgs/TwistWithCovariance twist
MSG: sensor_msgs/Imu
std_msgs/Header header
geometry_msgs/Quaternion orientation
float64[9] orientation_covariance
geometry_msgs/Vector3 angular_velocity
float64[9] angular_velocity_covariance
geometry_msgs/Vector3 linear_acceleration
float64[9] linear_acceleration_covariance
MSG: geometry_msgs/Wrench
Vector3 force
Vector3 torque
MSG: geometry_msgs/WrenchStamped
std_msgs/Header header
Wrench wrench
MSG: std_msgs/MultiArrayDimension
string label
uint32 size
uint32 stride
MSG: std_msgs/MultiArrayLayout
MultiArrayDimension[] dim
uint32 data_offset
MSG: std_msgs/Float64MultiArray
MultiArrayLayout layout
float64[] data
MSG: std_msgs/Float32MultiArray
MultiArrayLayout layout
float32[] data
MSG: std_msgs/Float64
float64 data
)");
  return kCommon;
}

RosValues decode_ros_message(const RosSource& source, const std::string& type,
                             const RosDefinitions& definitions, std::string_view bytes,
                             RosEncoding encoding) {
  Decoder decoder(source, definitions, bytes, encoding);
  decoder.message(type, "");
  return std::move(decoder.result);
}

}  // namespace plumbline
