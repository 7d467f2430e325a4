#include "tests/trace/mcap_writer.h"

#include <lz4frame.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>

namespace plumbline::test {
namespace {

std::string little(std::uint64_t value, int size) {
  std::string bytes;
  for (int i = 0; i < size; ++i) {
    bytes += i < 8 ? static_cast<char>(value >> (8 * i) & 0xffU) : '\0';
  }
  return bytes;
}

std::string text(const std::string& bytes) { return little(bytes.size(), 4) + bytes; }

std::string record(int kind, const std::string& content) {
  return little(static_cast<std::uint64_t>(kind), 1) + little(content.size(), 8) + content;
}

std::uint64_t crc(const std::string& bytes) {
  return crc32(0, reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<unsigned>(bytes.size()));
}

std::string packed(const std::string& bytes, const std::string& how) {
  std::string out;
  if (how == "lz4") {
    out.resize(LZ4F_compressFrameBound(bytes.size(), nullptr));
    out.resize(LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), nullptr));
  } else if (how == "zstd") {
    out.resize(ZSTD_compressBound(bytes.size()));
    out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 3));
  } else {
    out = bytes;
  }
  return out;
}

class Writer {
 public:
  Writer(const std::vector<McapTopic>& topics, const McapLayout& layout) : topics_(topics), layout_(layout) {}

  std::string file(const std::vector<McapMessage>& messages) {
    out_ = "\x89MCAP0\r\n" + record(1, text("ros2") + text("a test's own writer"));
    const std::string attachment =
        little(0, 16) + text("notes.txt") + text("text/plain") + little(5, 8) + "notes" + little(0, 4);
    out_ += record(9, attachment);
    write_data(messages);
    out_ += record(0x90, "of a private kind");
    const std::uint64_t data_crc = layout_.crc ? crc(out_) : 0;
    out_ += record(15, little(data_crc + (layout_.spoil_data_crc ? 1 : 0), 4));
    write_end(messages);
    return out_;
  }

 private:
  std::string declarations() const {
    std::string all;
    for (std::size_t i = 0; i < topics_.size(); ++i) {
      const McapTopic& topic = topics_[i];
      const std::string id = little(i + 1, 2);
      all += record(3, id + text(topic.type) + text(topic.definition_encoding) + text(topic.definition));
      all += record(4, id + id + text(topic.name) + text(topic.encoding) + text(text("key") + text("value")));
    }
    return all;
  }

  void write_data(const std::vector<McapMessage>& messages) {
    std::string batch = declarations();
    std::vector<McapMessage> within;
    for (const McapMessage& message : messages) {
      batch += record(5, little(message.topic + 1, 2) + little(0, 4) + little(message.receipt, 8) +
                             little(message.receipt, 8) + message.bytes);
      within.push_back(message);
      if (layout_.chunks && within.size() == layout_.per_chunk) {
        write_chunk(batch, within);
        batch.clear();
        within.clear();
      }
    }
    if (!layout_.chunks) {
      out_ += batch;
    } else if (!within.empty()) {
      write_chunk(batch, within);
    }
  }

  void write_chunk(const std::string& batch, const std::vector<McapMessage>& messages) {
    const std::uint64_t at = out_.size();
    const std::string records = packed(batch, layout_.compression);
    const std::string times = little(messages.front().receipt, 8) + little(messages.back().receipt, 8);
    const std::uint64_t sum = layout_.crc ? crc(batch) + (layout_.spoil_chunk_crc ? 1 : 0) : 0;
    out_ += record(6, times + little(batch.size(), 8) + little(sum, 4) + text(layout_.compression) +
                          little(records.size(), 8) + records);
    std::map<std::size_t, std::uint64_t> offsets;
    const std::uint64_t behind = out_.size();
    for (const McapMessage& message : messages) {
      if (offsets.emplace(message.topic, out_.size()).second) {
        out_ += record(7, little(message.topic + 1, 2) + text(""));
      }
    }
    std::string map;
    for (const auto& [topic, offset] : offsets) {
      map += little(topic + 1, 2) + little(offset, 8);
    }
    index_ += record(8, times + little(at, 8) + little(behind - at, 8) + text(map) +
                            little(out_.size() - behind, 8) + text(layout_.compression) +
                            little(records.size(), 8) + little(batch.size(), 8));
    ++chunks_;
  }

  std::string statistics(const std::vector<McapMessage>& messages) const {
    std::string counts;
    for (std::size_t i = 0; i < topics_.size(); ++i) {
      const auto count = std::count_if(messages.begin(), messages.end(),
                                       [&](const McapMessage& one) { return one.topic == i; });
      counts += little(i + 1, 2) + little(static_cast<std::uint64_t>(count), 8);
    }
    const std::uint64_t first = messages.empty() ? 0 : messages.front().receipt;
    const std::uint64_t last = messages.empty() ? 0 : messages.back().receipt;
    return record(11, little(messages.size(), 8) + little(topics_.size(), 2) + little(topics_.size(), 4) +
                          little(1, 4) + little(0, 4) + little(chunks_, 4) + little(first, 8) +
                          little(last, 8) + text(counts));
  }

  void write_end(const std::vector<McapMessage>& messages) {
    const std::uint64_t start = layout_.summary ? out_.size() : 0;
    const std::string summary =
        layout_.summary ? declarations() + statistics(messages) + index_ : std::string();
    std::string footer = little(2, 1) + little(20, 8) + little(start, 8) + little(0, 8);
    const std::uint64_t sum = layout_.crc && layout_.summary ? crc(summary + footer) : 0;
    footer += little(sum + (layout_.spoil_summary_crc ? 1 : 0), 4);
    out_ += summary + footer + "\x89MCAP0\r\n";
  }

  const std::vector<McapTopic>& topics_;
  const McapLayout& layout_;
  std::string out_, index_;
  std::uint64_t chunks_ = 0;
};

}  // namespace

const char* const kJointStateDefinition = R"(# The state of joints
std_msgs/Header header

string[] name   # as in the robot's description
float64[] position
float64[] velocity
float64[] effort
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
)";

std::string mcap_file(const std::vector<McapTopic>& topics, const std::vector<McapMessage>& messages,
                      const McapLayout& layout) {
  return Writer(topics, layout).file(messages);
}

}  // namespace plumbline::test
