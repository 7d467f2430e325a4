// Topics of a recording of ROS as one table.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

#include "simulator/trace/bag.h"
#include "simulator/trace/error.h"
#include "simulator/trace/ros_message.h"

namespace plumbline {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::string listed(const std::vector<BagTopic>& topics) {
  std::ostringstream list;
  for (const BagTopic& topic : topics) {
    list << (list.tellp() > 0 ? ", " : "") << topic.name << " (" << topic.type << ", " << topic.count;
    if (topic.seconds > 0) {
      list << ", " << std::lround(static_cast<double>(topic.count - 1) / topic.seconds) << " Hz";
    }
    list << ")";
  }
  return list.str();
}

std::string expected(const std::vector<BagTopic>& topics) {
  return topics.empty() ? "a bag with topics; it has none" : "one of: " + listed(topics);
}

bool has_own_definition(const BagTopic& topic) {
  return !topic.definition.empty() &&
         topic.definition_encoding == (topic.encoding == "ros1" ? "ros1msg" : "ros2msg");
}

bool can_be_read(const BagTopic& topic) {
  const bool usual =
      topic.encoding == "cdr" && common_ros_definitions().count(short_ros_type(topic.type)) > 0;
  return (topic.encoding == "cdr" || topic.encoding == "ros1") && (usual || has_own_definition(topic));
}

void require_readable(const std::string& path, const BagTopic& topic) {
  if (topic.encoding != "cdr" && topic.encoding != "ros1") {
    throw InputError({path, 0, topic.name}, "messages in " + topic.encoding, "cdr (ROS 2) or ros1");
  }
  if (!can_be_read(topic)) {
    throw InputError({path, 0, topic.name},
                     topic.definition_encoding.empty()
                         ? "no definition of " + topic.type
                         : "a definition of " + topic.type + " in " + topic.definition_encoding,
                     topic.encoding == "ros1" ? "one in ros1msg" : "one in ros2msg, or a usual type");
  }
}

/// What is measured most often, before all that can be read: a bag's log, its transforms, its pictures.
std::vector<BagTopic> likely(const std::vector<BagTopic>& topics) {
  std::vector<BagTopic> usual;
  std::vector<BagTopic> any;
  for (const BagTopic& topic : topics) {
    if (topic.count > 1 && can_be_read(topic)) {
      any.push_back(topic);
      if (common_ros_definitions().count(short_ros_type(topic.type)) > 0) {
        usual.push_back(topic);
      }
    }
  }
  return usual.empty() ? any : usual;
}

std::vector<BagTopic> chosen(const Bag& bag, const LogQuestion& question) {
  const std::vector<BagTopic> topics = bag.topics();
  std::vector<BagTopic> picked;
  const auto pick = [&](const std::string& asked, const auto& fits) {
    const auto found = std::find_if(topics.begin(), topics.end(), fits);
    if (found == topics.end()) {
      throw InputError({bag.path(), 0, asked}, "no such topic", expected(topics));
    }
    const auto same = [&](const BagTopic& one) { return one.name == found->name; };
    if (std::none_of(picked.begin(), picked.end(), same)) {
      picked.push_back(*found);
    }
  };
  for (const std::string& column : question.wanted) {
    pick(column, [&](const BagTopic& topic) { return column.rfind(topic.name + ".", 0) == 0; });
  }
  for (const std::string& name : question.topics) {
    pick(name, [&](const BagTopic& topic) { return topic.name == name; });
  }
  if (picked.empty()) {
    picked = likely(topics);
    if (picked.size() != 1) {
      throw InputError({bag.path(), 0, "topic"}, std::to_string(picked.size()) + " topics that fit",
                       expected(topics));
    }
  }
  return picked;
}

RosDefinitions definitions_of(const std::string& path, const BagTopic& topic) {
  RosDefinitions all = topic.encoding == "cdr" ? common_ros_definitions() : RosDefinitions{};
  if (has_own_definition(topic)) {
    for (auto& [name, fields] : parse_ros_definitions(path, topic.type, topic.definition)) {
      all[name] = fields;
    }
  }
  return all;
}

/// Joints by name: position.2 becomes position.elbow.
std::string column_name(const BagTopic& topic, const std::string& path, const RosValues& values) {
  const std::size_t dot = path.rfind('.');
  if (dot != std::string::npos && short_ros_type(topic.type) == "sensor_msgs/JointState") {
    const auto joint = values.texts.find("name" + path.substr(dot));
    if (joint != values.texts.end()) {
      return topic.name + "." + path.substr(0, dot + 1) + joint->second;
    }
  }
  return topic.name + "." + path;
}

/// Columns that grow with the messages; a message that has not a field leaves NaN.
class BagCollector {
 public:
  explicit BagCollector(const BagTopic& topic) : topic_(topic) {}

  void add(std::int64_t receipt, const RosValues& values) {
    const bool is_array = topic_.type.find("MultiArray") != std::string::npos;
    for (const auto& [name, value] : values.numbers) {
      if (is_array && name.rfind("layout.", 0) == 0) {
        continue;  // how the array is laid out is no measurement
      }
      store(column_name(topic_, name, values), name == "header.stamp" ? "s" : "", value);
    }
    store(topic_.name + ".log_time", "s", 1e-9 * static_cast<double>(receipt));
    receipts_.push_back(receipt);
  }

  std::vector<Column> columns() {
    std::vector<std::size_t> order(receipts_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return receipts_[a] < receipts_[b]; });
    std::vector<Column> all;
    for (std::size_t c = 0; c < names_.size(); ++c) {
      values_[c].resize(order.size(), kNone);
      Eigen::VectorXd sorted(static_cast<Eigen::Index>(order.size()));
      for (std::size_t k = 0; k < order.size(); ++k) {
        sorted[static_cast<Eigen::Index>(k)] = values_[c][order[k]];
      }
      all.push_back({names_[c].first, names_[c].second, std::move(sorted)});
    }
    return all;
  }

 private:
  void store(const std::string& name, const std::string& unit, double value) {
    const auto [place, is_new] = places_.emplace(name, names_.size());
    if (is_new) {
      names_.emplace_back(name, unit);
      values_.emplace_back();
    }
    std::vector<double>& column = values_[place->second];
    column.resize(receipts_.size() + 1, kNone);
    column.back() = std::isfinite(value) ? value : kNone;
  }

  const BagTopic& topic_;
  std::map<std::string, std::size_t> places_;
  std::vector<std::pair<std::string, std::string>> names_;
  std::vector<std::vector<double>> values_;
  std::vector<std::int64_t> receipts_;
};

std::vector<Column> columns_of(const Bag& bag, const BagTopic& topic) {
  require_readable(bag.path(), topic);
  const RosDefinitions definitions = definitions_of(bag.path(), topic);
  BagCollector rows(topic);
  bag.read(topic, [&](std::int64_t receipt, std::string_view message) {
    rows.add(receipt, decode_ros_message({bag.path(), topic.name}, topic.type, definitions, message,
                                         topic.encoding == "ros1" ? RosEncoding::ros1 : RosEncoding::cdr));
  });
  std::vector<Column> columns = rows.columns();
  if (columns.empty()) {
    throw InputError({bag.path(), 0, topic.name}, "no messages", "some");
  }
  return columns;
}

const Column* named(const std::vector<Column>& columns, const std::string& name) {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const Column& one) { return one.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

/// Two topics share the header's clock where both have headers and the receipt is not what was asked for.
std::string shared_clock(const LogQuestion& question, const BagTopic& first, const std::vector<Column>& rows,
                         const BagTopic& further, const std::vector<Column>& columns) {
  const std::string stamp = "header.stamp";
  const bool receipt = !question.wanted.empty() && question.wanted.front() == first.name + ".log_time";
  const bool both = named(rows, first.name + "." + stamp) != nullptr &&
                    named(columns, further.name + "." + stamp) != nullptr;
  return both && !receipt ? stamp : "log_time";
}

/// Only rows whose time rises can be looked up.
std::vector<Eigen::Index> rising(const Eigen::VectorXd& time) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index k = 0; k < time.size(); ++k) {
    if (std::isfinite(time[k]) && (rows.empty() || time[k] > time[rows.back()])) {
      rows.push_back(k);
    }
  }
  return rows;
}

void join(const LogQuestion& question, const BagTopic& first, const BagTopic& further,
          const std::vector<Column>& columns, LogFile& log) {
  const std::string clock = shared_clock(question, first, log.table.columns, further, columns);
  const Eigen::VectorXd to = named(log.table.columns, first.name + "." + clock)->values;
  const Eigen::VectorXd& from = named(columns, further.name + "." + clock)->values;
  const std::vector<Eigen::Index> rows = rising(from);
  for (const Column& column : columns) {
    // Who only looks at a bag should see the numbers that were sent.
    const bool held = question.wanted.empty() || question.held.count(column.name) > 0;
    log.table.columns.push_back(
        {column.name, column.unit, at_times(from(rows), column.values(rows), to, held)});
  }
  log.remarks.push_back("Columns of " + further.name + " are brought to the rows of " + first.name + " by " +
                        (clock == "log_time" ? "the time of receipt." : "their headers' stamps."));
}

}  // namespace

Eigen::VectorXd at_times(const Eigen::VectorXd& from, const Eigen::VectorXd& values,
                         const Eigen::VectorXd& to, bool held) {
  constexpr double kLongestGap = 5.0;  // median steps, as in a trial's own sampling
  std::vector<double> steps;
  for (Eigen::Index k = 1; k < from.size(); ++k) {
    steps.push_back(from[k] - from[k - 1]);
  }
  std::sort(steps.begin(), steps.end());
  const double longest = steps.empty() ? 0.0 : kLongestGap * steps[steps.size() / 2];
  Eigen::VectorXd at = Eigen::VectorXd::Constant(to.size(), kNone);
  for (Eigen::Index k = 0; k < to.size(); ++k) {
    const Eigen::Index next = std::upper_bound(from.begin(), from.end(), to[k]) - from.begin();
    if (!std::isfinite(to[k]) || next == 0) {
      continue;
    }
    const Eigen::Index last = next - 1;
    if (held || from[last] == to[k]) {
      at[k] = values[last];
    } else if (next < from.size() && from[next] - from[last] <= longest) {
      const double share = (to[k] - from[last]) / (from[next] - from[last]);
      at[k] = values[last] + share * (values[next] - values[last]);
    }
  }
  return at;
}

LogFile read_bag(const Bag& bag, const LogQuestion& question) {
  const std::vector<BagTopic> topics = chosen(bag, question);
  LogFile log;
  log.table.file = bag.path();
  log.table.columns = columns_of(bag, topics.front());
  for (std::size_t i = 1; i < topics.size(); ++i) {
    join(question, topics.front(), topics[i], columns_of(bag, topics[i]), log);
  }
  for (const BagTopic& topic : topics) {
    log.topics.push_back(topic.name);
  }
  if (question.wanted.empty()) {
    log.remarks.push_back("Read " + log.topics.front() + (topics.size() > 1 ? " and others" : "") +
                          ". The bag's topics are " + listed(bag.topics()) + ".");
  }
  for (const Column& column : log.table.columns) {
    for (Eigen::Index k = 0; k < column.values.size(); ++k) {
      if (std::isnan(column.values[k])) {
        note_bad_cell(column.name, {0, k + 1, "", true}, log);
      }
    }
  }
  return log;
}

}  // namespace plumbline
