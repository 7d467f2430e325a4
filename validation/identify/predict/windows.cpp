#include "validation/identify/predict/windows.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "simulator/integrate/command_clock.h"
#include "simulator/sensing/differentiation.h"
#include "simulator/trace/error.h"
#include "validation/identify/predict/jump_ode.h"
#include "validation/identify/predict/tolerance.h"

namespace plumbline::validation {
namespace {

/// Integrator steps of a sample: a search goes past motions that nothing can follow. An impact takes some
/// tens at the tolerance of 1e-5; of a method of third order they grow as the tolerance's third root falls.
long most_steps_of_sample(double tolerance) { return std::lround(2000.0 * std::cbrt(1e-5 / tolerance)); }

/// Explicit steps of a sample, in the mean, beyond which a linearly implicit method is the quicker one.
constexpr double kStiff = 16.0;

/// Temperatures are carried from the beginning of the record, where the motor is taken as cold, through its
/// gaps, in which commands are held. What is longer ago than this, s, counts by its heat alone,
constexpr double kHeat = 60.0;
/// in steps of so many s.
constexpr double kLongAgo = 1.0;

/// Other hidden states are carried from so long ago that no more than this share of what they were then is
/// left,
constexpr double kForgotten = 1e-3;
/// found by going back so many times further.
constexpr double kLonger = 3.0;

/// Does a state of the plant change over minutes: a temperature?
bool remembers_heat(const model::Plant& plant) {
  const std::vector<std::string> names = plant.state_names();
  const std::vector<int> carried = plant.carried_states();
  return std::any_of(carried.begin(), carried.end(), [&](int i) {
    return names[static_cast<std::size_t>(i)].find("temperature of ") != std::string::npos;
  });
}

/// Hidden states from the first sample to sample `to` under the root mean square of each step's commands,
/// which is what heats; other states forget this. The robot stands at `motion`.
void heat_up(const model::Plant& plant, const integrate::HeldCommands& commands, Eigen::Index to,
             double period, const double* motion, double* x) {
  const auto many = std::max<Eigen::Index>(1, std::lround(kLongAgo / period));
  Eigen::VectorXd command(plant.motors());
  for (Eigen::Index k = 0; k < to; k += many) {
    const Eigen::Index end = std::min(to, k + many);
    Eigen::VectorXd squares = Eigen::VectorXd::Zero(plant.motors());
    for (Eigen::Index i = k; i < end; ++i) {
      commands.at(i, 0, command.data());
      squares += command.cwiseAbs2();
    }
    const auto count = static_cast<double>(end - k);
    command = (squares / count).cwiseSqrt();
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

void FreeParameter::set(model::Plant& plant, double value) const {
  plant.set_value(id, value);
  for (const model::ParameterId& other : also) {
    plant.set_value(other, value);
  }
}

Predictor::Predictor(const model::Model& model, const Trial& trial, const PredictOptions& options)
    : trial_(trial),
      options_(options),
      plant_(as_recorded(model, trial), trial.locks, trial.terrain),
      from_channels_(plant_, start_observations(plant_, trial)) {
  constexpr double kRanges = 10.0;
  constexpr double kFloors = 1e4;
  floors_.resize(static_cast<Eigen::Index>(trial.measured.size()));
  farthest_.resize(floors_.size());
  for (std::size_t c = 0; c < trial.measured.size(); ++c) {
    const int s = model.sensor_index(trial.measured[c].sensor);
    sensor_of_channel_.push_back(s);
    const model::Sensor& sensor = plant_.model().sensors[static_cast<std::size_t>(s)];
    floors_[static_cast<Eigen::Index>(c)] = sensor.floor();
    if (sensor.shows_position() || sensor.shows_pose()) {
      position_channels_.push_back(static_cast<Eigen::Index>(c));
    }
    const Eigen::VectorXd& values = trial.measured[c].values;
    const double range = values.maxCoeff() - values.minCoeff();
    farthest_[static_cast<Eigen::Index>(c)] = std::max(kRanges * range, kFloors * sensor.floor());
  }
  find_point_sensors();
  for (const SwitchRecord& record : trial.switches) {
    const model::ContactSwitch* known = model.find_switch(record.name);
    foot_of_switch_.push_back(known == nullptr ? -1 : known->foot);
  }
  if (plant_.meets_anything() && options_.method == integrate::Method::explicit_rk) {
    options_.method = integrate::Method::rosenbrock;  // contacts are stiff
  }
  command_samples_ = command_samples(model, trial.commands, trial.samples());
  commands_before_ = commands_before(model, trial.commands);
  refresh_commands();
}

void Predictor::refresh_commands() {
  const std::vector<effects::ClockError> clocks = integrate::command_clocks(plant_);
  commands_ = std::make_unique<integrate::HeldCommands>(
      integrate::is_any_wrong(clocks)
          ? integrate::on_clock_of_measurements(command_samples_, trial_.period, clocks)
          : command_samples_,
      trial_.period, plant_.delays(), commands_before_);
}

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

// From sample to sample; returns the share that is left at the end of a change at the beginning, which is not
// asked where the record, or what it says of temperatures, begins there: then 0.
double Predictor::carry_from(Eigen::Index from, Eigen::Index to, bool is_warm, double* x) {
  const std::vector<int> hidden = plant_.carried_states();
  measure_motion(from, to);
  Eigen::VectorXd command(plant_.motors());
  is_warm || from == 0 ? commands_->before(command.data()) : commands_->at(from, 0, command.data());
  plant_.settle(command.data(), x);
  if (is_warm) {
    heat_up(plant_, *commands_, from, trial_.period, motion_.col(from).data(), x);
  }
  const bool is_beginning = is_warm || from == beginning_of(trial_, to);
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
  const bool is_warm = remembers_heat(plant_);
  const Eigen::Index earliest = is_warm ? 0 : beginning_of(trial_, window.first);
  const auto samples = [&](double time) {
    return static_cast<Eigen::Index>(std::lround(std::min(time, kHeat) / trial_.period));
  };
  for (double history = is_warm ? kHeat : options_.history;; history *= kLonger) {
    const Eigen::Index from = std::max(earliest, window.first - samples(history));
    if (carry_from(from, window.first, is_warm, x) < kForgotten || history >= kHeat) {
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

// Near the ground the integrator's steps are pieces: the force changes much within a sample, and the steps
// are short where it does. Elsewhere a piece is a sample.
bool Predictor::run(const Window& window, const Eigen::VectorXd& x0, double most) {
  if (options_.method == integrate::Method::explicit_rk) {
    try {
      return run(window, x0, integrate::Method::explicit_rk, std::min(options_.most_steps, kStiff), most);
    } catch (const std::runtime_error&) {
      // Stiff: dry friction that holds, a hard contact. Decided anew for every window, so that what a window
      // gives does not depend on those before it.
      return run(window, x0, integrate::Method::rosenbrock, options_.most_steps, most);
    }
  }
  return run(window, x0, options_.method, options_.most_steps, most);
}

// At the state with which the window begins.
integrate::Options Predictor::tolerances(const Window& window) {
  integrate::Options options;
  if (options_.relative_tolerance > 0.0) {
    options.set_tolerance(options_.relative_tolerance);
    return options;
  }
  std::vector<FlooredSensor> shown;
  shown.reserve(static_cast<std::size_t>(channels()));
  for (int c = 0; c < channels(); ++c) {
    shown.push_back({sensor_of_channel_[static_cast<std::size_t>(c)], floors_[c]});
  }
  Eigen::VectorXd command(plant_.motors());
  commands_->at(window.first, 0, command.data());
  options.set_tolerance(kRelativeTolerance);
  options.absolute_tolerance = tolerances_of(plant_, shown, states_.col(0), command.data(),
                                             static_cast<double>(window.count - 1) * trial_.period);
  return options;
}

bool Predictor::run(const Window& window, const Eigen::VectorXd& x0, integrate::Method method,
                    double most_steps, double most) {
  begin_nodes(window);
  JumpOde ode(plant_, jumps_);
  refresh_commands();
  states_.col(0) = x0;
  if (plant_.has_loops()) {
    plant_.close_loops(states_.col(0).data());  // a search moves states off them
  }
  carry_hidden(window, states_.col(0).data());
  integrate::Options options = tolerances(window);
  options.method = method;
  options.order = method == integrate::Method::explicit_rk ? 3 : 0;
  options.max_steps = most_steps_of_sample(options.relative_tolerance);
  integrate::Integrator integrator(ode, options);
  const double t0 = trial_.time[window.first];
  integrator.start(t0, states_.col(0));
  const std::vector<double>& breaks = commands_->breaks();
  // A short stretch may be much stiffer than the mean: a share of the window, of a very short one some
  // samples.
  constexpr double kBurst = 0.2;
  constexpr double kLeastBurst = 20.0;
  const double burst = std::max(kBurst * static_cast<double>(window.count), kLeastBurst);
  // A plate shows means over a sample, which the state at its end does not tell.
  const bool is_watched = std::isfinite(most) && !integrate::PlateMeans(plant_).any();
  double square = 0.0;
  bool within = true;
  for (Eigen::Index k = 0; within && k + 1 < window.count; ++k) {
    const bool in_pieces = is_near_ground(nodes_ - 1);
    for (std::size_t b = 0; b < breaks.size(); ++b) {
      commands_->at(window.first + k, b, ode.command());
      integrator.input_changed(false);
      const double next = b + 1 < breaks.size() ? breaks[b + 1] : 1.0;
      const double end = t0 + (static_cast<double>(k) + next) * trial_.period;
      if (in_pieces) {
        advance_in_pieces(integrator, end, t0);
      } else {
        integrator.advance(end);
      }
      add_jumps(integrator.events(), t0);
      if (in_pieces && next < 1.0) {
        add_node(end - t0, integrator.state());
      }
    }
    add_sample(k + 1, integrator.state());
    const bool left = has_left(window, k + 1);
    if (left) {
      hold(window, k + 1);
    }
    if (static_cast<double>(integrator.summary().steps) > most_steps * (static_cast<double>(k) + burst)) {
      throw std::runtime_error("a window needs more integrator steps than are worth while");
    }
    const Eigen::Index last = left ? window.count - 1 : k + 1;
    for (Eigen::Index sample = k + 1; is_watched && within && sample <= last; ++sample) {
      square += square_of_sample(window, sample);
      within = square <= most;
    }
    if (left) {
      break;
    }
  }
  evaluations_ += integrator.summary().rate_evaluations;
  return within;
}

bool Predictor::has_left(const Window& window, Eigen::Index sample) {
  Eigen::VectorXd y(plant_.sensors());
  read_sensors(window, sample, y);
  for (int c = 0; c < channels(); ++c) {
    const auto i = static_cast<std::size_t>(c);
    const double off = trial_.measured[i].values[window.first + sample] - y[sensor_of_channel_[i]];
    if (std::abs(off) > farthest_[c]) {
      return true;
    }
  }
  return false;
}

double Predictor::square_of_sample(const Window& window, Eigen::Index sample) {
  Eigen::VectorXd y(plant_.sensors());
  read_sensors(window, sample, y);
  double square = 0.0;
  for (int c = 0; c < channels(); ++c) {
    const auto i = static_cast<std::size_t>(c);
    const double r =
        (trial_.measured[i].values[window.first + sample] - y[sensor_of_channel_[i]]) / floors_[c];
    square += r * r;
  }
  return square;
}

void Predictor::advance_in_pieces(integrate::Integrator& integrator, double end, double t0) {
  const double tolerance =
      options_.relative_tolerance > 0.0 ? options_.relative_tolerance : kRelativeTolerance;
  const long most = integrator.summary().steps + most_steps_of_sample(tolerance);
  while (integrator.time() < end) {
    if (integrator.summary().steps > most) {
      throw std::runtime_error("a sample needs more integrator steps than are worth while");
    }
    integrator.step(end);
    const bool jumped = integrator.events().size() > events_seen_;
    add_jumps(integrator.events(), t0);
    if (!jumped && integrator.time() < end) {
      add_node(integrator.time() - t0, integrator.state());
    }
  }
}

void Predictor::average_plates(Eigen::Index sample, integrate::PlateMeans& plates, Eigen::VectorXd& y) {
  if (!plates.any() || sample == 0) {
    return;
  }
  const Eigen::Index first = node_of(sample - 1);
  plates.begin(node_time(first), states_.col(first).data());
  for (Eigen::Index n = first + 1; n <= node_of(sample); ++n) {
    plates.add(node_time(n), states_.col(n).data());
  }
  plates.write(y.data());
}

Eigen::MatrixXd Predictor::predict(const Window& window, const Eigen::VectorXd& x0) {
  run(window, x0);
  return predicted(window);
}

Eigen::MatrixXd Predictor::predicted(const Window& window) {
  Eigen::MatrixXd predicted(window.count, channels());
  Eigen::VectorXd y(plant_.sensors());
  integrate::PlateMeans plates(plant_);
  for (Eigen::Index k = 0; k < window.count; ++k) {
    if (k > held_from_) {
      predicted.row(k) = predicted.row(held_from_);
      continue;
    }
    read_sensors(window, k, y);
    average_plates(k, plates, y);
    for (int c = 0; c < channels(); ++c) {
      predicted(k, c) = y[sensor_of_channel_[static_cast<std::size_t>(c)]];
    }
  }
  return predicted;
}

Eigen::Index Predictor::rows(const Window& window) const {
  return window.count * channels() + static_cast<Eigen::Index>(window.events.size());
}

Eigen::VectorXd Predictor::residual(const Window& window, const Eigen::VectorXd& x0) {
  run(window, x0);
  return residual_of_run(window);
}

std::optional<Eigen::VectorXd> Predictor::residual_within(const Window& window, const Eigen::VectorXd& x0,
                                                          double most) {
  if (!run(window, x0, most)) {
    return std::nullopt;
  }
  return residual_of_run(window);
}

Eigen::VectorXd Predictor::residual_of_run(const Window& window) {
  const Eigen::MatrixXd at = predicted(window);
  Eigen::VectorXd r(rows(window));
  for (Eigen::Index k = 0; k < window.count; ++k) {
    for (int c = 0; c < channels(); ++c) {
      const double measured = trial_.measured[static_cast<std::size_t>(c)].values[window.first + k];
      r[k * channels() + c] = (measured - at(k, c)) / floors_[c];
    }
  }
  timing_residuals(window, r);
  return r;
}

Eigen::VectorXd Predictor::squares(const Window& window, const Eigen::VectorXd& residual) const {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const Matrix> by_sample(residual.data(), window.count, channels());
  Eigen::VectorXd sampled = by_sample.colwise().squaredNorm().transpose();
  if (trial_.switches.empty()) {
    return sampled;
  }
  Eigen::VectorXd all = Eigen::VectorXd::Zero(channels() + static_cast<Eigen::Index>(trial_.switches.size()));
  all.head(channels()) = sampled;
  for (std::size_t e = 0; e < window.events.size(); ++e) {
    const ContactEvent& event = trial_.contact_events[static_cast<std::size_t>(window.events[e])];
    const double one = residual[window.count * channels() + static_cast<Eigen::Index>(e)];
    all[channels() + event.record] += one * one;
  }
  return all;
}

}  // namespace plumbline::validation
