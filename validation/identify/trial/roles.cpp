// Held-out data must not have been seen in fitting, test data neither in fitting nor in choosing.
#include <filesystem>

#include "simulator/trace/error.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::validation {
namespace {

namespace fs = std::filesystem;

bool same_file(const std::string& a, const std::string& b) {
  std::error_code none;
  return !a.empty() && !b.empty() && fs::weakly_canonical(a, none) == fs::weakly_canonical(b, none);
}

/// How many channels both have, and whether all of these hold the same numbers.
struct Overlap {
  int shared = 0;
  bool equal = true;

  void add(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    ++shared;
    equal = equal && a.size() == b.size() && a == b;
  }
};

/// The time is left out, so that a copy with another origin is found too, and so are channels that only one
/// of them has: data with a column less are still the same data.
bool same_numbers(const Trial& a, const Trial& b) {
  Overlap measured;
  for (const Measured& of_a : a.measured) {
    for (const Measured& of_b : b.measured) {
      if (of_a.sensor == of_b.sensor) {
        measured.add(of_a.values, of_b.values);
      }
    }
  }
  Overlap commanded;
  for (const Command& of_a : a.commands) {
    for (const Command& of_b : b.commands) {
      if (of_a.motor == of_b.motor) {
        commanded.add(of_a.values, of_b.values);
      }
    }
  }
  return measured.shared > 0 && measured.equal && commanded.equal;
}

/// Have two trials times of one data file in common?
bool share_rows(const Trial& a, const Trial& b) {
  if (!same_file(a.data_file, b.data_file)) {
    return false;
  }
  for (const Stretch& of_a : stretches_of(a)) {
    for (const Stretch& of_b : stretches_of(b)) {
      if (a.time[of_a.first] <= b.time[of_b.end - 1] && b.time[of_b.first] <= a.time[of_a.end - 1]) {
        return true;
      }
    }
  }
  return false;
}

/// `later` must not have been seen when `earlier` was used.
void check_pair(const Trial& later, const Trial& earlier) {
  const std::string expected = later.role == Role::test
                                   ? "other data; what was fitted or has chosen cannot test"
                                   : "other data; what was fitted cannot be held out";
  const std::string of_it = "of the " + to_string(earlier.role) + " trial " + earlier.file;
  if (share_rows(later, earlier)) {
    throw InputError({later.file, 0, "data"}, "the data file " + of_it, expected);
  }
  if (same_numbers(later, earlier)) {
    throw InputError({later.file, 0, "data"}, "the numbers " + of_it, expected);
  }
}

}  // namespace

void check_roles(const std::vector<Trial>& trials) {
  for (const Trial& later : trials) {
    for (const Trial& earlier : trials) {
      if (later.role > earlier.role) {
        check_pair(later, earlier);
      }
    }
  }
}

}  // namespace plumbline::validation
