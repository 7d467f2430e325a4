// A small picture of what an effect does, computed from its law.
#pragma once

#include <string>

#include "simulator/effects/law.h"

namespace plumbline::api {

/// SVG, 240 x 96. Of a force: over position and over velocity, along a sine of amplitude 1 and circular
/// frequency 1, under a torque that swings with it. Of an actuator: the torque over the command. Of a sensor:
/// the reading over the true value. Values: the law's first start and typical sizes for scales of 1, so that
/// what is drawn has the shape, not a size. Empty for a law that is no function of one motion (inertias, the
/// ground, delays).
std::string effect_picture(const effects::Law& law);

}  // namespace plumbline::api
