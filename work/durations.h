// How long tasks took at an earlier time, so that the longest is begun first the next time.
#pragma once

#include <map>
#include <string>

namespace plumbline::work {

/// A table of names and seconds in a file of lines `name,seconds`. It is no result: it differs from run to
/// run, and may be deleted; what cannot be read in it is not known.
class Durations {
 public:
  Durations() = default;
  /// What the file has; nothing where there is none.
  explicit Durations(const std::string& file);

  /// s; 0: not known.
  double of(const std::string& name) const;
  /// The longest counts: what was only read again says nothing of the work.
  void add(const std::string& name, double seconds);
  /// The file; `head` names the first column.
  std::string text(const std::string& head) const;

 private:
  std::map<std::string, double> known_;
};

}  // namespace plumbline::work
