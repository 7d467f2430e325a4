// A force that stores nothing: all the power it takes is lost.
#pragma once

#include "simulator/effects/law.h"

namespace plumbline::effects {

class DissipativeLaw : public ForceLaw {
 public:
  /// -force * velocity, W.
  double dissipated_power(const Motion& m, const double* state, const double* p) const final {
    return -force(m, state, p) * m.velocity;
  }
};

}  // namespace plumbline::effects
