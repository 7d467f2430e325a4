#include "contact/laws.h"

#include "contact/ground_change.h"
#include "contact/ground_coulomb.h"
#include "contact/ground_friction.h"
#include "contact/ground_normal.h"
#include "contact/ground_turning.h"

namespace plumbline::contact {

// A new law of the ground is one line here (and one file pair).
std::vector<std::shared_ptr<const effects::Law>> ground_laws() {
  return {std::make_shared<const GroundNormal>(),
          std::make_shared<const GroundFriction>(),
          std::make_shared<const GroundCoulomb>(),
          ground_stiffness_error(),
          ground_damping_error(),
          ground_friction_error(),
          ground_height_error(),
          rolling_friction(),
          spinning_friction()};
}

}  // namespace plumbline::contact
