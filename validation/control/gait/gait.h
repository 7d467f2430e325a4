// From contact to steps, hops and strides of any robot.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulator/model/model.h"
#include "simulator/model/plant.h"
#include "simulator/run/scenario.h"

namespace plumbline::validation {

/// What repeats in a gait, and what of it is looked at.
struct Gait {
  enum class Cycle {
    hop,     ///< from one landing of all feet, behind a flight of all, to the next
    step,    ///< from one foot's touchdown to the next touchdown of any foot
    stride,  ///< from a foot's touchdown to its next one
  };
  Cycle cycle = Cycle::stride;
  std::vector<int> feet;   ///< indices in the model; of a stride: its foot is the first
  double shortest = 0.02;  ///< s; a foot that is up for less has bounced, and has not lifted off
  long settle = 5;         ///< cycles behind the start that are no measurement of the gait
  long before_fall = 3;    ///< and before a fall
};

/// The scenario's section `gait`; nothing where it has none. Throws InputError.
std::optional<Gait> read_gait(const run::LoadedScenario& loaded);

/// "hop", "step" or "stride".
std::string to_string(Gait::Cycle cycle);

/// Looks at the feet sample by sample. A foot has touched down when it is in the ground and was up for at
/// least `shortest` before; it has lifted off at the last sample before that.
class CycleFinder {
 public:
  CycleFinder(const Gait& gait, std::size_t feet);

  /// True when a cycle ends, and the next begins, at this sample.
  bool look(double t, const std::vector<model::Touch>& touches);
  /// When each foot of the gait came down last, s.
  const std::vector<double>& touchdowns() const { return since_; }
  /// Which foot (index in Gait::feet) touched down last: the one that ended a cycle, and begins the next.
  int foot() const { return foot_; }

 private:
  Gait gait_;
  std::vector<bool> down_;
  std::vector<double> since_, up_since_;
  int foot_ = -1;
  double flight_since_ = 0.0;  // all feet up since then
  bool in_flight_ = true;
  bool flown_ = true;  // long enough, since the last landing
};

}  // namespace plumbline::validation
