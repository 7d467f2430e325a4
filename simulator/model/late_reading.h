// By how much the laws of a sensor are late, over the plant's own slots.
#pragma once

#include "simulator/effects/late_sensor_law.h"

namespace plumbline::model {

/// Sum of their lags, s. `values` gives a slot's parameters.
template <typename Slots, typename Values>
double lag_of(const Slots& slots, const Values& values) {
  double lag = 0.0;
  for (const auto& slot : slots) {
    if (const auto* late = dynamic_cast<const effects::LateSensorLaw*>(slot.law)) {
      lag += late->lag(values(slot));
    }
  }
  return lag;
}

}  // namespace plumbline::model
