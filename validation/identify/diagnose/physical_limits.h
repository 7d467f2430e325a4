// What the constants of a physical robot can be, whatever a fit would like.
#pragma once

#include "validation/identify/predict/windows.h"

namespace plumbline::validation {

/// Narrows the bounds of one parameter of an effect that changes the robot's constants, and marks it as one
/// whose bounds are physical:
///   com_shift: the centre of mass stays in model::link_box();
///   link_inertia: its matter is stretched e times at most;
///   payload: it hangs no farther outside model::link_box() than the robot's largest link is long (the
///   diagonal of its
///     box), since a hand, a tool or a weight is no longer than a link;
///   added_mass, rotor_inertia, torque_constant_error: a tenth of what is stated is always there.
/// The value that stands in `use` stays allowed. Other parameters are left as they are.
void keep_physical(const model::Model& model, const model::EffectUse& use, FreeParameter& parameter);

/// The same by what the robot feels there, over the motion. resonator: what rides on a link has no more
/// inertia than all that moves with it; it is a part of that.
void keep_physical(const effects::Scales& motion, const model::EffectUse& use, FreeParameter& parameter);

}  // namespace plumbline::validation
