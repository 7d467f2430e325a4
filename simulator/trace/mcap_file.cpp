#include "simulator/trace/mcap_file.h"

#include <zlib.h>

#include <algorithm>
#include <stdexcept>

#include "simulator/trace/error.h"

namespace plumbline {
namespace {

constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);
constexpr std::uint64_t kHead = 9;         // kind and length of a record
constexpr std::uint64_t kFooter = 20;      // its content
constexpr std::uint64_t kBlock = 1 << 20;  // bytes that are summed at a time

std::string place(std::uint64_t at) { return " at byte " + std::to_string(at); }

const char* kind_name(McapOp kind) {
  switch (kind) {
    case McapOp::header:
      return "header";
    case McapOp::footer:
      return "footer";
    case McapOp::schema:
      return "schema";
    case McapOp::channel:
      return "channel";
    case McapOp::message:
      return "message";
    case McapOp::chunk:
      return "chunk";
    case McapOp::chunk_index:
      return "chunk index";
    case McapOp::statistics:
      return "statistics";
    case McapOp::data_end:
      return "data end";
  }
  return "record";
}

/// Records that nobody asks for may be large (attachments): their content is not read.
bool is_read(McapOp kind) { return std::string_view(kind_name(kind)) != "record"; }

}  // namespace

std::string_view McapCursor::bytes(std::uint64_t count) {
  if (count > bytes_.size()) {
    throw InputError({file_, 0, ""}, std::string("a ") + kind_ + " that ends early" + place(at_),
                     "all its fields");
  }
  const std::string_view taken = bytes_.substr(0, count);
  bytes_.remove_prefix(count);
  return taken;
}

std::uint64_t McapCursor::number(std::size_t size) {
  std::uint64_t value = 0;
  const std::string_view raw = bytes(size);
  for (std::size_t i = size; i-- > 0;) {
    value = value << 8U | static_cast<unsigned char>(raw[i]);
  }
  return value;
}

std::uint32_t mcap_crc(std::string_view bytes, std::uint32_t before) {
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

McapFile::McapFile(const std::string& path) : path_(path), in_(path, std::ios::binary | std::ios::ate) {
  if (!in_) {
    throw InputError({path, 0, ""}, "no such file, or one that cannot be read", "an MCAP recording");
  }
  size_ = static_cast<std::uint64_t>(in_.tellg());
  if (size_ < kMagic.size() || read(0, kMagic.size()) != kMagic) {
    throw InputError({path, 0, ""}, "a file without MCAP's first bytes", "an MCAP recording of version 0");
  }
  const std::uint64_t tail = kHead + kFooter + kMagic.size();
  if (size_ < kMagic.size() + tail || read(size_ - kMagic.size(), kMagic.size()) != kMagic) {
    throw InputError({path, 0, ""}, "a recording that was cut off after " + std::to_string(size_) + " bytes",
                     "one that was closed; `mcap recover` closes what is there");
  }
  footer_.at = size_ - tail;
  const std::string content = record(footer_.at, McapOp::footer);
  McapCursor fields(path_, footer_.at, "footer", content);
  footer_.summary = fields.u64();
  fields.u64();  // where the groups of the summary are
  const std::uint32_t crc = fields.u32();
  if (footer_.summary > footer_.at) {
    refuse(footer_.at, "a summary behind the file's end", "one before it");
  }
  const std::uint64_t crc_end = footer_.at + kHead + kFooter - 4;
  if (footer_.summary != 0 && crc != 0 && mcap_crc(read(footer_.summary, crc_end - footer_.summary)) != crc) {
    refuse(footer_.summary, "a summary whose CRC does not agree", "an undamaged file");
  }
}

void McapFile::refuse(std::uint64_t at, const std::string& found, const std::string& expected) const {
  throw InputError({path_, 0, ""}, found + place(at), expected);
}

std::string McapFile::read(std::uint64_t at, std::uint64_t count) const {
  if (at > size_ || count > size_ - at) {
    refuse(at, std::to_string(count) + " bytes that are not there", "a file that was not cut off");
  }
  std::string bytes(count, '\0');
  in_.clear();
  in_.seekg(static_cast<std::streamoff>(at));
  if (!in_.read(bytes.data(), static_cast<std::streamsize>(count))) {
    refuse(at, std::to_string(count) + " bytes that cannot be read", "a readable file");
  }
  return bytes;
}

std::string McapFile::record(std::uint64_t at, McapOp kind) const {
  std::string content;
  bool found = false;
  if (at < size_) {
    const std::string head = read(at, std::min(kHead, size_ - at));
    McapCursor fields(path_, at, "record", head);
    const auto is = static_cast<McapOp>(fields.bytes(1)[0]);
    const std::uint64_t length = fields.u64();
    found = is == kind;
    content = found ? read(at + kHead, length) : "";
  }
  if (!found) {
    refuse(at, std::string("no ") + kind_name(kind), "one");
  }
  return content;
}

void McapFile::each_record(std::uint64_t begin, std::uint64_t end, const Visitor& visit) const {
  for (std::uint64_t at = begin; at < end;) {
    const std::string head = read(at, std::min(kHead, size_ - at));
    McapCursor fields(path_, at, "record", head);
    const auto kind = static_cast<McapOp>(fields.bytes(1)[0]);
    const std::uint64_t length = fields.u64();
    if (length > end - std::min(end, at + kHead)) {
      refuse(at, "a record of " + std::to_string(length) + " bytes, more than there are",
             "an undamaged file");
    }
    visit(kind, at, is_read(kind) ? read(at + kHead, length) : "");
    at += kHead + length;
  }
}

void McapFile::each_data_record(const Visitor& visit) const {
  bool ended = false;
  each_record(kMagic.size(), footer_.summary != 0 ? footer_.summary : footer_.at,
              [&](McapOp kind, std::uint64_t at, std::string_view content) {
                if (!ended && kind == McapOp::data_end) {
                  check_data_crc(at, McapCursor(path_, at, "data end", content).u32());
                }
                ended = ended || kind == McapOp::data_end;
                if (!ended) {
                  visit(kind, at, content);
                }
              });
}

void McapFile::check_data_crc(std::uint64_t end, std::uint32_t expected) const {
  if (expected == 0) {
    return;  // the writer did not sum
  }
  std::uint32_t crc = 0;
  for (std::uint64_t at = 0; at < end; at += kBlock) {
    crc = mcap_crc(read(at, std::min(kBlock, end - at)), crc);
  }
  if (crc != expected) {
    refuse(end, "data whose CRC does not agree", "an undamaged file");
  }
}

void McapFile::each_in_chunk(std::uint64_t at, std::string_view chunk, const Visitor& visit) const {
  McapCursor fields(path_, at, "chunk", chunk);
  fields.bytes(16);  // earliest and latest message
  const std::uint64_t size = fields.u64();
  const std::uint32_t crc = fields.u32();
  const std::string compression = fields.text();
  const std::string_view packed = fields.bytes(fields.u64());
  std::string unpacked;
  try {
    if (compression == "lz4") {
      unpacked = decompress_lz4(packed, size);
    } else if (compression == "zstd") {
      unpacked = decompress_zstd(packed, size);
    } else if (!compression.empty()) {
      refuse(at, "a chunk in \"" + compression + "\"", "lz4, zstd or no compression");
    }
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    refuse(at, "a chunk that " + compression + " cannot unpack (" + error.what() + ")", "an undamaged file");
  }
  const std::string_view records = compression.empty() ? packed : std::string_view(unpacked);
  if (records.size() != size) {
    refuse(at, "a chunk of another size than it states", "an undamaged file");
  }
  if (crc != 0 && mcap_crc(records) != crc) {
    refuse(at, "a chunk whose CRC does not agree", "an undamaged file");
  }
  McapCursor rest(path_, at, "chunk", records);
  while (!rest.at_end()) {
    const auto kind = static_cast<McapOp>(rest.bytes(1)[0]);
    visit(kind, at, rest.bytes(rest.u64()));
  }
}

}  // namespace plumbline
