#include "contact/ground_turning.h"

#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::contact {
namespace {

using Eigen::Vector3d;

enum Index : std::size_t { kArm, kFadeSpeed };

constexpr double kStandardSpeed = 0.1;  // rad/s

class RollingFriction final : public TurningLaw {
 public:
  const effects::Declaration& declaration() const override {
    static const effects::Declaration kDeclaration{
        "rolling_friction",
        "a moment of the ground against a foot that rolls",
        "moment_x = -normal*arm*tanh(w/roll_speed)/w*w_x; moment_y = -normal*arm*tanh(w/roll_speed)/w*w_y; "
        "w = sqrt(w_x^2 + w_y^2)",
        "Johnson, Contact Mechanics, 1985, section 9.1",
        {effects::Place::foot},
        {effects::non_negative("arm", "m", "by how far the normal force acts ahead of the foot's centre"),
         effects::fixed("roll_speed", "rad/s", "turn below which the moment fades", kStandardSpeed, 1e-6,
                        1e3)},
        {},
        ""};
    return kDeclaration;
  }
  Vector3d moment(const Vector3d& turn, double normal, const double* p) const override {
    constexpr double kStill = 1e-8;  // below it tanh(x) / x is 1 to rounding
    const Vector3d along(turn.x(), turn.y(), 0.0);
    const double x = along.norm() / p[kFadeSpeed];
    return -normal * p[kArm] / p[kFadeSpeed] * (x > kStill ? std::tanh(x) / x : 1.0) * along;
  }
};

class SpinningFriction final : public TurningLaw {
 public:
  const effects::Declaration& declaration() const override {
    static const effects::Declaration kDeclaration{
        "spinning_friction",
        "a moment of the ground against a foot that spins about its normal",
        "moment_z = -normal*radius*tanh(w_z/spin_speed)",
        "Johnson, Contact Mechanics, 1985, section 7.4",
        {effects::Place::foot},
        {effects::non_negative("radius", "m", "moment over normal force of a foot that spins"),
         effects::fixed("spin_speed", "rad/s", "turn below which the moment fades", kStandardSpeed, 1e-6,
                        1e3)},
        {},
        ""};
    return kDeclaration;
  }
  Vector3d moment(const Vector3d& turn, double normal, const double* p) const override {
    return {0.0, 0.0, -normal * p[kArm] * std::tanh(turn.z() / p[kFadeSpeed])};
  }
};

}  // namespace

effects::Values TurningLaw::typical(const effects::Scales& scales) const {
  return {effects::guarded(scales).position, kStandardSpeed};
}

// Linear in the arm.
std::vector<effects::Values> TurningLaw::starts(const effects::Scales& /*scales*/) const {
  return {null_values()};
}

std::shared_ptr<const TurningLaw> rolling_friction() { return std::make_shared<const RollingFriction>(); }

std::shared_ptr<const TurningLaw> spinning_friction() { return std::make_shared<const SpinningFriction>(); }

}  // namespace plumbline::contact
