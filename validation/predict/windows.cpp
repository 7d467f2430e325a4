#include "validation/predict/windows.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "simulator/integrate/plant_ode.h"
#include "simulator/sensing/differentiation.h"
#include "simulator/trace/error.h"

namespace plumbline::validation {
namespace {

std::vector<model::Observation> observations_of(const model::Plant& plant, const Trial& trial) {
  std::vector<model::Observation> channels;
  channels.reserve(trial.measured.size());
  for (const Measured& channel : trial.measured) {
    channels.push_back(model::observe_sensor(plant, plant.model().sensor_index(channel.sensor)));
  }
  return channels;
}

/// Samples at which windows may not continue: trial start, events, end.
std::vector<Eigen::Index> cut_points(const Trial& trial) {
  std::vector<Eigen::Index> cuts{0};
  for (const double event : trial.events) {
    const double* begin = trial.time.data();
    const auto k = std::lower_bound(begin, begin + trial.samples(), event) - begin;
    if (k > cuts.back() && k < trial.samples()) {
      cuts.push_back(k);
    }
  }
  cuts.push_back(trial.samples());
  return cuts;
}

}  // namespace

void FreeParameter::set(model::Plant& plant, double value) const {
  plant.set_value(id, value);
  for (const model::ParameterId& other : also) {
    plant.set_value(other, value);
  }
}

std::vector<Window> cut_windows(const std::vector<Trial>& trials, const PredictOptions& options) {
  std::vector<Window> windows;
  for (std::size_t t = 0; t < trials.size(); ++t) {
    const Trial& trial = trials[t];
    const auto length = static_cast<Eigen::Index>(std::lround(options.window / trial.period));
    if (trial.samples() < length) {
      throw InputError(
          {trial.file, 0, "data"}, std::to_string(trial.samples()) + " samples",
          "at least one window of " + std::to_string(length) + " samples (--window sets its length)");
    }
    const std::vector<Eigen::Index> cuts = cut_points(trial);
    for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
      const Eigen::Index span = cuts[c + 1] - cuts[c];
      const Eigen::Index parts = std::max<Eigen::Index>(1, (span + length / 2) / length);
      if (span < 8) {
        continue;
      }
      for (Eigen::Index p = 0; p < parts; ++p) {
        const Eigen::Index first = cuts[c] + span * p / parts;
        windows.push_back({static_cast<int>(t), first, cuts[c] + span * (p + 1) / parts - first});
      }
    }
  }
  return windows;
}

Predictor::Predictor(const model::Model& model, const Trial& trial, const PredictOptions& options)
    : trial_(trial),
      options_(options),
      plant_(model, trial.locks),
      from_channels_(plant_, observations_of(plant_, trial)) {
  floors_.resize(static_cast<Eigen::Index>(trial.measured.size()));
  for (std::size_t c = 0; c < trial.measured.size(); ++c) {
    const int s = model.sensor_index(trial.measured[c].sensor);
    sensor_of_channel_.push_back(s);
    floors_[static_cast<Eigen::Index>(c)] = model.sensors[static_cast<std::size_t>(s)].floor();
  }
  command_samples_ = command_samples(model, trial.commands, trial.samples());
  refresh_commands();
}

void Predictor::refresh_commands() {
  commands_ = std::make_unique<integrate::HeldCommands>(command_samples_, trial_.period, plant_.delays());
}

// Value and slope of each channel at the window's first sample, from a quadratic over 25 samples around it
// (fewer at the trial's ends): long against the quantisation, short against the motion.
Eigen::MatrixXd Predictor::local_polynomial(const Window& window) const {
  const Eigen::Index reach = 12;
  const Eigen::Index from = std::max<Eigen::Index>(0, window.first - reach);
  const Eigen::Index to = std::min(trial_.samples() - 1, window.first + reach);
  const Eigen::Index n = to - from + 1;
  Eigen::MatrixXd V(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double s = static_cast<double>(from + i - window.first);
    V.row(i) << 1.0, s, s * s;
  }
  Eigen::MatrixXd Y(n, channels());
  for (int c = 0; c < channels(); ++c) {
    Y.col(c) = trial_.measured[static_cast<std::size_t>(c)].values.segment(from, n);
  }
  return V.colPivHouseholderQr().solve(Y);
}

Eigen::VectorXd Predictor::initial_state(const Window& window) {
  const Eigen::MatrixXd local = local_polynomial(window);
  const Eigen::Index nz = plant_.positions();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant_.states());
  x.head(nz) = from_channels_.positions(local.row(0).transpose());
  x.segment(nz, nz) = from_channels_.rates(local.row(1).transpose() / trial_.period);
  Eigen::VectorXd command(plant_.motors());
  commands_->at(window.first, 0, command.data());
  plant_.settle(command.data(), x.data());
  return x;
}

Eigen::MatrixXd Predictor::measured_positions() const {
  Eigen::MatrixXd y(channels(), trial_.samples());
  for (int c = 0; c < channels(); ++c) {
    y.row(c) = trial_.measured[static_cast<std::size_t>(c)].values.transpose();
  }
  return from_channels_.positions(y);
}

void Predictor::measure_motion() {
  const Eigen::Index n = trial_.samples();
  const Eigen::Index nz = plant_.positions();
  Eigen::MatrixXd rates(channels(), n);
  for (int c = 0; c < channels(); ++c) {
    const Eigen::VectorXd& values = trial_.measured[static_cast<std::size_t>(c)].values;
    rates.row(c) =
        sensing::differentiate(values, trial_.period, sensing::DifferentiationOptions::acausal()).transpose();
  }
  motion_.resize(2 * nz, n);
  motion_.topRows(nz) = measured_positions();
  motion_.bottomRows(nz) = from_channels_.rates(rates);
}

void Predictor::carry_hidden(const Window& window, double* x) {
  const std::vector<int> hidden = plant_.force_states();
  const bool too_short = trial_.samples() < sensing::DifferentiationOptions::acausal().window;
  if (hidden.empty() || too_short) {
    return;
  }
  if (motion_.size() == 0) {
    measure_motion();
  }
  for (const int i : hidden) {
    x[i] = 0.0;
  }
  const auto reach = static_cast<Eigen::Index>(std::lround(options_.history / trial_.period));
  for (Eigen::Index k = std::max<Eigen::Index>(0, window.first - reach); k < window.first; ++k) {
    plant_.carry_force_states(motion_.col(k).data(), motion_.col(k + 1).data(), trial_.period, x);
  }
}

// d(hidden states at the window's start)/d(parameters), states x parameters. The window has been run with the
// present parameters: its first state holds what they were carried to.
Eigen::MatrixXd Predictor::hidden_slopes(const Window& window, const std::vector<model::ParameterId>& ids,
                                         const Eigen::VectorXd& steps) {
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(plant_.states(), steps.size());
  const std::vector<int> owners = plant_.force_state_effects();
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

// Wide: the data decide; only directions that no sensor sees are held by it.
Eigen::VectorXd Predictor::initial_spread(const Window& window) {
  const Eigen::VectorXd x = initial_state(window);
  Eigen::VectorXd spread = Eigen::VectorXd::Ones(x.size());
  const Eigen::Index nz = plant_.positions();
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    spread[i] = i < nz ? 1.0 : std::max(1.0, 10.0 * std::abs(x[i]));
  }
  for (Eigen::Index i = 2 * nz; i < x.size(); ++i) {
    spread[i] = 1.0 + std::abs(x[i]);
  }
  for (const int i : plant_.force_states()) {
    spread[i] = 1e-9 * spread[i];  // not free: carried along the measured motion
  }
  return spread;
}

void Predictor::run(const Window& window, const Eigen::VectorXd& x0) {
  integrate::PlantOde ode(plant_, false, false);
  integrate::Options options;
  options.set_tolerance(options_.relative_tolerance);
  options.method = options_.method;
  options.order = options_.method == integrate::Method::explicit_rk ? 3 : 0;
  integrate::Integrator integrator(ode, options);
  refresh_commands();
  states_.resize(plant_.states(), window.count);
  states_.col(0) = x0;
  carry_hidden(window, states_.col(0).data());
  const double t0 = trial_.time[window.first];
  integrator.start(t0, states_.col(0));
  const std::vector<double>& breaks = commands_->breaks();
  for (Eigen::Index k = 0; k + 1 < window.count; ++k) {
    for (std::size_t b = 0; b < breaks.size(); ++b) {
      commands_->at(window.first + k, b, ode.command());
      integrator.input_changed(false);
      const double next = b + 1 < breaks.size() ? breaks[b + 1] : 1.0;
      integrator.advance(t0 + (static_cast<double>(k) + next) * trial_.period);
    }
    states_.col(k + 1) = integrator.state();
    if (static_cast<double>(integrator.summary().steps) >
        options_.most_steps * static_cast<double>(window.count)) {
      throw std::runtime_error("a window needs more integrator steps than are worth while");
    }
  }
  evaluations_ += integrator.summary().rate_evaluations;
}

Eigen::MatrixXd Predictor::predict(const Window& window, const Eigen::VectorXd& x0) {
  run(window, x0);
  Eigen::MatrixXd predicted(window.count, channels());
  Eigen::VectorXd y(plant_.sensors());
  for (Eigen::Index k = 0; k < window.count; ++k) {
    plant_.outputs(states_.col(k).data(), y.data());
    for (int c = 0; c < channels(); ++c) {
      predicted(k, c) = y[sensor_of_channel_[static_cast<std::size_t>(c)]];
    }
  }
  return predicted;
}

Eigen::VectorXd Predictor::residual_of(const Window& window, const Eigen::MatrixXd& predicted) const {
  Eigen::VectorXd r(window.count * channels());
  for (Eigen::Index k = 0; k < window.count; ++k) {
    for (int c = 0; c < channels(); ++c) {
      const double measured = trial_.measured[static_cast<std::size_t>(c)].values[window.first + k];
      r[k * channels() + c] = (measured - predicted(k, c)) / floors_[c];
    }
  }
  return r;
}

Eigen::VectorXd Predictor::residual(const Window& window, const Eigen::VectorXd& x0) {
  return residual_of(window, predict(window, x0));
}

// Linearisation over sample k of the window: at the middle of its states, under its mean command.
void Predictor::tangent_at(const Window& window, Eigen::Index k, const std::vector<model::ParameterId>& ids,
                           const Eigen::VectorXd& steps, bool refresh, Eigen::MatrixXd& A,
                           Eigen::MatrixXd& B) {
  Eigen::VectorXd command(plant_.motors());
  Eigen::VectorXd slope(plant_.motors());
  commands_->mean(window.first + k, command.data(), slope.data());
  const Eigen::VectorXd middle = 0.5 * (states_.col(k) + states_.col(k + 1));
  const Eigen::VectorXd change = states_.col(k + 1) - states_.col(k);
  plant_.tangent({middle.data(), change.data(), command.data(), slope.data(), trial_.period}, ids, steps,
                 refresh, A, B);
}

// Sensitivities S' = A S + B along the predicted motion, over each sample with A and B of its middle:
//   S <- D^-1 (N S + h B), D, N = I -+ hA/2 + (hA)^2/12,
// Pade's (2,2) approximation of the exponential (Hairer and Wanner, Solving ODEs II, IV.3): stable for stiff
// laws, fourth order in hA, one linearisation for each sample. The rigid parts are those of the middle of the
// samples that share them.
Linearisation Predictor::linearise(const Window& window, const Eigen::VectorXd& x0,
                                   const std::vector<FreeParameter>& parameters) {
  if (options_.differences) {
    return linearise_by_differences(window, x0, parameters);
  }
  for (const FreeParameter& parameter : parameters) {
    if (!parameter.also.empty()) {
      return linearise_tied(window, x0, parameters);
    }
  }
  Linearisation out;
  const Eigen::MatrixXd predicted = predict(window, x0);
  out.r = residual_of(window, predicted);
  const Eigen::Index nx = plant_.states();
  const auto np = static_cast<Eigen::Index>(parameters.size());
  std::vector<model::ParameterId> ids;
  Eigen::VectorXd steps(np);
  for (Eigen::Index p = 0; p < np; ++p) {
    const FreeParameter& parameter = parameters[static_cast<std::size_t>(p)];
    ids.push_back(parameter.id);
    const double here = plant_.value(parameter.id);
    const double reference = std::isfinite(here) && here != 0.0 ? std::abs(here) : parameter.typical;
    steps[p] = 1e-6 * reference;
    if (here + steps[p] > parameter.upper) {
      steps[p] = -steps[p];
    }
  }
  out.Jx.resize(out.r.size(), nx);
  out.Jp.resize(out.r.size(), np);
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(nx, nx + np);
  S.leftCols(nx).setIdentity();
  const std::vector<int> carried = plant_.force_states();
  if (!carried.empty()) {
    S.rightCols(np) = hidden_slopes(window, ids, steps);
  }
  for (const int i : carried) {
    S(i, i) = 0.0;  // it follows the measured motion, not the window's start
  }
  Eigen::MatrixXd A(nx, nx);
  Eigen::MatrixXd B;
  Eigen::MatrixXd C;
  Eigen::MatrixXd D;
  Eigen::MatrixXd right;
  Eigen::MatrixXd square;
  const double h = trial_.period;
  const Eigen::Index nz = plant_.positions();
  for (Eigen::Index k = 0; k < window.count; ++k) {
    plant_.output_jacobian(states_.col(k).data(), C);
    plant_.output_tangent(states_.col(k).data(), ids, steps, D);
    for (int c = 0; c < channels(); ++c) {
      const int s = sensor_of_channel_[static_cast<std::size_t>(c)];
      const Eigen::Index row = k * channels() + c;
      out.Jx.row(row).noalias() = C.row(s) * S.topLeftCorner(nz, nx);
      out.Jx.row(row) /= floors_[c];
      out.Jp.row(row).noalias() = C.row(s) * S.topRightCorner(nz, np);
      out.Jp.row(row) += D.row(s);
      out.Jp.row(row) /= floors_[c];
    }
    if (k + 1 == window.count) {
      break;
    }
    if (k % options_.refresh == 0) {
      tangent_at(window, std::min(k + options_.refresh / 2, window.count - 2), ids, steps, true, A, B);
    }
    tangent_at(window, k, ids, steps, false, A, B);
    A *= 0.5 * h;
    square.noalias() = A * A / 3.0;
    right.noalias() = (A + square) * S;
    right += S;
    right.rightCols(np) += h * B;
    A = square - A;
    A.diagonal().array() += 1.0;
    S = A.partialPivLu().solve(right);
  }
  return out;
}

// Each of the tied parameters by itself; their columns add up.
Linearisation Predictor::linearise_tied(const Window& window, const Eigen::VectorXd& x0,
                                        const std::vector<FreeParameter>& parameters) {
  std::vector<FreeParameter> apart;
  std::vector<Eigen::Index> owner;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    FreeParameter one = parameters[p];
    std::vector<model::ParameterId> ids{one.id};
    ids.insert(ids.end(), one.also.begin(), one.also.end());
    one.also.clear();
    for (const model::ParameterId& id : ids) {
      one.id = id;
      apart.push_back(one);
      owner.push_back(static_cast<Eigen::Index>(p));
    }
  }
  Linearisation out = linearise(window, x0, apart);
  Eigen::MatrixXd together =
      Eigen::MatrixXd::Zero(out.Jp.rows(), static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t k = 0; k < owner.size(); ++k) {
    together.col(owner[k]) += out.Jp.col(static_cast<Eigen::Index>(k));
  }
  out.Jp = together;
  return out;
}

// Central differences for parameters, whose influence may be small beside the integrator's error; one-sided
// ones for states. Steps are small against a contact's depth (1 mm) and long against that error.
Linearisation Predictor::linearise_by_differences(const Window& window, const Eigen::VectorXd& x0,
                                                  const std::vector<FreeParameter>& parameters) {
  constexpr double kPositionStep = 1e-5;
  constexpr double kVelocityStep = 1e-3;
  constexpr double kShareOfParameter = 0.05;
  Linearisation out;
  out.r = residual(window, x0);
  const Eigen::Index nx = plant_.states();
  const Eigen::Index nz = plant_.positions();
  out.Jx = Eigen::MatrixXd::Zero(out.r.size(), nx);
  out.Jp.resize(out.r.size(), static_cast<Eigen::Index>(parameters.size()));
  const std::vector<int> carried = plant_.force_states();
  Eigen::VectorXd moved = x0;
  for (Eigen::Index i = 0; i < nx; ++i) {
    if (std::find(carried.begin(), carried.end(), static_cast<int>(i)) != carried.end()) {
      continue;  // it follows the measured motion, not the window's start
    }
    const double step = i >= nz && i < 2 * nz ? kVelocityStep : kPositionStep;
    moved[i] = x0[i] + step;
    out.Jx.col(i) = (out.r - residual(window, moved)) / step;
    moved[i] = x0[i];
  }
  for (Eigen::Index p = 0; p < out.Jp.cols(); ++p) {
    const FreeParameter& parameter = parameters[static_cast<std::size_t>(p)];
    const double here = plant_.value(parameter.id);
    const double step = kShareOfParameter * (here != 0.0 ? std::abs(here) : parameter.typical);
    const double up = std::min(here + step, parameter.upper);
    const double down = std::max(here - step, parameter.lower);
    parameter.set(plant_, up);
    const Eigen::VectorXd above = residual(window, x0);
    parameter.set(plant_, down);
    out.Jp.col(p) = (residual(window, x0) - above) / (up - down);
    parameter.set(plant_, here);
  }
  return out;
}

}  // namespace plumbline::validation
