// ATRIAS runs: plan at takeoff, place the foot in flight, follow the plan with ground forces in stance. Wu
// (2017), chapter 5, Figure 5.1.
#pragma once

#include <array>
#include <cstddef>

#include "controllers/atrias_running/actuator.h"
#include "controllers/atrias_running/estimator.h"
#include "controllers/atrias_running/leg.h"
#include "controllers/atrias_running/planner.h"
#include "controllers/atrias_running/swing.h"

namespace plumbline::controllers::atrias {

/// Angles of a leg, rad: motors as they turn, links relative to the trunk, forward positive.
struct LegReading {
  double thigh_motor = 0.0, thigh = 0.0, shin_motor = 0.0, shin = 0.0;
};
struct Reading {
  std::array<LegReading, 2> legs;  ///< left, right
  double trunk = 0.0;              ///< rad, leaning back is positive
  double wanted = 0.0;             ///< m/s, the speed that is asked for
};

/// Currents of thigh and shin motor of the left leg, then of the right, A.
using Currents = std::array<double, 4>;

struct RunningNumbers {
  GaitNumbers gait;
  StanceRegulator::Design design;
  FilterNumbers filter;
  DriveNumbers drive;
  double horizon_infinite = 0.0;          ///< 1: the jump Riccati equation's gains
  double link = 0.5;                      ///< m, thigh; and lower leg from knee to toe
  double com_up = 0.08, com_ahead = 0.0;  ///< m, centre of mass from the hip, in the trunk
  std::array<double, 4> springs{};        ///< N m/rad: thigh and shin, left then right
  std::array<double, 2> leverage{1.,
                                 1.};  ///< of the left and the right leg: what their force weighs at a boom
  double friction_cone = 0.5;          ///< |F_x| <= this F_z
  double contact = 0.5;                ///< weights, force at which a leg stands
  double contact_from = 0.5;           ///< share of the flight before which no foot lands
  double clearance = 0.2;              ///< m, of a foot in the air
  double ready = 0.85;                 ///< share of the flight after which the foot moves with the ground
  double motor_filter = 1e-3;          ///< s, low-pass of the motors' speed
  double link_filter = 4e-3;           ///< s, of the links' and the trunk's
  double mirror_filter = 1e-2;         ///< s, of the wanted rates of a leg in the air
  double height_each_step = 1.0;       ///< 1: the height begins anew at each touchdown; 0: at the first only
  double learn = 1.0;                  ///< 1: adaptation of section 5.7
  double learn_from = 6.0;             ///< steps of a leg before its adaptation is used
  // A speed that climbs and falls in steps, as in section 5.8.2; no steps where speed_step is 0.
  double speed_step = 0.0;    ///< m/s, by which the wanted speed changes
  double speed_most = 0.0;    ///< m/s, up to which it climbs
  double speed_back = 1.0;    ///< 1: then it goes down again; 0: it stays
  double speed_every = 5.0;   ///< steps between two changes
  double speed_after = 20.0;  ///< steps before the first
  double fall = 1.0;          ///< rad of lean beyond which the power is turned off
};

enum class RunningFault { none = 0, fallen = 1 };
const char* to_string(RunningFault fault) noexcept;

/// Means over a stance, of magnitudes of what was missed.
struct StanceMeans {
  double x = 0.0, z = 0.0;     ///< m
  double force = 0.0;          ///< N, length of wanted less planned ground force
  double force_missed = 0.0;   ///< N, length of shown less wanted ground force
  double torque_missed = 0.0;  ///< N m, of both springs
  double lean = 0.0;           ///< rad
  long samples = 0;
};

class Running {
 public:
  /// Throws std::invalid_argument (one line) for a number that cannot be.
  Running(const RunningNumbers& numbers, double period);
  void reset() noexcept;
  Currents step(const Reading& reading) noexcept;

  struct State {
    bool stance = false;
    std::size_t leg = 0;        ///< that stands, or that is to land next
    double since = 0.0;         ///< s in this phase
    double steps = 0.0;         ///< touchdowns so far
    double wanted = 0.0;        ///< m/s
    double since_change = 0.0;  ///< steps since the wanted speed changed
    double placement = 0.0;     ///< m, planned: the centre of mass from the foot
    double placed = 0.0;        ///< m, the same as it was at the last touchdown
    double flight_speed = 0.0;  ///< m/s, at the last takeoff
    double speed_missed = 0.0;  ///< m/s, flight_speed less what was wanted
    double missed_first = 0.0;  ///< m/s, magnitude of the same at the last step that followed a change
    double apex = 0.0;          ///< m, foretold at the last takeoff, above the ground
    double peak = 0.0;          ///< N, largest upward force of the last stance
    Reference plan;
    Pair force;                 ///< wanted, N
    std::array<Pair, 2> shown;  ///< forces that the springs show, N
    StanceMeans means;          ///< of the last whole stance
    RunningFault fault = RunningFault::none;
  };
  const State& state() const noexcept { return state_; }
  const PointMassFilter& along() const noexcept { return along_; }
  const PointMassFilter& up() const noexcept { return up_; }
  double lean() const noexcept { return lean_; }  ///< rad, forward positive
  double apex_wanted() const noexcept { return numbers_.gait.landing + numbers_.gait.hop; }  ///< m
  /// For a return map: which leg is next.
  void set_leg(bool right) noexcept { state_.leg = right ? 1 : 0; }

 private:
  struct Leg {
    Pair angles, torque, foot;  // absolute, of the springs, relative to the hip
    std::array<Drive, 2> drives;
  };
  struct Aim {
    Pair angles, rates, accelerations;  // absolute
    bool known = false;
  };
  std::size_t other() const noexcept { return 1 - state_.leg; }
  double weight() const noexcept { return numbers_.gait.mass * numbers_.gait.gravity; }
  void read(const Reading& reading) noexcept;
  void estimate() noexcept;
  Pair carried(std::size_t leg) const noexcept;
  Pair mass_from_foot(std::size_t leg) const noexcept;
  void touch_down() noexcept;
  void take_off(double asked) noexcept;
  double next_wanted(double asked) noexcept;
  void plan_feet(double flight) noexcept;
  void stand(Currents& currents) noexcept;
  void keep_means(const Pair& torques) noexcept;
  void swing(std::size_t leg, const Pair& foot, Currents& currents) noexcept;

  RunningNumbers numbers_;
  double period_, motor_share_, link_share_, aim_share_;
  Planner planner_;
  StanceRegulator regulator_;
  double entry_ = 0.0;  // s of the plan at which the force is what detection waits for
  PointMassFilter along_, up_;
  std::array<Leg, 2> legs_;
  std::array<Aim, 2> aims_;
  std::array<FootPath, 2> paths_;
  std::array<SpeedAdaptation, 2> adaptations_;
  ContactDetection contact_;
  State state_;
  StanceMeans running_;  // of the stance under way
  Rate lean_rate_;
  double lean_ = 0.0, trunk_ = 0.0;
  Pair mass_;  // centre of mass from the hip
  double flight_time_ = 0.0, plan_speed_ = 0.0, foretold_ = 0.0, peak_ = 0.0;
  Pair mirror_gap_;  // between where the leg in the air was at touchdown and its mirror place
  double climbing_ = 1.0;
  bool begun_ = false, landed_ = false;
};

}  // namespace plumbline::controllers::atrias
