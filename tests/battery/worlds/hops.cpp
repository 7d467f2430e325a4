#include "tests/battery/worlds/hops.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "simulator/run/wired_controller.h"

namespace plumbline::battery::worlds {
namespace {

constexpr double kShortestFlight = 0.02;  // s; a foot that is up for less has bounced (hopping.yaml)
constexpr double kLongestHop = 1.0;       // s; a hop takes 0.6

Vector coordinates_of(const Rig& rig, const std::vector<run::Named>& named) {
  Vector p = Vector::Zero(rig.coordinates);
  for (const auto& [name, value] : named) {
    const Place* place = rig.place(name);
    if (place == nullptr || place->row.cwiseAbs().sum() != 1.0) {
      throw std::invalid_argument("no foreign world starts at " + name);
    }
    Eigen::Index k = 0;
    place->row.maxCoeff(&k);
    p[k] = value;
  }
  return p;
}

/// The named pose, lifted until the lowest foot is so high above the floor.
Vector pose_of(const Rig& rig, const run::Start& start) {
  Vector p = coordinates_of(rig, start.positions);
  const Place* height = rig.place(start.height);
  if (height == nullptr) {
    throw std::invalid_argument("no foreign world lifts " + start.height);
  }
  Rig level = rig;
  double deepest = -1e9;
  for (Ground& ground : level.grounds) {
    ground.height = 0.0;  // the scenario's floor, whatever is hidden
    deepest = std::max(deepest, depth_of(level, ground, p));
  }
  p += (deepest + start.clearance) * height->row;
  return p;
}

/// Has everything landed together, behind a flight?
class Landings {
 public:
  bool look(double now, const std::vector<bool>& down) {
    const bool all = std::all_of(down.begin(), down.end(), [](bool one) { return one; });
    const bool none = std::none_of(down.begin(), down.end(), [](bool one) { return one; });
    if (!none) {
      since_ = now;
    }
    flown_ = flown_ || (none && now - since_ >= kShortestFlight);
    const bool landed = all && flown_;
    flown_ = flown_ && !landed;
    return landed;
  }

 private:
  double since_ = 0.0;
  bool flown_ = true;  // it starts in the air
};

/// The robot's electronics: what the controller is shown of a sample.
run::Sensed sensed(const Rig& rig, const Vector& full, const std::vector<bool>& down,
                   const std::vector<bool>& closed, std::mt19937_64& noise) {
  run::Sensed shown;
  shown.readings = readings_of(rig, full);
  shown.counts = Eigen::VectorXd::Zero(shown.readings.size());
  for (std::size_t s = 0; s < rig.sensors.size(); ++s) {
    const auto i = static_cast<Eigen::Index>(s);
    shown.readings[i] = counted(rig.sensors[s], shown.readings[i], noise);
    if (rig.sensors[s].resolution > 0.0) {
      shown.counts[i] = std::round(shown.readings[i] / rig.sensors[s].resolution);
    }
  }
  const auto feet = static_cast<Eigen::Index>(down.size());
  shown.feet.resize(feet);
  shown.switches.resize(feet);
  for (Eigen::Index i = 0; i < feet; ++i) {
    shown.feet[i] = down[static_cast<std::size_t>(i)] ? 1.0 : 0.0;
    shown.switches[i] = closed[static_cast<std::size_t>(i)] ? 1.0 : 0.0;
  }
  return shown;
}

}  // namespace

Recording hop(const Rig& rig, const run::LoadedScenario& loaded, const run::Start& start, int hops,
              std::mt19937_64 noise) {
  const Vector pose = pose_of(rig, start);
  run::WiredController controller(loaded.model, *loaded.controller);
  Recording recording{rig, {}, pose, controller.period(), {}};
  const Machine machine(rig, {}, pose);
  const auto most = static_cast<Eigen::Index>(kLongestHop * (hops + 1) / recording.period);
  const auto motors = static_cast<Eigen::Index>(rig.motors.size());
  Motion motion = machine.room_for(most);
  State x = machine.start_state(Vector::Zero(motors), coordinates_of(rig, start.velocities));
  Eigen::VectorXd command = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(loaded.model.motors.size()));
  Landings landings;
  int landed = 0;
  Eigen::Index k = 0;
  for (; k < most && landed <= hops; ++k) {
    machine.note(x, k, motion);
    const Vector full = motion.positions.col(k);
    const Vector full_rate = motion.rates.col(k);
    std::vector<bool> down;
    std::vector<bool> closed;
    for (const Ground& ground : rig.grounds) {
      down.push_back(depth_of(rig, ground, full) > 0.0);
      closed.push_back(is_closed(rig, ground, full, full_rate));
    }
    if (!full.allFinite() || controller.step(sensed(rig, full, down, closed, noise), command.data()) != 0) {
      throw std::runtime_error(full.allFinite() ? "the controller gave up: " + controller.fault_text()
                                                : "the foreign world's motion is not finite");
    }
    for (Eigen::Index m = 0; m < motors; ++m) {
      motion.commands(m, k) = command[loaded.model.motor_index(rig.motors[static_cast<std::size_t>(m)].name)];
    }
    landed += landings.look(static_cast<double>(k) * recording.period, down) ? 1 : 0;
    machine.advance(x, motion.commands, k, recording.period);
  }
  if (landed <= hops) {
    throw std::runtime_error("the foreign world's robot landed " + std::to_string(landed) + " times, not " +
                             std::to_string(hops + 1));
  }
  recording.motion = {motion.positions.leftCols(k), motion.rates.leftCols(k), motion.commands.leftCols(k),
                      motion.bristles.leftCols(k)};
  return recording;
}

validation::Experiment experiment_of(const Recording& recording, const std::string& title,
                                     validation::Role role) {
  validation::Experiment experiment;
  experiment.title = title;
  experiment.role = role;
  experiment.period = recording.period;
  const Eigen::Index samples = recording.motion.positions.cols();
  experiment.time =
      Eigen::VectorXd::LinSpaced(samples, 0.0, static_cast<double>(samples - 1)) * recording.period;
  experiment.duration = static_cast<double>(samples) * recording.period;
  return experiment;
}

}  // namespace plumbline::battery::worlds
