// Force plates: the vertical forces of the ground on the feet that stand on them.
#include <algorithm>

#include "simulator/model/plant.h"

namespace plumbline::model {

void Plant::plate_outputs(const double* x, double* y) {
  if (!model_.has_force_plate()) {
    return;
  }
  const std::vector<Touch> feet = touches(x);
  for (int s = 0; s < sensors(); ++s) {
    const Sensor& plate = model_.sensors[static_cast<std::size_t>(s)];
    if (!plate.is_force_plate()) {
      continue;
    }
    y[s] = 0.0;
    for (const int foot : plate.feet) {
      y[s] += feet[static_cast<std::size_t>(foot)].force.z();
    }
  }
}

}  // namespace plumbline::model
