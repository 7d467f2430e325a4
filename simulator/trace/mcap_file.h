// MCAP (mcap.dev/spec) as a file of records: what stands where, checked against the file's length.
#pragma once

#include <cstdint>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>

namespace plumbline {

/// Kinds of records that are read; all others are stepped over, as the format asks.
enum class McapOp : unsigned char {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  chunk_index = 0x08,
  statistics = 0x0b,
  data_end = 0x0f
};

/// Values off the front of a record, low byte first. Throws InputError (file, byte) where it ends early.
class McapCursor {
 public:
  /// `at`: where the record begins in the file, for messages; `kind`: what it is.
  McapCursor(const std::string& file, std::uint64_t at, const char* kind, std::string_view bytes)
      : file_(file), at_(at), kind_(kind), bytes_(bytes) {}

  std::uint16_t u16() { return static_cast<std::uint16_t>(number(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(number(4)); }
  std::uint64_t u64() { return number(8); }
  std::string text() { return std::string(bytes(u32())); }
  std::string_view bytes(std::uint64_t count);
  std::string_view rest() { return bytes(bytes_.size()); }
  bool at_end() const { return bytes_.empty(); }

 private:
  std::uint64_t number(std::size_t size);

  const std::string& file_;
  std::uint64_t at_;
  const char* kind_;
  std::string_view bytes_;
};

/// CRC-32 of ISO 3309 (zlib's), which the format uses everywhere.
std::uint32_t mcap_crc(std::string_view bytes, std::uint32_t before = 0);

struct McapFooter {
  std::uint64_t at = 0;       ///< where its record begins
  std::uint64_t summary = 0;  ///< where the summary begins; 0: the file has none
};

class McapFile {
 public:
  /// Reads magic and footer and checks the summary's CRC. Throws InputError when the file is none or was cut
  /// off.
  explicit McapFile(const std::string& path);

  const std::string& path() const { return path_; }
  const McapFooter& footer() const { return footer_; }

  using Visitor = std::function<void(McapOp kind, std::uint64_t at, std::string_view content)>;
  /// The records from a byte on up to another, one after the other. Throws InputError where a record reaches
  /// beyond `end`.
  void each_record(std::uint64_t begin, std::uint64_t end, const Visitor& visit) const;
  /// The data section from its header to its end, whose CRC is checked.
  void each_data_record(const Visitor& visit) const;
  /// The records within a chunk, whose own record begins at `at`. Throws InputError for a compression that is
  /// not lz4, zstd or none, and for a CRC that does not agree.
  void each_in_chunk(std::uint64_t at, std::string_view chunk, const Visitor& visit) const;
  /// The content of the one record at a byte, which must be of this kind.
  std::string record(std::uint64_t at, McapOp kind) const;

  [[noreturn]] void refuse(std::uint64_t at, const std::string& found, const std::string& expected) const;

 private:
  std::string read(std::uint64_t at, std::uint64_t count) const;
  void check_data_crc(std::uint64_t end, std::uint32_t expected) const;

  std::string path_;
  mutable std::ifstream in_;
  std::uint64_t size_ = 0;
  McapFooter footer_;
};

/// What lz4 or zstd made of `size` bytes. Throws std::runtime_error with the reason.
std::string decompress_lz4(std::string_view bytes, std::uint64_t size);
std::string decompress_zstd(std::string_view bytes, std::uint64_t size);

}  // namespace plumbline
