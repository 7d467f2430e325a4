// Where a window begins: what the sensors, the trial's start and its flights say of the first state.
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "validation/identify/predict/jump_surface.h"
#include "validation/identify/predict/stance.h"
#include "validation/identify/predict/windows.h"

namespace plumbline::validation {

/// Of the sensors of positions and poses, then of the trial's start, which yields to every sensor.
std::vector<model::Observation> start_observations(const model::Plant& plant, const Trial& trial) {
  std::vector<model::Observation> channels;
  for (const Measured& channel : trial.measured) {
    const int sensor = plant.model().sensor_index(channel.sensor);
    const model::Sensor& of = plant.model().sensors[static_cast<std::size_t>(sensor)];
    if (of.shows_position() || of.shows_pose()) {
      channels.push_back(model::observe_sensor(plant, sensor));
    }
  }
  for (const Start& start : trial.start) {
    channels.push_back(model::observe_place(plant, start.coordinate, start.deviation));
  }
  return channels;
}

// Value and slope of each channel at the window's first sample, from a quadratic over 25 samples around it
// (fewer at the trial's ends, and at touchdown and lift-off): long against the quantisation, short against
// the motion.
Eigen::MatrixXd Predictor::local_polynomial(const Window& window) const {
  const Eigen::Index reach = 12;
  Eigen::Index from = std::max<Eigen::Index>(0, window.first - reach);
  Eigen::Index to = std::min(trial_.samples() - 1, window.first + reach);
  stay_in_phase(window.first, from, to);
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
  const Eigen::VectorXd values = with_starts(local.row(0).transpose(), false);
  x.head(nz) = from_channels_.positions(values);
  x.segment(nz, nz) =
      from_channels_.rates(with_starts(local.row(1).transpose() / trial_.period, true), x.head(nz), values);
  if (!trial_.start.empty()) {
    fall_freely(window, x);
  } else if (trial_.switches.empty() && plant_.meets_ground()) {
    const Eigen::VectorXd deviations = from_channels_.deviations();
    const std::vector<Eigen::Index> unseen = unseen_positions(deviations);
    if (unseen.empty()) {
      stand_on_ground(plant_, deviations, x);
    } else {
      stand_by_unseen(plant_, unseen, x);
    }
  }
  Eigen::VectorXd command(plant_.motors());
  commands_->at(window.first, 0, command.data());
  // A stretch that no sensor sees begins where it is put, not as far inside as it might be.
  begin_inside(plant_, command.data(), from_channels_.deviations_unstretched(), trial_.period, x);
  if (window.first == 0) {
    commands_->before(command.data());
  }
  plant_.settle(command.data(), x.data());
  return x;
}

// Position channels x samples, behind them where the trial starts (of rates: zero).
Eigen::MatrixXd Predictor::with_starts(const Eigen::MatrixXd& channels, bool rates) const {
  const auto seen = static_cast<Eigen::Index>(position_channels_.size());
  const auto starts = static_cast<Eigen::Index>(trial_.start.size());
  Eigen::MatrixXd all(seen + starts, channels.cols());
  for (Eigen::Index i = 0; i < seen; ++i) {
    all.row(i) = channels.row(position_channels_[static_cast<std::size_t>(i)]);
  }
  for (Eigen::Index i = 0; i < starts; ++i) {
    all.row(seen + i).setConstant(rates ? 0.0 : trial_.start[static_cast<std::size_t>(i)].position);
  }
  return all;
}

// In free fall all coordinates keep the acceleration a that gravity gives them at the start: with t_m the
// middle of the flight between lift-off and touchdown at t_d, at equal heights,
//   dz/dt = a (t - t_m),  z = z_d + a/2 ((t - t_m)^2 - (t_d - t_m)^2),
// z_d the start shifted along a to where the foot just touches.
void Predictor::fall_freely(const Window& window, Eigen::VectorXd& x) {
  const std::optional<Flight> flight = flight_at(trial_, window.first);
  if (!flight || !plant_.meets_ground()) {
    return;
  }
  const Eigen::Index nz = plant_.positions();
  const int foot = foot_of_switch_[static_cast<std::size_t>(flight->record)];
  const double depth = plant_.foot_depth(foot, x.data()).depth;
  const Eigen::VectorXd a = plant_.fall(x.data());
  const double sinking = plant_.depth_slope(foot, x.data()).dot(a);
  if (depth > 0.0 || !std::isfinite(depth) || !(sinking > 0.0)) {
    return;
  }
  const double middle = 0.5 * (flight->lift_off + flight->touchdown);
  const double now = trial_.time[window.first] - middle;
  const double end = flight->touchdown - middle;
  x.head(nz) += (0.5 * (now * now - end * end) - depth / sinking) * a;
  x.segment(nz, nz) = now * a;
  touch_down_in_time(window, foot, flight->touchdown, a, x);
}

// What moves the foot in flight (a spring that is not at rest after all) shifts the touchdown; the start is
// carried along its fall until it comes when the switch says.
void Predictor::touch_down_in_time(const Window& window, int foot, double touchdown, const Eigen::VectorXd& a,
                                   Eigen::VectorXd& x) {
  constexpr int kCorrections = 3;
  constexpr double kBehind = 0.05;  // s
  constexpr double kInTime = 1e-5;  // s
  const double time = touchdown - trial_.time[window.first];
  const auto samples = static_cast<Eigen::Index>(std::ceil((time + kBehind) / trial_.period));
  const Window until{window.trial, window.first, std::min(samples, window.count), {}};
  const Eigen::Index nz = plant_.positions();
  for (int i = 0; i < kCorrections; ++i) {
    run(until, x);
    const Crossing crossing = nearest_crossing(foot, 0.0, true, time, kBehind);
    if (crossing.node < 0) {
      return;
    }
    const double late = crossing.time - time;
    if (std::abs(late) < kInTime) {
      return;
    }
    x.head(nz) += late * (x.segment(nz, nz) + 0.5 * late * a);
    x.segment(nz, nz) += late * a;
  }
}

Eigen::VectorXd Predictor::search_start(const Window& window) {
  constexpr double kEarlier = 3e-3;  // s
  constexpr int kSteps = 15;         // each way
  Eigen::VectorXd best = initial_state(window);
  if (trial_.start.empty() || window.events.empty()) {
    return best;
  }
  const Eigen::Index nz = plant_.positions();
  const Eigen::VectorXd expected = best;
  const Eigen::VectorXd a = plant_.fall(expected.data());
  double least = residual(window, best).squaredNorm();
  for (int i = -kSteps; i <= kSteps; ++i) {
    const double sooner = kEarlier * i / kSteps;
    Eigen::VectorXd x = expected;
    x.head(nz) += sooner * (x.segment(nz, nz) + 0.5 * sooner * a);
    const double square = residual(window, x).squaredNorm();
    if (square < least) {
      least = square;
      best = x;
    }
  }
  return best;
}

// Wide: the data decide; only directions that no sensor sees are held by it. Of what the trial's start says
// the positions are known as it says, and the speeds as well as they would be by that in kRest.
Eigen::VectorXd Predictor::spread_around(const Eigen::VectorXd& x) const {
  constexpr double kRest = 0.05;  // s
  Eigen::VectorXd spread = Eigen::VectorXd::Ones(x.size());
  const Eigen::Index nz = plant_.positions();
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    spread[i] = i < nz ? 1.0 : std::max(1.0, 10.0 * std::abs(x[i]));
  }
  if (!trial_.start.empty()) {
    spread.head(nz) = from_channels_.deviations();
    spread.segment(nz, nz) = spread.head(nz) / kRest;
  }
  const Eigen::VectorXd bent = bent_by_sliding(plant_);
  for (Eigen::Index i = 2 * nz; i < x.size(); ++i) {
    spread[i] = std::isfinite(bent[i]) ? bent[i] : 1.0 + std::abs(x[i]);
  }
  for (const int i : plant_.carried_states()) {
    spread[i] = 1e-9 * spread[i];  // not free: the past determines them
  }
  return spread;
}

Predictor::Anchor Predictor::anchor(const Window& window, const Eigen::VectorXd& x0,
                                    const Eigen::VectorXd& r) {
  const double rms = std::sqrt(r.squaredNorm() / static_cast<double>(r.size()));
  const double error = std::max(1.0, rms);
  const Eigen::VectorXd expected = initial_state(window);
  Eigen::VectorXd weight = spread_around(expected).cwiseInverse();
  if (!trial_.start.empty()) {
    weight *= error;
  } else {  // nor are bristles bent further than sliding bends them
    weight = bent_by_sliding(plant_).array().isFinite().select(error * weight, weight);
  }
  return {weight.cwiseProduct(expected - x0), weight};
}

}  // namespace plumbline::validation
