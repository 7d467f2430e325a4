// Whole files in and out.
#pragma once

#include <functional>
#include <string>

namespace plumbline {

/// The content of a regular file. Throws InputError when it is missing, no file, or cannot be read.
std::string read_text(const std::string& path);

/// Calls `write` with the name of a temporary file beside `path`, then renames that to `path`. When `write`
/// throws, the temporary file is removed and `path` keeps its old content. A symbolic link is followed.
/// Throws InputError when the folder cannot be written.
void replace_file(const std::string& path, const std::function<void(const std::string& temporary)>& write);

}  // namespace plumbline
