#include "validation/identify/trial/new_folder.h"

#include <unistd.h>

#include <filesystem>
#include <system_error>

#include "simulator/trace/error.h"

namespace plumbline::validation {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& found) {
  throw InputError({path.string(), 0, ""}, found, "a new folder in a place that can be written");
}

void refuse_existing(const fs::path& path) {
  std::error_code none;
  if (!fs::exists(fs::symlink_status(path, none))) {
    return;
  }
  if (!fs::is_directory(fs::symlink_status(path, none))) {
    refuse(path, "a file of this name");
  }
  const bool empty = fs::is_empty(path, none);
  if (none || !empty) {
    refuse(path, "a folder that is not empty");
  }
}

/// Without the slash that a shell's completion leaves at the end.
fs::path without_slash(const std::string& path) {
  const fs::path given = fs::path(path).lexically_normal();
  return given.has_filename() ? given : given.parent_path();
}

}  // namespace

void write_new_folder(const std::string& path, const std::function<void(const std::string& folder)>& fill) {
  const fs::path target = without_slash(path);
  if (!target.has_filename() || target.filename() == "." || target.filename() == "..") {
    refuse(path, "no name for the folder");
  }
  refuse_existing(target);
  std::error_code failed;
  if (target.has_parent_path()) {
    fs::create_directories(target.parent_path(), failed);
  }
  const fs::path temporary =
      target.parent_path() / ("." + target.filename().string() + "." + std::to_string(::getpid()) + ".tmp");
  if (failed || !fs::create_directory(temporary, failed)) {
    refuse(path, failed ? failed.message() : "the temporary folder " + temporary.string());
  }
  try {
    fill(temporary.string());
    fs::rename(temporary, target);
  } catch (const fs::filesystem_error& error) {
    fs::remove_all(temporary, failed);
    refuse(path, error.code().message());
  } catch (...) {
    fs::remove_all(temporary, failed);
    throw;
  }
}

}  // namespace plumbline::validation
