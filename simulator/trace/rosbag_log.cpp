// rosbag2's sqlite3 storage.
#include <sqlite3.h>

#include <memory>

#include "simulator/trace/bag.h"
#include "simulator/trace/error.h"

namespace plumbline {
namespace {

using Statement = std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)>;

class Base {
 public:
  explicit Base(const std::string& path) : path_(path), base_(nullptr, sqlite3_close) {
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

class SqliteBag : public Bag {
 public:
  explicit SqliteBag(const std::string& path) : path_(path), base_(path) {}
  const std::string& path() const override { return path_; }

  std::vector<BagTopic> topics() const override {
    std::vector<BagTopic> topics;
    const Statement row = base_.ask(
        "SELECT t.name, t.type, t.serialization_format, COUNT(m.id), (MAX(m.timestamp) - "
        "MIN(m.timestamp)) * 1e-9 FROM topics t LEFT JOIN messages m ON m.topic_id = t.id GROUP BY t.id");
    while (base_.next(row)) {
      topics.push_back({text(row, 0), text(row, 1), text(row, 2), "", "",
                        static_cast<long>(sqlite3_column_int64(row.get(), 3)),
                        sqlite3_column_double(row.get(), 4)});
    }
    add_definitions(topics);
    return topics;
  }

  void read(const BagTopic& topic, const Receiver& receive) const override {
    const Statement row = base_.ask(
        "SELECT m.timestamp, m.data FROM messages m JOIN topics t ON m.topic_id = t.id WHERE t.name = ? "
        "ORDER BY m.timestamp, m.id");
    sqlite3_bind_text(row.get(), 1, topic.name.c_str(), -1, SQLITE_TRANSIENT);
    while (base_.next(row)) {
      const char* data = static_cast<const char*>(sqlite3_column_blob(row.get(), 1));
      receive(sqlite3_column_int64(row.get(), 0),
              {data, static_cast<std::size_t>(sqlite3_column_bytes(row.get(), 1))});
    }
  }

 private:
  /// Newer bags have a table of them.
  void add_definitions(std::vector<BagTopic>& topics) const {
    if (!base_.next(base_.ask("SELECT 1 FROM sqlite_master WHERE name = 'message_definitions'"))) {
      return;
    }
    const Statement row =
        base_.ask("SELECT topic_type, encoding, encoded_message_definition FROM message_definitions");
    while (base_.next(row)) {
      for (BagTopic& topic : topics) {
        if (topic.type == text(row, 0) && topic.definition_encoding != "ros2msg") {
          topic.definition_encoding = text(row, 1);
          topic.definition = text(row, 2);
        }
      }
    }
  }

  std::string path_;
  Base base_;
};

}  // namespace

LogFile read_rosbag_log(const std::string& path, const LogQuestion& question) {
  return read_bag(SqliteBag(path), question);
}

}  // namespace plumbline
