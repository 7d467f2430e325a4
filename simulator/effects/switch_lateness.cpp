#include "simulator/effects/switch_lateness.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kCloses, kOpens };

}  // namespace

const Declaration& SwitchLateness::declaration() const {
  static const Declaration kDeclaration{
      "switch_lateness",
      "a contact switch that closes or opens later, or earlier, than its foot meets and leaves the ground",
      "closing = touchdown + closes_late; opening = lift_off + opens_late",
      "Hausdorff, Ladin and Wei, Footswitch system for measurement of the temporal parameters of gait, "
      "J. Biomechanics 28, 1995",
      {Place::contact_switch},
      {any("closes_late", "s", "from the touchdown to the closing"),
       any("opens_late", "s", "from the lift-off to the opening")},
      {},
      ""};
  return kDeclaration;
}

Values SwitchLateness::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.period, s.period};
}

std::vector<Values> SwitchLateness::starts(const Scales& /*scales*/) const { return {null_values()}; }

double SwitchLateness::lateness(bool closes, const double* p) const { return p[closes ? kCloses : kOpens]; }

}  // namespace plumbline::effects
