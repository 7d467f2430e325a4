// A robot that answers to a driver as hardware would: counts and switches out, torques in, a watchdog of its
// own.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "contact/terrain.h"
#include "controllers/driver/histogram.h"
#include "controllers/driver/packet.h"
#include "controllers/driver/transport.h"
#include "simulator/integrate/integrator.h"
#include "simulator/run/sensors.h"
#include "simulator/run/simulation.h"
#include "validation/control/robot/wire_fault.h"

namespace plumbline::validation {

struct RobotOptions {
  double period = 1e-3;  ///< s between two samples
  /// s after a sample within which its command, or that of a later one, must have come while the power is on;
  /// until then the command before holds. MABEL's computer let a watchdog timer cut the power when an update
  /// took longer than its period of 1 ms (Park et al., section Embedded computer).
  double watchdog = 1e-3;
  double patience = 0.02;         ///< s that it waits for a command where it does not run in real time
  bool real_time = true;          ///< false: the next sample follows as soon as the command is there
  double longest = 0.0;           ///< s after which it ends; 0: none
  bool once = false;              ///< end when a driver that had been there is silent for 2 s
  std::vector<WireFault> faults;  ///< the first for the first run, and so on
  std::uint64_t seed = 1;         ///< of sensor noise and of flipped bits
  integrate::Options integrator;
};

/// One run, from hand-over until the power was off.
struct RobotRun {
  double time = 0.0;            ///< s under power
  long landings = 0;            ///< a foot down after a time with none
  std::string fault;            ///< as it was asked for; empty: none
  std::int64_t fault_at = -1;   ///< sequence of the first packet that it touched
  std::int64_t zero_at = -1;    ///< newest packet that the driver knew when it took the power away
  double fault_to_zero = -1.0;  ///< s on the robot's wall clock between the two
  bool watchdog = false;        ///< the robot's own watchdog cut the power
  double watchdog_after = 0.0;  ///< s after the sample whose command did not come
};

/// What a robot has seen in its life.
struct RobotReport {
  std::vector<RobotRun> runs;
  std::uint64_t samples = 0, commands = 0, corrupt = 0, slipped = 0;
  double largest_slip = 0.0;     ///< s that a sample was late, the integrator having taken longer
  driver::Histogram round_trip;  ///< from a sample's departure to its command
  std::string end;
};

/// Until told to hand over, the robot hangs in a stand that holds all its joints in the start's posture. The
/// running flag opens the stand. Without power the motors deliver nothing and the robot falls; a reset puts
/// it back into the stand.
class SimulatedRobot {
 public:
  /// `start`: a state of the plant on this terrain. Throws InputError where the packet has no room for the
  /// model's sensors.
  SimulatedRobot(const model::Model& model, const contact::Terrain& terrain, const Eigen::VectorXd& start,
                 const RobotOptions& options);
  ~SimulatedRobot();

  /// Serves a driver until `stop` says so, or as the options say.
  RobotReport serve(driver::Transport& transport, const std::function<bool()>& stop);

 private:
  void to_stand();
  driver::Packet sample();
  bool send(driver::Transport& transport, const driver::Packet& packet);
  void wait_for_command(driver::Transport& transport, bool sent, std::int64_t next);
  bool receive(driver::Transport& transport);
  void take(const driver::Packet& command);
  void cut_power(bool by_watchdog, double after);
  void end_run();
  void advance();
  void watch_landings();

  model::Model model_;
  RobotOptions options_;
  model::Plant plant_;
  std::unique_ptr<run::Simulation> simulation_;
  run::Sensors sensors_;
  run::Sensed sensed_;
  Eigen::VectorXd start_, command_, none_;
  driver::Packet out_, newest_;
  bool heard_ = false, power_ = false, tripped_ = false, released_ = false, down_ = false, in_run_ = false;
  bool broken_ = false;  // the integrator has given up: it lies where it is
  std::size_t run_ = 0;
  double run_time_ = 0.0;
  std::int64_t fault_wall_ = 0, heard_at_ = 0;
  std::int64_t unanswered_ = 0;  // when the oldest sample was sent that no command has followed; 0: none
  double in_air_ = 0.0;          // s that no foot has been on the ground
  std::unique_ptr<FaultInjector> injector_;
  RobotReport report_;
};

}  // namespace plumbline::validation
