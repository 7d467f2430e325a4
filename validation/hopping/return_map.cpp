#include "validation/hopping/return_map.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <deque>
#include <stdexcept>
#include <thread>

#include "validation/hopping/hip_watch.h"
#include "validation/hopping/hop_simulation.h"
#include "validation/hopping/hop_watchdog.h"
#include "validation/predict/problem.h"

namespace plumbline::validation {
namespace {

using controllers::HoppingConfig;
using controllers::HoppingPhase;

constexpr std::size_t kHistory = 15;                                   // samples, longer than any rate filter
constexpr std::size_t kAveraged = 10;                                  // apexes
constexpr double kPosition = 1e-3, kVelocity = 1e-2, kContact = 1e-5;  // smallest steps, SI

/// Follows a simulation sample by sample and finds apexes.
class ApexFinder {
 public:
  explicit ApexFinder(const HopSimulation& simulation, const std::string& height)
      : height_(height), past_{simulation.state()} {}

  /// After each sample; an apex lies between this sample and the one before.
  std::optional<Apex> look(const HopSimulation& s) {
    const double rate = s.plant().velocity_of(height_, s.state().data());
    const bool flight = s.loop().controller().phase() == HoppingPhase::flight;
    const bool passed = flight && !touching(s) && rate <= 0.0 && rate_ > 0.0;
    const double share = passed ? rate_ / (rate_ - rate) : 0.0;  // of the sample
    rate_ = rate;
    past_.push_back(s.state());
    if (past_.size() > kHistory + 2) {
      past_.pop_front();
    }
    if (!passed || past_.size() < kHistory + 2) {
      return std::nullopt;
    }
    return make(s, share);
  }

 private:
  static bool touching(const HopSimulation& s) {
    return std::any_of(s.touches().begin(), s.touches().end(),
                       [](const model::Touch& touch) { return touch.depth > 0.0; });
  }

  Apex make(const HopSimulation& s, double share) const {
    const auto between = [&](std::size_t i) -> Eigen::VectorXd {
      return (1.0 - share) * past_[i] + share * past_[i + 1];
    };
    Apex apex;
    apex.state = between(kHistory);
    apex.history.resize(apex.state.size(), static_cast<Eigen::Index>(kHistory));
    for (std::size_t i = 0; i < kHistory; ++i) {
      apex.history.col(static_cast<Eigen::Index>(i)) = between(i) - apex.state;
    }
    const controllers::Hopping& controller = s.loop().controller();
    apex.h_T_d = controller.h_T_d();
    apex.travel_at_landing =
        static_cast<double>(controller.tower_at_landing()) * s.loop().travel_resolution();
    return apex;
  }

  std::string height_;
  std::deque<Eigen::VectorXd> past_;
  double rate_ = 0.0;
};

/// Until the given number of apexes, or the end.
std::vector<Apex> apexes_of(HopSimulation& simulation, const HipWatch& watch, const std::string& height,
                            std::size_t count, std::string& end, const StopFlag* stop) {
  std::vector<Apex> apexes;
  HopWatchdog watchdog(watch);
  simulation.sample();
  ApexFinder finder(simulation, height);
  while (apexes.size() < count && end.empty()) {
    if (stop != nullptr && stop->raised) {
      throw Stopped();
    }
    simulation.advance();
    simulation.sample();
    if (auto apex = finder.look(simulation)) {
      apexes.push_back(*apex);
    }
    end = watchdog.look(simulation);
  }
  return apexes;
}

/// The map itself, with what does not change while it is evaluated.
class ReturnMap {
 public:
  ReturnMap(const model::Model& model, const HoppingConfig& config, const OrbitOptions& options)
      : model_(model), config_(config), options_(options), watch_(model, config), axes_(hip_axes(model)) {
    const model::Plant plant(model, {});
    positions_ = plant.positions();
    travel_sensor_ = model.sensor_index(axes_.travel);
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(plant.sensors(), travel_sensor_);
    along_ = plant.output_map().completeOrthogonalDecomposition().solve(unit);
    across_ = plant.output_map().row(travel_sensor_);
  }

  std::vector<Apex> run(std::string& end) const {
    HopSimulation simulation(model_, config_, options_.run.integrator);
    simulation.start(start_state(simulation.plant(), config_, options_.start));
    return apexes_of(simulation, watch_, axes_.height, static_cast<std::size_t>(options_.hops), end,
                     options_.run.stop);
  }

  void use_history(const Eigen::MatrixXd& history) { history_ = history; }
  void hold_torso(double h_T_d) { held_ = h_T_d; }

  /// (state with the travel counted from the last landing; h_T^d).
  Eigen::VectorXd vector_of(const Apex& apex) const {
    Eigen::VectorXd u(apex.state.size() + 1);
    u.head(apex.state.size()) = apex.state;
    const double moved = held_ ? across_.dot(apex.state.head(positions_)) : apex.travel_at_landing;
    u.head(positions_) -= along_ * moved;
    u[apex.state.size()] = held_ ? 0.0 : apex.h_T_d;
    return u;
  }

  std::optional<Eigen::VectorXd> operator()(const Eigen::VectorXd& u) const {
    HoppingConfig config = config_;
    config.parameters.event_update = config.parameters.event_update && !held_;
    HopSimulation simulation(model_, config, options_.run.integrator);
    const Eigen::Index n = u.size() - 1;
    const Eigen::VectorXd x = u.head(n);
    Eigen::MatrixXd outputs(simulation.plant().sensors(), history_.cols());
    for (Eigen::Index i = 0; i < history_.cols(); ++i) {
      Eigen::VectorXd past = x + history_.col(i);
      const double ago = static_cast<double>(history_.cols() - i) * config_.period;
      past.head(positions_) -= ago * (x - reference_).segment(positions_, positions_);
      simulation.plant().outputs(past.data(), outputs.col(i).data());
    }
    simulation.loop().resume(held_ ? *held_ : u[n], 0, outputs);
    simulation.start(x);
    std::string end;
    try {
      const std::vector<Apex> next = apexes_of(simulation, watch_, axes_.height, 1, end, options_.run.stop);
      return next.empty() ? std::nullopt : std::optional<Eigen::VectorXd>(vector_of(next.front()));
    } catch (const Stopped&) {
      throw;
    } catch (const std::runtime_error&) {
      return std::nullopt;
    }
  }

  void deviations_from(const Eigen::VectorXd& reference) { reference_ = reference; }
  Eigen::Index positions() const { return positions_; }

 private:
  const model::Model& model_;
  const HoppingConfig& config_;
  const OrbitOptions& options_;
  HipWatch watch_;
  HipAxes axes_;
  Eigen::Index positions_ = 0;
  int travel_sensor_ = 0;
  Eigen::VectorXd along_, across_;  // of the travel, in positions
  Eigen::MatrixXd history_;
  Eigen::VectorXd reference_;
  std::optional<double> held_;
};

/// Scatter of the last apexes within what is large against counts and still small for a gait.
Eigen::VectorXd steps_of(const Eigen::MatrixXd& points, Eigen::Index positions) {
  const Eigen::VectorXd mean = points.rowwise().mean();
  const Eigen::VectorXd scatter =
      ((points.colwise() - mean).rowwise().squaredNorm() / static_cast<double>(points.cols() - 1))
          .cwiseSqrt();
  const Eigen::Index contact = points.rows() - 1 - 2 * positions;
  Eigen::VectorXd smallest(points.rows());
  smallest << Eigen::VectorXd::Constant(positions, kPosition),
      Eigen::VectorXd::Constant(positions, kVelocity), Eigen::VectorXd::Constant(contact, kContact),
      kPosition;
  return scatter.cwiseMax(smallest).cwiseMin(10.0 * smallest);
}

}  // namespace

Orbit find_orbit(const model::Model& model, const HoppingConfig& config, const OrbitOptions& options) {
  Orbit orbit;
  ReturnMap map(model, config, options);
  const std::vector<Apex> apexes = map.run(orbit.why_not);
  if (!orbit.why_not.empty() || apexes.size() < kAveraged) {
    return orbit;
  }
  orbit.settled = true;
  Eigen::MatrixXd points(apexes.back().state.size() + 1, static_cast<Eigen::Index>(kAveraged));
  Eigen::MatrixXd history = Eigen::MatrixXd::Zero(apexes.back().history.rows(), apexes.back().history.cols());
  for (std::size_t k = 0; k < kAveraged; ++k) {
    const Apex& apex = apexes[apexes.size() - kAveraged + k];
    points.col(static_cast<Eigen::Index>(k)) = map.vector_of(apex);
    history += apex.history / static_cast<double>(kAveraged);
  }
  const Eigen::VectorXd steps = steps_of(points, map.positions());
  const Eigen::VectorXd guess = points.rowwise().mean();
  const int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  map.use_history(history);
  map.deviations_from(guess.head(guess.size() - 1));
  const Map with = [&](const Eigen::VectorXd& u) { return map(u); };
  const FixedPoint point = find_fixed_point(with, guess, steps, options.tolerance, options.rounds, threads);
  orbit.found = point.found;
  orbit.residual = point.residual;
  orbit.rounds = point.rounds;
  orbit.growth = point.growth;
  orbit.h_T_d = point.at[point.at.size() - 1];
  const auto wide = central_differences(with, point.at, 2.0 * steps, threads);
  orbit.growth_twice_step = wide ? growth_of(*wide) : 0.0;
  map.hold_torso(orbit.h_T_d);
  Eigen::VectorXd held = point.at;
  held[held.size() - 1] = 0.0;
  const auto without = central_differences(with, held, steps, threads);
  const auto without_wide = central_differences(with, held, 2.0 * steps, threads);
  orbit.growth_without_update = without ? growth_of(*without) : 0.0;
  orbit.growth_without_twice_step = without_wide ? growth_of(*without_wide) : 0.0;
  orbit.found = orbit.found && without && point.slope.size() > 0;
  return orbit;
}

}  // namespace plumbline::validation
