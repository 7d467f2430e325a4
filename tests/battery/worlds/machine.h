// A rig in motion: its equations with what couples links and motors, and their integration by the classical
// Runge-Kutta method with fixed steps of 20 us. No event is looked for: stops, play and ground are met within
// a step.
#pragma once

#include <functional>

#include "tests/battery/worlds/rig.h"

namespace plumbline::battery::worlds {

constexpr int kMostStates = 20;
using State = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMostStates, 1>;

constexpr double kStep = 2e-5;  ///< s

/// Commands of the motors at sample k, from true sensor values read there.
using Commander = std::function<void(Eigen::Index k, const Eigen::VectorXd& readings, Vector& commands)>;

/// At the samples: links' coordinates and then motors, and what was commanded.
struct Motion {
  Eigen::MatrixXd positions, rates;  ///< links' coordinates and motors x samples
  Eigen::MatrixXd commands;          ///< motors x samples
};

/// What the sensors would show without counts and noise, of links' coordinates and motors.
Eigen::VectorXd readings_of(const Rig& rig, const Vector& full);
/// How deep the foot is, m, and the force on it, N.
double depth_of(const Rig& rig, const Ground& ground, const Vector& full);
double ground_force_of(const Rig& rig, const Ground& ground, const Vector& full, const Vector& full_rate);
/// Is the foot's switch closed? While the ground pushes with more than Rig::switch_force.
bool is_closed(const Rig& rig, const Ground& ground, const Vector& full, const Vector& full_rate);
/// Does the motor's gear give, so that it moves by itself?
bool gives(const Rig& rig, const Motor& motor);

class Machine {
 public:
  /// `start` gives the links' coordinates; locked motors stay where these put them.
  Machine(const Rig& rig, const std::vector<std::string>& locked, const Vector& start);

  Eigen::Index positions() const { return S_.cols(); }
  Eigen::Index states() const { return states_; }
  /// At rest at the start, actuators settled to the commands.
  State start_state(const Vector& commands) const;
  void rates(const Vector& commands, const State& x, State& rate) const;

  /// From state x at sample `first` over `count` samples of `period`.
  Motion run(State x, Eigen::Index first, Eigen::Index count, double period, const Commander& command) const;

  const Rig& rig() const { return rig_; }
  /// Positions and rates of the links' coordinates and the motors, and the state that has them (bristles and
  /// lags 0).
  Vector positions_of(const State& x) const;
  Vector rates_of(const State& x) const;
  State state_of(const Vector& full, const Vector& full_rate) const;

 private:
  /// A law that acts along a row of links' coordinates and motors.
  struct Acting {
    Hidden effect;
    Vector row;
    int motor = -1;  // at which it sits; -1: a place of the links
    int state = -1;
    bool compliance = false;
  };

  /// The link's coordinate or motor that an independent position is.
  Eigen::Index own_row(Eigen::Index column) const;
  void build_coupling(const std::vector<std::string>& locked, const Vector& start);
  void add_effects();
  Vector forces(const Vector& commands, const State& x, const Vector& full, const Vector& full_rate,
                const Vector& loads, Vector& passed, State& rate) const;

  Rig rig_;
  Eigen::Index n_ = 0;  // links' coordinates
  Matrix S_;            // links' coordinates and motors over what moves by itself
  Vector offset_;
  Vector start_;
  std::vector<Acting> acting_;
  std::vector<int> lag_state_;  // of each motor; -1: none
  std::vector<double> lag_, bias_, delay_;
  bool load_matters_ = false;
  Eigen::Index states_ = 0;
};

}  // namespace plumbline::battery::worlds
