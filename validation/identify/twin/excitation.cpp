#include "validation/identify/twin/excitation.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace plumbline::validation {
namespace {

constexpr double kTwoPi = 6.283185307179586476925;
constexpr double kTimeTolerance = 1e-6;  // of a period: a time of a file means the sample it rounds to

double time_of(Eigen::Index k, const Sampling& sampling) { return static_cast<double>(k) * sampling.period; }

/// First sample at or behind time t.
Eigen::Index first_sample(double t, const Sampling& sampling) {
  const double exact = std::ceil(t / sampling.period - kTimeTolerance);
  return static_cast<Eigen::Index>(std::clamp(exact, 0.0, static_cast<double>(sampling.count)));
}

void require(bool holds, const char* what) {
  if (!holds) {
    throw std::invalid_argument(what);
  }
}

void require_rising(const std::vector<double>& times) {
  require(!times.empty(), "times must not be empty");
  require(times.front() >= 0.0, "times must not be negative");
  const auto not_rising = [](double a, double b) { return !(a < b); };
  require(std::adjacent_find(times.begin(), times.end(), not_rising) == times.end(), "times must rise");
}

}  // namespace

Eigen::VectorXd sampled_sum(const Excitations& shapes, const Sampling& sampling) {
  Eigen::VectorXd command = Eigen::VectorXd::Zero(sampling.count);
  for (const auto& shape : shapes) {
    shape->add_to(command, sampling);
  }
  return command;
}

void Constant::add_to(Eigen::VectorXd& command, const Sampling& /*sampling*/) const {
  command.array() += value_;
}

SteppedChirp::SteppedChirp(const Options& options) : options_(options) {
  require(options.from > 0.0 && options.to > 0.0, "the frequencies from and to must be positive");
  require(options.steps >= 2, "steps must be 2 or more");
  require(options.linear_amplitude || (options.first_amplitude > 0.0 && options.last_amplitude > 0.0),
          "logarithmic spacing needs positive amplitudes");
}

double SteppedChirp::highest_frequency() const { return std::max(options_.from, options_.to); }

double SteppedChirp::frequency(int step) const {
  return options_.from * std::pow(options_.to / options_.from, step / (options_.steps - 1.0));
}

double SteppedChirp::amplitude(int step) const {
  const double share = step / (options_.steps - 1.0);
  const double first = options_.first_amplitude;
  const double last = options_.last_amplitude;
  return options_.linear_amplitude ? first + (last - first) * share : first * std::pow(last / first, share);
}

void SteppedChirp::add_to(Eigen::VectorXd& command, const Sampling& sampling) const {
  const double share = sampling.duration() / options_.steps;
  double phase = 0.0;  // at the beginning of the step
  for (int step = 0; step < options_.steps; ++step) {
    const double begin = step * share;
    const double rate = kTwoPi * frequency(step);
    const bool last = step + 1 == options_.steps;
    const Eigen::Index end = last ? sampling.count : first_sample(begin + share, sampling);
    for (Eigen::Index k = first_sample(begin, sampling); k < end; ++k) {
      command[k] += amplitude(step) * std::sin(phase + rate * (time_of(k, sampling) - begin));
    }
    phase += rate * share;
  }
}

Multisine::Multisine(std::vector<double> frequencies, std::vector<double> amplitudes,
                     std::vector<double> phases)
    : frequencies_(std::move(frequencies)), amplitudes_(std::move(amplitudes)), phases_(std::move(phases)) {
  require(!frequencies_.empty(), "frequencies must not be empty");
  require(frequencies_.size() == amplitudes_.size() && frequencies_.size() == phases_.size(),
          "frequencies, amplitudes and phases must be lists of the same length");
  require(*std::min_element(frequencies_.begin(), frequencies_.end()) > 0.0, "frequencies must be positive");
}

double Multisine::highest_frequency() const {
  return *std::max_element(frequencies_.begin(), frequencies_.end());
}

void Multisine::add_to(Eigen::VectorXd& command, const Sampling& sampling) const {
  for (std::size_t i = 0; i < frequencies_.size(); ++i) {
    for (Eigen::Index k = 0; k < sampling.count; ++k) {
      command[k] += amplitudes_[i] * std::sin(kTwoPi * frequencies_[i] * time_of(k, sampling) + phases_[i]);
    }
  }
}

Steps::Steps(std::vector<double> times, std::vector<double> levels)
    : times_(std::move(times)), levels_(std::move(levels)) {
  require_rising(times_);
  require(times_.size() == levels_.size(), "times and levels must be lists of the same length");
}

void Steps::add_to(Eigen::VectorXd& command, const Sampling& sampling) const {
  for (std::size_t i = 0; i < times_.size(); ++i) {
    const Eigen::Index begin = first_sample(times_[i], sampling);
    const Eigen::Index end = i + 1 < times_.size() ? first_sample(times_[i + 1], sampling) : sampling.count;
    command.segment(begin, end - begin).array() += levels_[i];
  }
}

void Ramp::add_to(Eigen::VectorXd& command, const Sampling& sampling) const {
  command += Eigen::VectorXd::LinSpaced(sampling.count, start_, end_);
}

Pulses::Pulses(std::vector<double> times, double width, double level)
    : times_(std::move(times)), width_(width), level_(level) {
  require_rising(times_);
  require(width_ > 0.0, "width must be positive");
  const auto overlap = [this](double a, double b) { return b - a < width_; };
  require(std::adjacent_find(times_.begin(), times_.end(), overlap) == times_.end(),
          "a pulse must end before the next begins");
}

void Pulses::add_to(Eigen::VectorXd& command, const Sampling& sampling) const {
  for (const double time : times_) {
    const Eigen::Index begin = first_sample(time, sampling);
    const Eigen::Index end = first_sample(time + width_, sampling);
    command.segment(begin, end - begin).array() += level_;
  }
}

FilteredNoise::FilteredNoise(double deviation, double corner, std::uint64_t seed)
    : deviation_(deviation), corner_(corner), seed_(seed) {
  require(deviation > 0.0, "deviation must be positive");
  require(corner > 0.0, "the corner frequency must be positive");
}

void FilteredNoise::add_to(Eigen::VectorXd& command, const Sampling& sampling) const {
  std::mt19937_64 generator(seed_);
  std::normal_distribution<double> normal;
  const double keep = std::exp(-kTwoPi * corner_ * sampling.period);
  const double fresh = deviation_ * std::sqrt(1.0 - keep * keep);
  double value = deviation_ * normal(generator);
  for (Eigen::Index k = 0; k < sampling.count; ++k) {
    command[k] += value;
    value = keep * value + fresh * normal(generator);
  }
}

}  // namespace plumbline::validation
