// The part of a certificate that the driver reads.
#pragma once

#include "controllers/driver/json.h"
#include "controllers/driver/plan.h"
#include "validation/control/certify/lasting.h"

namespace plumbline::validation {

/// Limits on rates, rests and changes of commands: what was largest, times so much, rounded up to two digits
/// so that they are numbers for people. A channel that never moved gets none.
void take_limits(driver::Plan& plan, const Extremes& largest, double speed_times, double rest_times,
                 double slew_times);

/// "drive" and "controller" of the body; plan_from() reads them back.
driver::Json drive_json(const driver::Plan& plan);
driver::Json controller_json(const driver::Plan& plan);

}  // namespace plumbline::validation
