// Recordings of ROS, whatever file they are in: topics with messages, and topics as a table.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "simulator/trace/log_file.h"

namespace plumbline {

struct BagTopic {
  std::string name;
  std::string type;                 ///< package/msg/Name, of ROS 1 package/Name
  std::string encoding;             ///< of the messages: cdr or ros1 can be read
  std::string definition_encoding;  ///< ros2msg or ros1msg can be read; empty: the file has no definition
  std::string definition;
  long count = 0;      ///< messages
  double seconds = 0;  ///< from the first to the last, as far as the file says it without being read
};

/// A file with topics. Everything that throws throws InputError with the file's name.
class Bag {
 public:
  virtual ~Bag() = default;
  virtual const std::string& path() const = 0;
  virtual std::vector<BagTopic> topics() const = 0;
  /// Gets the time of receipt in ns and the message as it was sent.
  using Receiver = std::function<void(std::int64_t receipt, std::string_view message)>;
  /// All messages of a topic, in any order.
  virtual void read(const BagTopic& topic, const Receiver& receive) const = 0;
};

/// The topics that `wanted` columns begin with and those of `topics`, in this order; none of both: the only
/// one whose type is a usual one of measurements, else the only one that can be read. Rows are the messages
/// of the first in the order of their receipt; columns TOPIC.FIELD, of joint states by the joint's name, and
/// TOPIC.log_time, the receipt in s. Columns of a further topic are brought to these rows (see below).
/// Throws InputError with the list of topics, or with the topic whose messages cannot be read.
LogFile read_bag(const Bag& bag, const LogQuestion& question);

/// Brings a column to other times: `held` takes the last value at or before each, otherwise straight lines
/// between two that are at most five median steps apart. NaN where there is none. `from` rises.
Eigen::VectorXd at_times(const Eigen::VectorXd& from, const Eigen::VectorXd& values,
                         const Eigen::VectorXd& to, bool held);

}  // namespace plumbline
