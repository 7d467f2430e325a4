// MCAP's channels as topics, found by the summary's index where there is one.
#include <algorithm>
#include <map>
#include <set>

#include "simulator/trace/bag.h"
#include "simulator/trace/error.h"
#include "simulator/trace/mcap_file.h"

namespace plumbline {
namespace {

struct Schema {
  std::string name, encoding, data;
};

struct Channel {
  std::uint16_t schema = 0;
  std::string topic, encoding;
  long count = 0;
  std::uint64_t first = UINT64_MAX, last = 0;  ///< ns, of receipt
};

struct ChunkPlace {
  std::uint64_t at = 0;
  std::set<std::uint16_t> channels;  ///< in it; empty: it is not said
};

/// What the summary says that there is.
struct Totals {
  std::uint64_t messages = 0, chunks = 0;
};

class McapBag : public Bag {
 public:
  explicit McapBag(const std::string& path) : file_(path) {
    if (!read_summary()) {
      read_through();
    }
  }

  const std::string& path() const override { return file_.path(); }

  std::vector<BagTopic> topics() const override {
    std::vector<BagTopic> all;
    for (const auto& [id, channel] : channels_) {
      const auto same = std::find_if(all.begin(), all.end(), [&, &wanted = channel](const BagTopic& one) {
        return one.name == wanted.topic && one.type == schema_of(wanted).name &&
               one.encoding == wanted.encoding;
      });
      const double seconds =
          channel.last > channel.first ? 1e-9 * static_cast<double>(channel.last - channel.first) : 0.0;
      if (same != all.end()) {  // several programs that sent it
        same->count += channel.count;
        same->seconds = std::max(same->seconds, seconds);
        continue;
      }
      const Schema& schema = schema_of(channel);
      all.push_back({channel.topic, schema.name, channel.encoding, schema.encoding, schema.data,
                     channel.count, seconds});
    }
    return all;
  }

  void read(const BagTopic& topic, const Receiver& receive) const override {
    std::set<std::uint16_t> ids;
    for (const auto& [id, channel] : channels_) {
      if (channel.topic == topic.name && schema_of(channel).name == topic.type &&
          channel.encoding == topic.encoding) {
        ids.insert(id);
      }
    }
    const McapFile::Visitor visit = [&](McapOp kind, std::uint64_t at, std::string_view content) {
      if (kind == McapOp::message) {
        McapCursor fields(path(), at, "message", content);
        const bool asked = ids.count(fields.u16()) > 0;
        fields.u32();  // its number
        const auto receipt = static_cast<std::int64_t>(fields.u64());
        fields.u64();  // when it was sent
        if (asked) {
          receive(receipt, fields.rest());
        }
      }
    };
    if (chunks_.empty()) {
      each_record(visit);
      return;
    }
    for (const ChunkPlace& chunk : chunks_) {
      const auto has = [&](std::uint16_t id) { return chunk.channels.count(id) > 0; };
      if (chunk.channels.empty() || std::any_of(ids.begin(), ids.end(), has)) {
        file_.each_in_chunk(chunk.at, file_.record(chunk.at, McapOp::chunk), visit);
      }
    }
  }

 private:
  const Schema& schema_of(const Channel& channel) const {
    static const Schema kNone;
    const auto found = schemas_.find(channel.schema);
    return found == schemas_.end() ? kNone : found->second;
  }

  /// The data section with its chunks opened.
  void each_record(const McapFile::Visitor& visit) const {
    file_.each_data_record([&](McapOp kind, std::uint64_t at, std::string_view content) {
      if (kind == McapOp::chunk) {
        file_.each_in_chunk(at, content, visit);
      } else {
        visit(kind, at, content);
      }
    });
  }

  void declare(McapOp kind, std::uint64_t at, std::string_view content) {
    McapCursor fields(path(), at, kind == McapOp::schema ? "schema" : "channel", content);
    const std::uint16_t id = fields.u16();
    if (kind == McapOp::schema) {
      Schema& schema = schemas_[id];
      schema.name = fields.text();
      schema.encoding = fields.text();
      schema.data = fields.text();
    } else {
      Channel& channel = channels_[id];
      channel.schema = fields.u16();
      channel.topic = fields.text();
      channel.encoding = fields.text();
    }
  }

  /// True where it says all that is needed: channels, how many messages each has, and every chunk.
  bool read_summary() {
    if (file_.footer().summary == 0) {
      return false;
    }
    Totals totals;
    file_.each_record(file_.footer().summary, file_.footer().at,
                      [&](McapOp kind, std::uint64_t at, std::string_view content) {
                        if (kind == McapOp::schema || kind == McapOp::channel) {
                          declare(kind, at, content);
                        } else if (kind == McapOp::chunk_index) {
                          read_chunk_index(at, content);
                        } else if (kind == McapOp::statistics) {
                          totals = read_statistics(at, content);
                        }
                      });
    std::uint64_t counted = 0;
    bool declared = !channels_.empty();
    for (const auto& [id, channel] : channels_) {
      counted += static_cast<std::uint64_t>(channel.count);
      declared = declared && !channel.topic.empty();
    }
    const bool complete =
        declared && !chunks_.empty() && chunks_.size() == totals.chunks && counted == totals.messages;
    if (!complete) {
      chunks_.clear();
      channels_.clear();
      schemas_.clear();
    }
    return complete;
  }

  void read_chunk_index(std::uint64_t at, std::string_view content) {
    McapCursor fields(path(), at, "chunk index", content);
    fields.bytes(16);  // earliest and latest message
    ChunkPlace chunk;
    chunk.at = fields.u64();
    fields.u64();  // its length, which its record says too
    McapCursor offsets(path(), at, "chunk index", fields.bytes(fields.u32()));
    while (!offsets.at_end()) {
      chunk.channels.insert(offsets.u16());
      offsets.u64();
    }
    chunks_.push_back(std::move(chunk));
  }

  /// The file's duration stands for that of each channel.
  Totals read_statistics(std::uint64_t at, std::string_view content) {
    McapCursor fields(path(), at, "statistics", content);
    Totals totals;
    totals.messages = fields.u64();
    fields.u16();      // schemas
    fields.bytes(12);  // channels, attachments, metadata
    totals.chunks = fields.u32();
    const std::uint64_t first = fields.u64();
    const std::uint64_t last = fields.u64();
    McapCursor counts(path(), at, "statistics", fields.bytes(fields.u32()));
    while (!counts.at_end()) {
      Channel& channel = channels_[counts.u16()];
      channel.count = static_cast<long>(counts.u64());
      channel.first = first;
      channel.last = last;
    }
    return totals;
  }

  void read_through() {
    each_record([&](McapOp kind, std::uint64_t at, std::string_view content) {
      if (kind == McapOp::schema || kind == McapOp::channel) {
        declare(kind, at, content);
      } else if (kind == McapOp::message) {
        McapCursor fields(path(), at, "message", content);
        const auto found = channels_.find(fields.u16());
        if (found == channels_.end()) {
          file_.refuse(at, "a message of a channel that the file does not declare", "its channel before it");
        }
        fields.u32();  // its number
        const std::uint64_t receipt = fields.u64();
        found->second.count += 1;
        found->second.first = std::min(found->second.first, receipt);
        found->second.last = std::max(found->second.last, receipt);
      }
    });
  }

  McapFile file_;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  std::vector<ChunkPlace> chunks_;
};

}  // namespace

LogFile read_mcap_log(const std::string& path, const LogQuestion& question) {
  return read_bag(McapBag(path), question);
}

}  // namespace plumbline
