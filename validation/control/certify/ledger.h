// What has been found out already: a run that was broken off goes on where it was.
#pragma once

#include <map>
#include <string>

#include "controllers/driver/json.h"

namespace plumbline::validation {

/// A file of lines, each {"key", "result"}; the first states what all of it belongs to. A line is written
/// when its result is known.
class Ledger {
 public:
  /// Keeps what `file` has when it begins with `identity`, begins anew otherwise. A last line that was cut
  /// off is dropped. Without a name nothing is written. Throws InputError when the file cannot be written.
  Ledger(const std::string& file, const std::string& identity);

  const driver::Json* find(const std::string& key) const;
  void add(const std::string& key, const driver::Json& result);
  std::size_t size() const { return results_.size(); }

 private:
  std::string file_;
  std::map<std::string, driver::Json> results_;
};

}  // namespace plumbline::validation
