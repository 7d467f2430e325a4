// Numbers of a run by name: what measures are made of.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "simulator/run/sampled_run.h"
#include "simulator/run/scenario.h"

namespace plumbline::validation {

/// Channels by name, each one number at each sample:
///   q_SENSOR, F_PLATE     what a sensor would read without counts and noise
///   u_MOTOR               its command
///   x_NAME, v_NAME        position and velocity of a coordinate, motor or joint
///   F_FOOT_x, _y, _z      force of the ground on a foot
///   contact_FOOT          1 while the foot is in the ground
///   stretch_RATIO         how far a ratio is stretched, in the motor's coordinate
///   power_MOTOR           command times torque gain times the motor's velocity, W
///   a quantity of the scenario, or a value that the controller logs, by its name
class Channels {
 public:
  /// Throws InputError (`where`) for a name that there is not, with the nearest ones.
  Channels(const run::LoadedScenario& loaded, const std::vector<std::string>& names,
           const Place_in_file& where);

  const std::vector<std::string>& names() const { return names_; }
  std::size_t size() const { return names_.size(); }
  /// Index of a name that was asked for; -1: none.
  int index(const std::string& name) const;
  const std::string& unit(std::size_t channel) const { return units_[channel]; }  ///< SI

  /// All of them at the present sample.
  void read(run::SampledRun& sampled, double* row) const;

 private:
  using Reader = std::function<double(run::SampledRun&, const double* state)>;
  bool add(const run::LoadedScenario& loaded, const std::string& name);
  void push(const std::string& name, const std::string& unit, Reader reader);
  bool add_place(const model::Model& model, const std::string& name);
  bool add_foot(const model::Model& model, const std::string& name);
  bool add_motor(const model::Model& model, const std::string& name);

  std::vector<std::string> names_, units_;
  std::vector<Reader> readers_;
};

}  // namespace plumbline::validation
