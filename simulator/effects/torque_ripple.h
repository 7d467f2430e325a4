// Torque ripple: a motor's torque that pulses with its angle, in proportion to the torque itself.
#pragma once

#include <vector>

#include "simulator/effects/dissipative_law.h"

namespace plumbline::effects {

/// f = load (sine sin(N x) + cosine cos(N x)), N = cycles   [N m or N]
/// load: torque that the motor delivers; sine and cosine: shares of it [1]. One turn is 2 pi of the motor's
/// position. One wave for each use: a motor with several has the law several times. Of p pole pairs the back
/// EMF's fifth and seventh harmonics make N = 6 p, phases of unequal gain N = 2 p; slots make N = slots. What
/// does not grow with the torque is cogging: a motor without current has no ripple.
/// Null when sine = cosine = 0. The power comes from the supply and goes back to it.
/// Source: Jahns and Soong, IEEE Trans. Industrial Electronics 43(2) (1996), pages 321-330, section II.
class TorqueRipple final : public DissipativeLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
};

}  // namespace plumbline::effects
