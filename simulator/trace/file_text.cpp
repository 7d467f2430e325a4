#include "simulator/trace/file_text.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "simulator/trace/error.h"
#include "simulator/trace/table.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_writing(const std::string& path, const std::string& reason) {
  throw InputError({path, 0, ""}, reason, "a file that can be written");
}

/// A name that no other process and no other call of this one uses.
std::string temporary_beside(const fs::path& path) {
  static std::atomic<unsigned> calls{0};
  const std::string suffix = std::to_string(::getpid()) + "-" + std::to_string(calls++);
  return (path.parent_path() / ("." + path.filename().string() + "." + suffix + ".tmp")).string();
}

/// Where the bytes go: the target of a symbolic link, otherwise the path itself.
fs::path resolved(const std::string& path) {
  std::error_code none;
  return fs::is_symlink(path, none) ? fs::weakly_canonical(path, none) : fs::path(path);
}

void write_stream(const std::string& path, const std::string& text) {
  errno = 0;
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) {
    refuse_writing(path, errno == 0 ? "a write that failed" : std::strerror(errno));
  }
}

}  // namespace

std::string read_text(const std::string& path) {
  std::error_code none;
  if (!fs::exists(path, none)) {
    throw InputError({path, 0, ""}, "nothing at this path", "a file");
  }
  if (!fs::is_regular_file(path, none)) {
    throw InputError({path, 0, ""}, "something that is no regular file", "a file");
  }
  std::ifstream in(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in.is_open() || in.bad()) {
    throw InputError({path, 0, ""}, "a file that cannot be opened", "a readable file");
  }
  return text;
}

void replace_file(const std::string& path, const std::function<void(const std::string&)>& write) {
  const fs::path target = resolved(path);
  std::error_code none;
  if (path.empty() || fs::is_directory(target, none)) {
    refuse_writing(path, "a folder");
  }
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, none)) {
    refuse_writing(path, "no folder " + folder.string());
  }
  const std::string temporary = temporary_beside(target);
  try {
    write(temporary);
  } catch (const InputError& error) {
    fs::remove(temporary, none);
    refuse_writing(path, error.what());
  } catch (...) {
    fs::remove(temporary, none);
    throw;
  }
  std::error_code failed;
  fs::rename(temporary, target, failed);
  if (failed) {
    fs::remove(temporary, none);
    refuse_writing(path, failed.message());
  }
}

void write_text_atomically(const std::string& path, const std::string& text) {
  std::error_code none;
  const fs::path target = resolved(path);
  if (fs::exists(target, none) && !fs::is_regular_file(target, none) && !fs::is_directory(target, none)) {
    write_stream(path, text);  // a pipe or a terminal: nothing to rename
    return;
  }
  replace_file(path, [&text](const std::string& temporary) { write_stream(temporary, text); });
}

}  // namespace plumbline
