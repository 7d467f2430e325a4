#include "validation/cli/files.h"

#include <filesystem>
#include <fstream>

#include "simulator/trace/error.h"
#include "simulator/trace/file_text.h"
#include "validation/identify/trial/new_folder.h"

namespace plumbline::cli {
namespace {

namespace fs = std::filesystem;

/// Ends a trial write before it replaces anything.
struct CanBeWritten {};

}  // namespace

void check_writable(const std::string& file) {
  std::error_code none;
  const bool exists = fs::exists(file, none);
  if (file.empty() || (exists && !fs::is_regular_file(file, none) && !fs::is_directory(file, none))) {
    return;  // pipes and terminals are written as they are
  }
  try {
    replace_file(file, [](const std::string& temporary) {
      if (!std::ofstream(temporary)) {
        throw InputError("a folder that cannot be written");
      }
      throw CanBeWritten();
    });
  } catch (const CanBeWritten&) {
    return;
  }
}

void check_new_folder(const std::string& folder) {
  if (folder.empty()) {
    return;
  }
  try {
    validation::write_new_folder(folder, [](const std::string& /*temporary*/) { throw CanBeWritten(); });
  } catch (const CanBeWritten&) {
    return;
  }
}

void check_trace_file(const std::string& file) {
  const std::string extension = std::filesystem::path(file).extension().string();
  if (!file.empty() && extension != ".csv" && extension != ".mat") {
    throw InputError({file, 0, ""}, "extension \"" + extension + "\"", ".csv or .mat");
  }
  check_writable(file);
}

void write_trace(const Table& trace, const std::string& file) {
  std::filesystem::path(file).extension() == ".mat" ? write_mat(trace, file) : write_csv(trace, file);
}

void check_not_an_input(const std::string& file, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    std::error_code none;
    if (!file.empty() && fs::equivalent(file, input, none)) {
      throw InputError({file, 0, ""}, "one of the files that are read", "another file to write to");
    }
  }
}

}  // namespace plumbline::cli
