// A controller's library on a robot's sensors and motors.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "simulator/run/controller_setup.h"
#include "simulator/run/sensors.h"

namespace plumbline::run {

/// One controller at work on a model. After construction step() does not allocate.
class WiredController {
 public:
  /// Throws InputError (one line) when the model has none of the sensors, switches, feet or motors that the
  /// setup names, a sensor whose counts are asked for has no resolution, units do not fit, or the controller
  /// refuses its constants.
  WiredController(const model::Model& model, const ControllerSetup& setup);

  /// As just made.
  void reset();
  /// One sample; commands of the wired motors are written. Returns the controller's fault, 0: none.
  int step(const Sensed& sensed, double* command);

  int fault() const { return fault_; }  ///< as of the last step
  std::string fault_text() const { return instance_.fault(fault_); }
  const std::vector<double>& log() const {
    return log_;
  }  ///< as of the last step, in the order of the library
  std::vector<double> memory() const { return instance_.memory(); }
  void set_memory(const std::vector<double>& memory) { instance_.set_memory(memory); }
  const controllers::LoadedController& library() const { return instance_.library(); }
  double period() const { return period_; }
  /// Index of a logged value or a memory by name, -1: none.
  int log_index(const std::string& name) const;
  int memory_index(const std::string& name) const;
  /// Motor (index in the model) and largest command of each output.
  const std::vector<int>& motors() const { return motors_; }

 private:
  /// Where an input's number comes from.
  struct Source {
    enum class Kind { count, reading, contact_switch, foot, fixed } kind = Kind::fixed;
    Eigen::Index index = 0;
    double factor = 1.0;  // of a reading; or the fixed value
  };
  Source find_source(const model::Model& model, const ControllerSetup& setup, std::size_t port,
                     double& scale) const;
  static controllers::ControllerInstance make(const ControllerSetup& setup,
                                              const std::vector<double>& scales);

  double period_;
  std::vector<Source> sources_;
  std::vector<double> scales_;
  std::vector<int> motors_;
  controllers::ControllerInstance instance_;
  std::vector<double> inputs_, outputs_, log_;
  int fault_ = 0;
};

}  // namespace plumbline::run
