// A folder that appears whole or not at all.
#pragma once

#include <functional>
#include <string>

namespace plumbline::validation {

/// Calls `fill` with a temporary folder beside `path` and renames that to `path`. When anything fails, the
/// temporary folder is removed and `path` is as before. Missing folders above are made. Throws InputError
/// when `path` exists and is not an empty folder, or cannot be made.
void write_new_folder(const std::string& path, const std::function<void(const std::string& folder)>& fill);

}  // namespace plumbline::validation
