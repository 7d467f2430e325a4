// Laws that are members of one family: which of them it is may stay open where the family is sure.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>

#include "simulator/model/model.h"

namespace plumbline::validation {

/// Which coordinates and motors of a model move together: a motor and the coordinate that it turns through a
/// rigid ratio are one place.
class TiedPlaces {
 public:
  explicit TiedPlaces(const model::Model& model);
  bool are_one(const std::string& a, const std::string& b) const;

 private:
  std::map<std::string, Eigen::VectorXd> directions_;  // unit vector of its velocity by the independent ones
};

/// Are both at one place, and of one family: friction, springs and stops, what a command becomes on its way
/// to the torque, what a sensor adds, or what the ground is like?
bool are_of_one_family(const model::EffectUse& one, const model::EffectUse& other, const TiedPlaces& places);

/// Of one family wherever they are; a law that is in none is of its own.
bool are_of_one_family(const effects::Law& one, const effects::Law& other);

bool is_friction(const effects::Law& law);

/// Does the law of this name change a body as something that hangs there does?
bool may_be_payload(const std::string& law);

}  // namespace plumbline::validation
