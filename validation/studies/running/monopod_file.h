// The closed-form monopod's constants, out of a robot's model file.
#pragma once

#include <string>

#include "controllers/monopod/monopod.h"

namespace plumbline::validation {

/// What the parts of a robot are called that is a monopod as in controllers/monopod/monopod.h.
struct MonopodNames {
  std::string model;                     ///< the model's file
  std::string body, upper, lower;        ///< links: torso, thigh, shin
  std::string knee;                      ///< the joint between the two lower ones
  std::string angle_ratio, angle_motor;  ///< of the leg's angle
  std::string shape_ratio, shape_motor,
      spring_pulley;  ///< of the leg's shape; the pulley that the spring holds
};

struct MonopodModel {
  MonopodNames names;
  monopod::Constants constants;
};

/// `plumbline: monopod/1`: names its model and the parts above. Reads the model, too. Of its effects the
/// spring, the preload and the viscous friction at the pulley and at the motors count; stops, cables and the
/// ground have no place in the closed form. Throws InputError (one line: file, line, key, found, expected),
/// also where the model has no such part.
MonopodModel read_monopod(const std::string& path);

}  // namespace plumbline::validation
