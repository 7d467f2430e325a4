// How the ground under a foot differs from what the model says of it.
#pragma once

#include <memory>
#include <vector>

#include "contact/contact_law.h"

namespace plumbline::contact {

/// A law of the ground's errors: it brings no force of its own, it changes what the foot's other laws say.
/// At its null values it changes nothing.
class GroundChangeLaw : public effects::Law {
 public:
  virtual GroundChange change(const double* p) const = 0;
  effects::Values typical(const effects::Scales& scales) const override;
  std::vector<effects::Values> starts(const effects::Scales& scales) const override;
};

/// elastic force of the normal law times `scale`, [1].
std::shared_ptr<const effects::Law> ground_stiffness_error();
/// damping force of the normal law times `scale`, [1].
std::shared_ptr<const effects::Law> ground_damping_error();
/// force of the tangential law times `scale`, [1].
std::shared_ptr<const effects::Law> ground_friction_error();
/// depth + height, [m]: the ground is higher than the terrain says.
std::shared_ptr<const effects::Law> ground_height_error();

}  // namespace plumbline::contact
