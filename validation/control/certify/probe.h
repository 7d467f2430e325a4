// How long a controller's steps take, and whether they allocate: in a process of its own.
#pragma once

#include <Eigen/Core>
#include <string>

#include "controllers/driver/plan.h"

namespace plumbline::validation {

struct Probed {
  long steps = 0;
  long allocations = 0;                         ///< calls of malloc and its kin within steps
  double p50 = 0.0, p999 = 0.0, largest = 0.0;  ///< s
  int fault = 0;                                ///< what step() returned last
};

/// Steps the library through the recorded channels (channels x samples), again and again until 20,000 steps
/// are made. Throws std::runtime_error when it crashes or cannot be loaded.
Probed probe_controller(const std::string& library, const driver::Plan& plan,
                        const Eigen::MatrixXd& channels);

}  // namespace plumbline::validation
