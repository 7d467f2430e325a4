// Whether a simulation's energy adds up.
#pragma once

#include <algorithm>
#include <cmath>

namespace plumbline::integrate {

/// Stored energy's course, J: start with the first, add the others in order of time.
class EnergyAccount {
 public:
  void start(double stored) { first_ = last_ = lowest_ = highest_ = stored; }
  void add(double stored) {
    lowest_ = std::min(lowest_, stored);
    highest_ = std::max(highest_, stored);
    last_ = stored;
  }

  /// last - first - work + dissipated; both since the start.
  double error(double work, double dissipated) const { return last_ - first_ - work + dissipated; }
  /// |work| + |dissipated| + swing of the stored energy: what an error is held against.
  double exchanged(double work, double dissipated) const {
    return std::abs(work) + std::abs(dissipated) + highest_ - lowest_;
  }

 private:
  double first_ = 0.0, last_ = 0.0, lowest_ = 0.0, highest_ = 0.0;
};

}  // namespace plumbline::integrate
