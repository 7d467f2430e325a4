// rosbag2's sqlite3 storage: one topic as a table.
#include <sqlite3.h>

#include <cmath>
#include <limits>
#include <memory>
#include <sstream>

#include "simulator/trace/error.h"
#include "simulator/trace/log_file.h"
#include "simulator/trace/ros_message.h"

namespace plumbline {
namespace {

using Statement = std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)>;

struct Topic {
  int id = 0;
  std::string name, type, encoding;
  long count = 0;
  double seconds = 0;
};

class Bag {
 public:
  explicit Bag(const std::string& path) : path_(path), base_(nullptr, sqlite3_close) {
    sqlite3* base = nullptr;
    const int status = sqlite3_open_v2(path.c_str(), &base, SQLITE_OPEN_READONLY, nullptr);
    base_.reset(base);
    if (status != SQLITE_OK) {
      refuse();
    }
  }
  Statement ask(const std::string& question) const {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(base_.get(), question.c_str(), -1, &statement, nullptr) != SQLITE_OK) {
      refuse();
    }
    return {statement, sqlite3_finalize};
  }
  bool next(const Statement& statement) const {
    const int status = sqlite3_step(statement.get());
    if (status != SQLITE_ROW && status != SQLITE_DONE) {
      refuse();
    }
    return status == SQLITE_ROW;
  }

 private:
  [[noreturn]] void refuse() const {
    throw InputError({path_, 0, ""}, sqlite3_errmsg(base_.get()), "a bag of rosbag2");
  }
  std::string path_;
  std::unique_ptr<sqlite3, int (*)(sqlite3*)> base_;
};

std::string text(const Statement& row, int column) {
  const unsigned char* found = sqlite3_column_text(row.get(), column);
  return found == nullptr ? "" : reinterpret_cast<const char*>(found);
}

std::vector<Topic> topics_of(const Bag& bag) {
  std::vector<Topic> topics;
  const Statement row = bag.ask(
      "SELECT t.id, t.name, t.type, t.serialization_format, COUNT(m.id), (MAX(m.timestamp) - "
      "MIN(m.timestamp)) * 1e-9 FROM topics t LEFT JOIN messages m ON m.topic_id = t.id GROUP BY t.id");
  while (bag.next(row)) {
    topics.push_back({sqlite3_column_int(row.get(), 0), text(row, 1), text(row, 2), text(row, 3),
                      static_cast<long>(sqlite3_column_int64(row.get(), 4)),
                      sqlite3_column_double(row.get(), 5)});
  }
  return topics;
}

std::string listed(const std::vector<Topic>& topics) {
  std::ostringstream list;
  for (const Topic& topic : topics) {
    list << (list.tellp() > 0 ? ", " : "") << topic.name << " (" << topic.type << ", " << topic.count;
    if (topic.seconds > 0) {
      list << ", " << std::lround(static_cast<double>(topic.count - 1) / topic.seconds) << " Hz";
    }
    list << ")";
  }
  return list.str();
}

/// The message's definition in the bag (newer bags have a table of them), else a common one.
RosDefinitions definitions_of(const std::string& path, const Bag& bag, const std::string& type) {
  RosDefinitions all = common_ros_definitions();
  if (!bag.next(bag.ask("SELECT 1 FROM sqlite_master WHERE name = 'message_definitions'"))) {
    return all;
  }
  const Statement row = bag.ask(
      "SELECT encoded_message_definition FROM message_definitions WHERE encoding = 'ros2msg' AND topic_type "
      "= ?");
  sqlite3_bind_text(row.get(), 1, type.c_str(), -1, SQLITE_TRANSIENT);
  if (bag.next(row)) {
    for (auto& [name, fields] : parse_ros_definitions(path, type, text(row, 0))) {
      all[name] = fields;
    }
  }
  return all;
}

bool knows(const RosDefinitions& all, std::string type) {
  const std::size_t middle = type.find("/msg/");
  return all.count(middle == std::string::npos ? type : type.erase(middle, 4)) > 0;
}

/// The topic that the wanted columns begin with; when none is asked for, the only one that can be read.
Topic chosen(const std::string& path, const Bag& bag, const std::vector<std::string>& wanted) {
  const std::vector<Topic> topics = topics_of(bag);
  std::vector<Topic> fit;
  for (const Topic& topic : topics) {
    bool asked =
        wanted.empty() && topic.count > 1 && knows(definitions_of(path, bag, topic.type), topic.type);
    for (const std::string& column : wanted) {
      asked = asked || column.rfind(topic.name + ".", 0) == 0;
    }
    if (asked) {
      fit.push_back(topic);
    }
  }
  if (fit.size() != 1) {
    throw InputError({path, 0, "topic"}, std::to_string(fit.size()) + " topics that fit",
                     "one of: " + listed(topics));
  }
  if (fit.front().encoding != "cdr") {
    throw InputError({path, 0, fit.front().name}, "messages in " + fit.front().encoding, "cdr");
  }
  return fit.front();
}

/// Joints by name: position.2 becomes position.elbow.
std::string column_name(const Topic& topic, const std::string& path, const RosValues& values) {
  const std::size_t dot = path.rfind('.');
  if (dot != std::string::npos && topic.type == "sensor_msgs/msg/JointState") {
    const auto joint = values.texts.find("name" + path.substr(dot));
    if (joint != values.texts.end()) {
      return topic.name + "." + path.substr(0, dot + 1) + joint->second;
    }
  }
  return topic.name + "." + path;
}

}  // namespace

LogFile read_rosbag_log(const std::string& path, const std::vector<std::string>& wanted) {
  const Bag bag(path);
  const Topic topic = chosen(path, bag, wanted);
  const RosDefinitions definitions = definitions_of(path, bag, topic.type);
  LogFile log;
  log.table.file = path;
  std::map<std::string, std::size_t> places;
  long rows = 0;
  const auto store = [&](const std::string& name, const std::string& unit, double value) {
    const auto [place, is_new] = places.emplace(name, log.table.columns.size());
    if (is_new) {
      log.table.columns.push_back(
          {name, unit, Eigen::VectorXd::Constant(topic.count, std::numeric_limits<double>::quiet_NaN())});
    }
    if (std::isfinite(value)) {
      log.table.columns[place->second].values[rows] = value;
    }
  };
  const Statement row =
      bag.ask("SELECT timestamp, data FROM messages WHERE topic_id = " + std::to_string(topic.id) +
              " ORDER BY timestamp, id");
  for (; rows < topic.count && bag.next(row); ++rows) {
    const char* data = static_cast<const char*>(sqlite3_column_blob(row.get(), 1));
    const RosValues values = decode_ros_message(
        path, topic.type, definitions, {data, static_cast<std::size_t>(sqlite3_column_bytes(row.get(), 1))});
    for (const auto& [name, value] : values.numbers) {
      store(column_name(topic, name, values), name == "header.stamp" ? "s" : "", value);
    }
    store(topic.name + ".log_time", "s", 1e-9 * static_cast<double>(sqlite3_column_int64(row.get(), 0)));
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
