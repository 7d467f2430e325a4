#include "simulator/trace/log_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "simulator/trace/error.h"

namespace plumbline {
namespace {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

bool is_hdf5(const std::string& path) {
  std::string head(8, '\0');
  std::ifstream(path, std::ios::binary).read(head.data(), static_cast<std::streamsize>(head.size()));
  return head == "\x89HDF\r\n\x1a\n";
}

/// A recorder of ROS writes a folder. In parts: which one, nobody but the user knows.
std::string file_of_bag(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    const std::string extension = extension_of(entry.path().string());
    if (extension == ".mcap" || extension == ".db3") {
      files.push_back(entry.path().string());
    }
  }
  if (files.size() != 1) {
    throw InputError({folder, 0, ""}, "a folder with " + std::to_string(files.size()) + " bags",
                     "a file, or a folder with one .mcap or .db3");
  }
  return files.front();
}

/// MATLAB's reader leaves NaN and infinities in the columns.
LogFile from_matlab(const std::string& path) {
  LogFile log;
  log.table = read_mat(path);
  for (Column& column : log.table.columns) {
    for (Eigen::Index k = 0; k < column.values.size(); ++k) {
      double& value = column.values[k];
      if (!std::isfinite(value)) {
        note_bad_cell(column.name, {0, k + 1, std::isnan(value) ? "NaN" : "infinity", std::isnan(value)},
                      log);
        value = std::numeric_limits<double>::quiet_NaN();
      }
    }
  }
  return log;
}

}  // namespace

bool is_bag(const std::string& path) {
  std::error_code none;
  const std::string extension = extension_of(path);
  return extension == ".mcap" || extension == ".db3" || std::filesystem::is_directory(path, none);
}

LogFile read_log(const std::string& path, const LogQuestion& question) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none)) {
    return read_log(file_of_bag(path), question);
  }
  const std::string extension = extension_of(path);
  if (extension == ".mat") {
    return from_matlab(path);
  }
  if (extension == ".h5" || extension == ".hdf5" || extension == ".hdf" || is_hdf5(path)) {
    return read_hdf5_log(path, question.wanted);
  }
  if (extension == ".db3") {
    return read_rosbag_log(path, question);
  }
  if (extension == ".mcap") {
    return read_mcap_log(path, question);
  }
  if (extension == ".jsonl" || extension == ".ndjson" || extension == ".json") {
    return read_json_log(path);
  }
  const bool is_text = extension == ".csv" || extension == ".txt" || extension == ".tsv" ||
                       extension == ".log" || extension == ".dat" || extension.empty();
  if (!is_text && question.names.empty()) {
    throw InputError({path, 0, ""}, "extension " + extension,
                     ".csv, .txt, .tsv, .dat, .log, .jsonl, .json, .h5, .hdf5, .mat, .db3 or .mcap");
  }
  return read_text_log(path, question.names);
}

}  // namespace plumbline
