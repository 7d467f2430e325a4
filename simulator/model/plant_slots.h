// Where the effects of a model act: what a Plant knows of each, beside its law.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::model {

/// A law's states: no heap in a hot loop.
using FewStates = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 8, 1>;

/// A linear form of the full coordinates, seen from the independent ones.
struct LinearForm {
  struct Entry {
    int index;
    double value;
  };
  Eigen::VectorXd full;
  Eigen::VectorXd reduced;
  double offset = 0.0;
  std::vector<Entry> entries;  ///< of `reduced`, those that are not zero: few
};

struct ForceSlot {
  const effects::ForceLaw* law = nullptr;
  int effect = 0;
  int state = -1;         ///< index in x of its first hidden state
  int motor = -1;         ///< motor whose torque is the load
  int rod = -1;           ///< of PlantDynamics' rods: `line` is then that of the position evaluated last
  bool at_motor = false;  ///< acts on that motor itself, not on its gear
  bool active = true;     ///< false at null values: costs nothing
  LinearForm line;
};

struct ActuatorSlot {
  const effects::ActuatorLaw* law = nullptr;
  int effect = 0;
  int state = -1;
};

struct StructureSlot {
  const effects::StructureLaw* law = nullptr;
  int effect = 0;
};

struct SensorSlot {
  const effects::SensorLaw* law = nullptr;
  int effect = 0;
};

struct SwitchSlot {
  const effects::SwitchLaw* law = nullptr;
  int effect = 0;
};

}  // namespace plumbline::model
