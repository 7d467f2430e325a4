// A rig in motion: its equations with what couples links and motors, and their integration by the classical
// Runge-Kutta method with fixed steps (Rig::step, 20 us; MABEL 10 us). No event is looked for: stops, play
// and ground are met within a step. A rig with light coordinates (Rig::light) alone takes a step in which one
// of these or a foot changes sides in ten.
#pragma once

#include <functional>
#include <utility>

#include "tests/battery/worlds/ground.h"

namespace plumbline::battery::worlds {

constexpr int kMostStates = 40;
using State = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMostStates, 1>;

/// Commands of the motors at sample k, from true sensor values read there.
using Commander = std::function<void(Eigen::Index k, const Eigen::VectorXd& readings, Vector& commands)>;

/// At the samples: links' coordinates and then motors, and what was commanded.
struct Motion {
  Eigen::MatrixXd positions, rates;  ///< links' coordinates and motors x samples
  Eigen::MatrixXd commands;          ///< motors x samples
  Eigen::MatrixXd bristles;          ///< under the feet that have them x samples
};

/// What the sensors would show without counts and noise, of links' coordinates and motors.
Eigen::VectorXd readings_of(const Rig& rig, const Vector& full);
/// Does the motor's gear give, so that it moves by itself?
bool gives(const Rig& rig, const Motor& motor);

class Machine {
 public:
  /// `start` gives the links' coordinates; locked motors stay where these put them.
  Machine(const Rig& rig, const std::vector<std::string>& locked, const Vector& start);

  Eigen::Index positions() const { return S_.cols(); }
  Eigen::Index states() const { return states_; }
  /// At the start, actuators settled to the commands; `links_rate`: of the links' coordinates, empty: at
  /// rest.
  State start_state(const Vector& commands, const Vector& links_rate = {}) const;
  /// With the inertia of all.
  void rates(const Vector& commands, const State& x, State& rate) const { rates(commands, 0, x, rate); }

  /// Over sample k. `commands`: motors x samples, up to k.
  void advance(State& x, const Eigen::MatrixXd& commands, Eigen::Index k, double period) const;
  /// From state x at sample `first` over `count` samples of `period`.
  Motion run(State x, Eigen::Index first, Eigen::Index count, double period, const Commander& command) const;

  const Rig& rig() const { return rig_; }
  /// A motion of so many samples, not yet written.
  Motion room_for(Eigen::Index count) const;
  /// Writes sample k of a motion, but for its commands.
  void note(const State& x, Eigen::Index k, Motion& motion) const;
  /// Positions and rates of the links' coordinates and the motors, and the state that has them (lags and the
  /// bristles of laws 0; those of feet as given).
  Vector positions_of(const State& x) const;
  Vector rates_of(const State& x) const;
  State state_of(const Vector& full, const Vector& full_rate, const Vector& bristles = {}) const;

 private:
  /// A law that acts along a row of links' coordinates and motors.
  struct Acting {
    Hidden effect;
    Vector row;
    int motor = -1;  // at which it sits; -1: a place of the links
    int state = -1;
    bool compliance = false;
    Law law = nullptr;  // nullptr: it needs a state, or is a compliance
  };

  /// A current loop of second order, an amplifier that turns round slowly, what warms (two states), or a
  /// winding's current (one).
  struct Loop {
    std::size_t motor = 0;
    int state = 0;
    Hidden effect;
  };

  /// A set of light coordinates, a bit each.
  using Creeping = unsigned;
  /// What wanders by itself: a load on a link (its distance), the mounting (its tilt).
  struct Wandering {
    Hidden effect;
    Vector row;
    int state = 0;
  };
  /// A coordinate that creeps behind a stop.
  struct Light {
    Eigen::Index row = 0, column = 0;
    std::vector<std::size_t> acting;  // on it
    std::vector<std::size_t> stops;   // among them
  };

  /// The link's coordinate or motor that an independent position is.
  Eigen::Index own_row(Eigen::Index column) const;
  void build_coupling(const std::vector<std::string>& locked, const Vector& start);
  void add_bristles();
  void add_effects();
  void add_light();
  /// Of outside.h, with a state of its own; false: it is none of these.
  bool add_outside(const Hidden& effect, std::size_t motor);
  /// The links' equations with what wanders.
  void equations(const State& x, const Vector& p, const Vector& v, Matrix& links, Vector& bias,
                 State& rate) const;
  void tilt(double angle, const Vector& p, const Vector& v, Vector& bias) const;
  double force_of(const Acting& one, const State& x, const Vector& full, const Vector& full_rate,
                  double load) const;
  bool is_behind(const Light& one, const Vector& full) const;
  /// Gives the light coordinates of the set that are behind their stop the speed at which the forces on them
  /// are in balance.
  void creep(Creeping who, const State& x, const Vector& full, Vector& full_rate) const;
  /// Those that are behind their stop and have come to that speed, which they then have exactly.
  Creeping settle(State& x) const;
  /// One step of a set that creeps.
  State stepped(const Vector& commands, Creeping who, const State& x, double h) const;
  void step(const Vector& commands, double h, State& x) const;
  std::vector<bool> sides(const State& x) const;
  void rates(const Vector& commands, Creeping who, const State& x, State& rate) const;
  static double warmed(const Loop& one, double asked, const State& x, State& rate);
  static double through(const Loop& loop, double asked, const State& x, State& rate);
  void sag(const Vector& full_rate, Vector& Q) const;
  Vector forces(const Vector& commands, const State& x, const Vector& full, const Vector& full_rate,
                const Vector& loads, Vector& passed, State& rate) const;

  Rig rig_;
  Eigen::Index n_ = 0;  // links' coordinates
  Matrix S_;            // links' coordinates and motors over what moves by itself
  Vector offset_;
  Vector start_;
  bool free_ = false;               // nothing ties the coordinates to each other: S_ is the identity
  std::vector<int> bristle_state_;  // of each ground; -1: none
  std::vector<Light> light_;
  std::vector<Acting> acting_;
  std::vector<int> lag_state_;  // of each motor; -1: none
  std::vector<double> lag_, bias_, delay_, drift_;
  std::vector<Loop> loops_, warming_, circuits_;
  std::vector<Wandering> loads_, tilting_;
  std::vector<Rig> gravities_;  // for a mounting that tilts: none, upright, on its side
  std::vector<Hidden> batteries_;
  std::vector<std::pair<std::size_t, Hidden>> windings_;  // of which motor, in order of action
  bool load_matters_ = false;
  Eigen::Index states_ = 0;
};

}  // namespace plumbline::battery::worlds
