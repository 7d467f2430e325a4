#include "validation/identify/predict/windows.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "simulator/integrate/command_clock.h"
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

// What is recorded of commands stays the same while the delays and clocks that a search tries do.
void Predictor::refresh_commands() {
  const std::vector<effects::ClockError> clocks = integrate::command_clocks(plant_);
  std::vector<double> lateness = plant_.delays();
  for (const effects::ClockError& clock : clocks) {
    lateness.insert(lateness.end(), {clock.offset, clock.drift});
  }
  if (commands_ != nullptr && lateness == lateness_) {
    return;
  }
  lateness_ = std::move(lateness);
  command_squares_.resize(0, 0);
  commands_ = std::make_unique<integrate::HeldCommands>(
      integrate::is_any_wrong(clocks)
          ? integrate::on_clock_of_measurements(command_samples_, trial_.period, clocks)
          : command_samples_,
      trial_.period, plant_.delays(), commands_before_);
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
