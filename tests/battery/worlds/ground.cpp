// Normal force at depth d > 0 and speed v of going in:
//   N = d^n max(0, k + a v + b sgn(v) (sqrt(|v| + r) - sqrt(r))),
// r the stated rounding of the root. Along the ground, at slip u with bristles bent by s:
//   F = -N (s0 s + s1 ds/dt + s2 u), ds/dt = u - s0 |u| s/mu.
// Of a foot in the air the bristles straighten, ds/dt = -s/relaxation.
#include "tests/battery/worlds/ground.h"

#include <algorithm>
#include <cmath>

namespace plumbline::battery::worlds {
namespace {

FootMotion foot_of(const Rig& rig, const Ground& ground, const Vector& full, const Vector& full_rate) {
  if (ground.foot != nullptr) {
    return ground.foot(rig, ground, full, full_rate);
  }
  FootMotion motion;
  motion.up = ground.row;
  motion.height = ground.constant + ground.row.dot(full.head(rig.coordinates));
  motion.height_rate = ground.row.dot(full_rate.head(rig.coordinates));
  return motion;
}

double normal_force(const Ground& ground, double deep, double in) {
  if (deep <= 0.0) {
    return 0.0;
  }
  const double root = std::sqrt(std::abs(in) + ground.rounding) - std::sqrt(ground.rounding);
  return std::pow(deep, ground.exponent) * std::max(0.0, ground.stiffness + ground.damping * in +
                                                             ground.root_damping * std::copysign(root, in));
}

}  // namespace

double depth_of(const Rig& rig, const Ground& ground, const Vector& full) {
  return ground.height - foot_of(rig, ground, full, Vector::Zero(full.size())).height;
}

double ground_force_of(const Rig& rig, const Ground& ground, const Vector& full, const Vector& full_rate) {
  const FootMotion foot = foot_of(rig, ground, full, full_rate);
  return normal_force(ground, ground.height - foot.height, -foot.height_rate);
}

bool is_closed(const Rig& rig, const Ground& ground, const Vector& full, const Vector& full_rate) {
  return rig.switch_force > 0.0 ? ground_force_of(rig, ground, full, full_rate) > rig.switch_force
                                : depth_of(rig, ground, full) > 0.0;
}

bool has_bristles(const Ground& ground) { return ground.friction > 0.0; }

void press(const Rig& rig, const Ground& ground, const Vector& full, const Vector& full_rate, double bristle,
           Vector& forces, double& bristle_rate) {
  const FootMotion foot = foot_of(rig, ground, full, full_rate);
  const double normal = normal_force(ground, ground.height - foot.height, -foot.height_rate);
  if (has_bristles(ground)) {
    bristle_rate = -bristle / ground.relaxation;
  }
  if (normal <= 0.0) {
    return;
  }
  forces.head(rig.coordinates) += normal * foot.up;
  if (has_bristles(ground)) {
    const double slip = foot.x_rate;
    bristle_rate = slip - ground.bristle_stiffness * std::abs(slip) * bristle / ground.friction;
    const double drag =
        ground.bristle_stiffness * bristle + ground.bristle_damping * bristle_rate + ground.viscous * slip;
    forces.head(rig.coordinates) -= normal * drag * foot.along;
  }
}

}  // namespace plumbline::battery::worlds
