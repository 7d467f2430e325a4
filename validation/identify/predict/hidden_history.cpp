// Hidden states at a window's beginning: bristles, lags, temperatures, lost counts. No sensor shows them, so
// they are carried there along the measured motion and the commands before it.
#include <algorithm>
#include <cmath>

#include "simulator/sensing/differentiation.h"
#include "validation/identify/predict/windows.h"

namespace plumbline::validation {
namespace {

/// Hidden states are carried from so long ago that no more than this share of what they were then is left,
constexpr double kForgotten = 1e-3;
/// found by going back so many times further,
constexpr double kLonger = 3.0;
/// but for no longer than this, s.
constexpr double kLongestHistory = 60.0;

/// Temperatures are carried from the beginning of the record, where the motor is taken as cold, through its
/// gaps, in which commands are held. Before the samples along which other states are carried, heat counts by
/// its mean over steps of this share of their age: a temperature weighs what was a time t ago by exp(-t/T),
/// which changes over a step by t/T of this share, where t is at most some T.
constexpr double kShareOfAge = 0.02;

/// States of the plant that change over minutes.
std::vector<int> temperatures_of(const model::Plant& plant) {
  const std::vector<std::string> names = plant.state_names();
  std::vector<int> found;
  for (const int i : plant.carried_states()) {
    if (names[static_cast<std::size_t>(i)].find("temperature of ") != std::string::npos) {
      found.push_back(i);
    }
  }
  return found;
}

/// Hidden states from the first sample to sample `to` under the root mean square of each step's commands,
/// which is what heats; other states forget this. Ages count from sample `now`. The robot stands at `motion`.
/// squares: of the commands before each sample, summed, motors x samples + 1.
void heat_up(const model::Plant& plant, const Eigen::MatrixXd& squares, Eigen::Index to, Eigen::Index now,
             double period, const double* motion, double* x) {
  std::vector<Eigen::Index> ends{to};
  while (ends.back() > 0) {
    const auto age = static_cast<double>(now - ends.back());
    const auto step = std::max<Eigen::Index>(1, std::lround(kShareOfAge * age));
    ends.push_back(std::max<Eigen::Index>(0, ends.back() - step));
  }
  for (std::size_t i = ends.size(); i-- > 1;) {
    const auto count = static_cast<double>(ends[i - 1] - ends[i]);
    const Eigen::VectorXd command =
        ((squares.col(ends[i - 1]) - squares.col(ends[i])) / count).cwiseMax(0.0).cwiseSqrt();
    plant.carry_states(motion, motion, command.data(), count * period, x);
  }
}

/// Where a sample's record begins, or the stretch of it without gaps.
Eigen::Index beginning_of(const Trial& trial, Eigen::Index sample) {
  Eigen::Index first = 0;
  for (const Stretch& stretch : trial.stretches) {
    first = stretch.first <= sample ? std::max(first, stretch.first) : first;
  }
  return first;
}

/// Channels x samples.
Eigen::MatrixXd measured_channels(const Trial& trial) {
  Eigen::MatrixXd y(static_cast<Eigen::Index>(trial.measured.size()), trial.samples());
  for (std::size_t c = 0; c < trial.measured.size(); ++c) {
    y.row(static_cast<Eigen::Index>(c)) = trial.measured[c].values.transpose();
  }
  return y;
}

}  // namespace

Eigen::MatrixXd Predictor::measured_positions() const {
  return from_channels_.positions(with_starts(measured_channels(trial_), false));
}

// Of samples `from` to `to`, those that are not known yet: where poses are measured each takes a search.
void Predictor::measure_motion(Eigen::Index from, Eigen::Index to) {
  const Eigen::Index nz = plant_.positions();
  if (motion_.size() == 0) {
    motion_.resize(2 * nz, trial_.samples());
    is_measured_.assign(static_cast<std::size_t>(trial_.samples()), false);
    measured_rates_.resize(channels(), trial_.samples());
    for (int c = 0; c < channels(); ++c) {
      const Eigen::VectorXd& values = trial_.measured[static_cast<std::size_t>(c)].values;
      measured_rates_.row(c) =
          sensing::differentiate(values, trial_.period, sensing::DifferentiationOptions::acausal())
              .transpose();
    }
  }
  const auto is_known = [&](Eigen::Index k) { return is_measured_[static_cast<std::size_t>(k)]; };
  while (from <= to && is_known(from)) {
    ++from;
  }
  while (from <= to && is_known(to)) {
    --to;
  }
  if (from > to) {
    return;
  }
  const Eigen::Index count = to - from + 1;
  const Eigen::MatrixXd values = with_starts(measured_channels(trial_).middleCols(from, count), false);
  const Eigen::MatrixXd positions = from_channels_.positions(values);
  motion_.block(0, from, nz, count) = positions;
  motion_.block(nz, from, nz, count) =
      from_channels_.rates(with_starts(measured_rates_.middleCols(from, count), true), positions, values);
  std::fill(is_measured_.begin() + from, is_measured_.begin() + to + 1, true);
}

// Summed up once for each set of clocks. Their delays are left out: they are short against what heats.
const Eigen::MatrixXd& Predictor::command_squares() {
  if (command_squares_.size() == 0) {
    command_squares_ = Eigen::MatrixXd::Zero(plant_.motors(), trial_.samples() + 1);
    Eigen::VectorXd command(plant_.motors());
    for (Eigen::Index k = 0; k < trial_.samples(); ++k) {
      commands_->held(k, command.data());
      command_squares_.col(k + 1) = command_squares_.col(k) + command.cwiseAbs2();
    }
  }
  return command_squares_;
}

// From sample to sample; returns the share that is left at the end of a change at the beginning of states
// that are no temperatures. It is not asked where the record begins there: then 0.
double Predictor::carry_from(Eigen::Index from, Eigen::Index to, const std::vector<int>& warm, double* x) {
  std::vector<int> hidden = plant_.carried_states();
  hidden.erase(std::remove_if(hidden.begin(), hidden.end(),
                              [&](int i) { return std::find(warm.begin(), warm.end(), i) != warm.end(); }),
               hidden.end());
  measure_motion(from, to);
  Eigen::VectorXd command(plant_.motors());
  const bool is_first = !warm.empty() || from == 0;
  is_first ? commands_->before(command.data()) : commands_->at(from, 0, command.data());
  plant_.settle(command.data(), x);
  if (!warm.empty()) {
    heat_up(plant_, command_squares(), from, to, trial_.period, motion_.col(from).data(), x);
  }
  const bool is_beginning = hidden.empty() || from == beginning_of(trial_, to);
  const Eigen::VectorXd settled = Eigen::Map<const Eigen::VectorXd>(x, plant_.states());
  Eigen::VectorXd other = settled;
  Eigen::VectorXd change = Eigen::VectorXd::Zero(other.size());
  for (const int i : hidden) {
    change[i] = 1e-3 * (1.0 + std::abs(x[i]));
  }
  other += change;
  std::vector<double*> carried{x};
  if (!is_beginning) {
    carried.push_back(other.data());
  }
  const std::vector<double>& breaks = commands_->breaks();
  for (Eigen::Index k = from; k < to; ++k) {
    for (std::size_t b = 0; b < breaks.size(); ++b) {
      commands_->at(k, b, command.data());
      const double next = b + 1 < breaks.size() ? breaks[b + 1] : 1.0;
      for (double* states : carried) {
        plant_.carry_states(motion_.col(k).data(), motion_.col(k + 1).data(), command.data(),
                            (next - breaks[b]) * trial_.period, states);
      }
    }
  }
  if (is_beginning) {
    return 0.0;
  }
  double left = 0.0;
  for (const int i : hidden) {
    const bool has_moved = x[i] != settled[i];  // what did not has nothing to remember
    left = has_moved ? std::max(left, std::abs(other[i] - x[i]) / change[i]) : left;
  }
  return left;
}

void Predictor::carry_hidden(const Window& window, double* x) {
  const std::vector<int> hidden = plant_.carried_states();
  const bool too_short = trial_.samples() < sensing::DifferentiationOptions::acausal().window;
  if (hidden.empty() || too_short) {
    return;
  }
  const std::vector<int> warm = temperatures_of(plant_);
  const Eigen::Index earliest = beginning_of(trial_, window.first);
  for (double history = options_.history;; history *= kLonger) {
    const auto samples =
        static_cast<Eigen::Index>(std::lround(std::min(history, kLongestHistory) / trial_.period));
    const Eigen::Index from = std::max(earliest, window.first - samples);
    if (carry_from(from, window.first, warm, x) < kForgotten || history >= kLongestHistory) {
      break;
    }
  }
  if (plant_.loses_counts()) {
    carry_losses(window.first, x);
  }
}

// What a sensor has lost stays lost: carried from where the record begins, however long ago, with the mean of
// its reading's rate between two samples.
void Predictor::carry_losses(Eigen::Index to, double* x) const {
  const Eigen::Index from = beginning_of(trial_, to);
  for (int c = 0; c < channels(); ++c) {
    const Eigen::VectorXd rates = 0.5 * (measured_rates_.row(c).segment(from, to - from) +
                                         measured_rates_.row(c).segment(from + 1, to - from));
    plant_.carry_losses(sensor_of_channel_[static_cast<std::size_t>(c)], rates, trial_.period, x);
  }
}

// d(hidden states at the window's start)/d(parameters), states x parameters. The window has been run with the
// present parameters: its first state holds what they were carried to.
Eigen::MatrixXd Predictor::hidden_slopes(const Window& window, const std::vector<model::ParameterId>& ids,
                                         const Eigen::VectorXd& steps) {
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(plant_.states(), steps.size());
  const std::vector<int> owners = plant_.carried_state_effects();
  const Eigen::VectorXd here = states_.col(0);
  Eigen::VectorXd there = here;
  for (std::size_t p = 0; p < ids.size(); ++p) {
    if (std::find(owners.begin(), owners.end(), ids[p].effect) == owners.end()) {
      continue;
    }
    const auto i = static_cast<Eigen::Index>(p);
    const double value = plant_.value(ids[p]);
    plant_.set_value(ids[p], value + steps[i]);
    carry_hidden(window, there.data());
    plant_.set_value(ids[p], value);
    slopes.col(i) = (there - here) / steps[i];
  }
  return slopes;
}

}  // namespace plumbline::validation
