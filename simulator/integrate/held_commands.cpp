#include "simulator/integrate/held_commands.h"

#include <algorithm>
#include <cmath>

namespace plumbline::integrate {

HeldCommands::HeldCommands(Eigen::MatrixXd samples, double period, const std::vector<double>& delays,
                           Eigen::VectorXd before)
    : samples_(std::move(samples)), before_(std::move(before)), period_(period) {
  breaks_.push_back(0.0);
  for (const double delay : delays) {
    const double periods = delay / period_;
    double whole = std::floor(periods);
    double part = periods - whole;
    if (part > 1.0 - 1e-9) {
      whole += 1.0;
      part = 0.0;
    }
    part = part < 1e-9 ? 0.0 : part;
    whole_.push_back(static_cast<Eigen::Index>(whole));
    part_.push_back(part);
    breaks_.push_back(part);
  }
  std::sort(breaks_.begin(), breaks_.end());
  breaks_.erase(std::unique(breaks_.begin(), breaks_.end()), breaks_.end());
}

double HeldCommands::sample(Eigen::Index motor, Eigen::Index k) const {
  if (k < 0 && before_.size() > 0) {
    return before_[motor];
  }
  return samples_(motor, std::clamp<Eigen::Index>(k, 0, samples_.cols() - 1));
}

void HeldCommands::at(Eigen::Index k, std::size_t b, double* command) const {
  for (Eigen::Index m = 0; m < samples_.rows(); ++m) {
    const auto i = static_cast<std::size_t>(m);
    const Eigen::Index late = breaks_[b] >= part_[i] ? 0 : 1;
    command[m] = sample(m, k - whole_[i] - late);
  }
}

void HeldCommands::mean(Eigen::Index k, double* command, double* slope) const {
  for (Eigen::Index m = 0; m < samples_.rows(); ++m) {
    const auto i = static_cast<std::size_t>(m);
    const double now = sample(m, k - whole_[i]);
    const double before = sample(m, k - whole_[i] - 1);
    command[m] = (1.0 - part_[i]) * now + part_[i] * before;
    slope[m] = (before - now) / period_;
  }
}

void HeldCommands::before(double* command) const {
  for (Eigen::Index m = 0; m < samples_.rows(); ++m) {
    command[m] = sample(m, -1);
  }
}

void HeldCommands::held(Eigen::Index k, double* command) const {
  for (Eigen::Index m = 0; m < samples_.rows(); ++m) {
    command[m] = samples_(m, k);
  }
}

void HeldCommands::set(Eigen::Index k, const double* command) {
  for (Eigen::Index m = 0; m < samples_.rows(); ++m) {
    samples_(m, k) = command[m];
  }
}

void HeldCommands::push(const double* command) {
  const Eigen::Index kept = samples_.cols() - 1;
  samples_.leftCols(kept) = samples_.rightCols(kept).eval();
  set(kept, command);
}

Eigen::Index HeldCommands::depth(double period, const std::vector<double>& delays) {
  const double longest = delays.empty() ? 0.0 : *std::max_element(delays.begin(), delays.end());
  return static_cast<Eigen::Index>(std::ceil(longest / period)) + 2;
}

}  // namespace plumbline::integrate
