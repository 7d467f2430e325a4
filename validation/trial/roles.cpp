// Held-out data must not have been seen in fitting.
#include <filesystem>

#include "simulator/trace/error.h"
#include "validation/trial/trial.h"

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

void check_pair(const Trial& held_out, const Trial& train) {
  const std::string expected = "other data; what was fitted cannot be held out";
  if (share_rows(held_out, train)) {
    throw InputError({held_out.file, 0, "data"}, "the data file of the train trial " + train.file, expected);
  }
  if (same_numbers(held_out, train)) {
    throw InputError({held_out.file, 0, "data"}, "the numbers of the train trial " + train.file, expected);
  }
}

}  // namespace

void check_roles(const std::vector<Trial>& trials) {
  for (const Trial& held_out : trials) {
    for (const Trial& train : trials) {
      if (held_out.role == Role::held_out && train.role == Role::train) {
        check_pair(held_out, train);
      }
    }
  }
}

}  // namespace plumbline::validation
