#include "simulator/effects/clock_drift.h"

#include <algorithm>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum ClockIndex : std::size_t { kClockOffset, kClockDrift };

constexpr double kFastest = 0.1;  // s/s: no clock is worse

}  // namespace

const Declaration& ClockDrift::declaration() const {
  static const Declaration kDeclaration{
      "clock_drift",
      "a clock of the recorded commands that is not that of the measurements",
      "torque(t) = u(t - offset - drift*(t - t0))",
      "Olson, A passive solution to the sensor synchronization problem, IROS 2010, section II; Lamport, "
      "Communications of the ACM 21(7), 1978, condition PC1",
      {Place::motor},
      {any("offset", "s", "by which commands take effect late where the record begins; negative: early"),
       Parameter{"drift", "s/s", "by which that grows with time", 0.0, -kFastest, kFastest, Scale::linear,
                 false}},
      {},
      ""};
  return kDeclaration;
}

// As much as a command_delay in ten seconds.
Values ClockDrift::typical(const Scales& scales) const {
  constexpr double kRecord = 10.0;  // s
  const Scales s = guarded(scales);
  const double late = s.position / s.velocity;
  return {late, std::min(late / kRecord, kFastest)};
}

std::vector<Values> ClockDrift::starts(const Scales& /*scales*/) const { return {null_values()}; }

ClockError ClockDrift::clock(const double* p) const { return {p[kClockOffset], p[kClockDrift]}; }

}  // namespace plumbline::effects
