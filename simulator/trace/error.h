// The one kind of error that means "your input is wrong": one clear line, exit status 2.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace plumbline {

/// Where a value was read: file, line (0: not known), key or column.
struct Place_in_file {
  std::string file;
  int line = 0;
  std::string key;
};

/// "FILE:LINE: KEY: found ..., expected ...". what() is that single line.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  InputError(const Place_in_file& where, const std::string& found, const std::string& expected);
};

/// "; did you mean a, b?" from the nearest names (edit distance), or "; known: ..." when none is near.
std::string nearest_names(const std::string& given, const std::vector<std::string>& known);

}  // namespace plumbline
