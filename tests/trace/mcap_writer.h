// MCAP files by the format's byte layout (mcap.dev/spec), for tests: whole ones and damaged ones.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace plumbline::test {

struct McapTopic {
  std::string name, type;
  std::string definition{};
  std::string encoding = "cdr", definition_encoding = "ros2msg";
};

struct McapMessage {
  std::size_t topic = 0;
  std::uint64_t receipt = 0;  ///< ns
  std::string bytes;
};

struct McapLayout {
  bool chunks = true;         ///< else messages stand in the data section itself
  std::string compression{};  ///< of the chunks: lz4, zstd or none; another is written down, not done
  std::size_t per_chunk = 3;  ///< messages
  bool summary = true;        ///< with statistics and chunk index
  bool crc = true;            ///< else they are 0: not summed
  bool spoil_chunk_crc = false, spoil_summary_crc = false, spoil_data_crc = false;
};

/// The whole file. Strange records (an attachment, one of a private kind) stand between the others.
std::string mcap_file(const std::vector<McapTopic>& topics, const std::vector<McapMessage>& messages,
                      const McapLayout& layout = {});

/// The definition of sensor_msgs/msg/JointState as recorders write it, comments and all.
extern const char* const kJointStateDefinition;

}  // namespace plumbline::test
