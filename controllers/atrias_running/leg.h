// The five-bar leg: where the foot is, which spring torques make a ground force, within what the ground can
// give. Wu (2017), sections 4.3.4 and 5.4.2. Angles from straight down, positive forward, links of equal
// length.
#pragma once

#include <algorithm>
#include <cmath>

namespace plumbline::controllers::atrias {

/// Two numbers in the plane: forward and up, or of the thigh and of the shin.
struct Pair {
  double first = 0.0, second = 0.0;
};

/// The foot relative to the hip for the links' absolute angles: length*(sin a + sin b, -cos a - cos b).
inline Pair foot_of(double length, const Pair& angles) {
  return {length * (std::sin(angles.first) + std::sin(angles.second)),
          -length * (std::cos(angles.first) + std::cos(angles.second))};
}

/// The links' angles for a foot, thigh in front; a foot out of reach is brought to the straight leg's circle.
inline Pair angles_of(double length, const Pair& foot) {
  const double way = std::hypot(foot.first, foot.second);
  const double half = std::acos(std::clamp(way / (2.0 * length), 0.0, 1.0));
  const double direction = std::atan2(foot.first, -foot.second);
  return {direction + half, direction - half};
}

/// What the ground gives at most: no pull, and the cone of friction (section 5.4.2).
inline Pair within_contact(const Pair& force, double friction) {
  const double up = std::max(0.0, force.second);
  return {std::clamp(force.first, -friction * up, friction * up), up};
}

/// Torques on thigh and shin (trunk on link, N m, positive forward) with which a massless leg presses on the
/// ground so that the ground gives `force` to the robot: -J' force.
inline Pair torques_for(double length, const Pair& angles, const Pair& force) {
  const auto torque = [&](double angle) {
    return -length * (std::cos(angle) * force.first + std::sin(angle) * force.second);
  };
  return {torque(angles.first), torque(angles.second)};
}

/// The ground force that these torques mean: the inverse of torques_for. Near the straight leg it is not
/// defined; then zero.
inline Pair force_from(double length, const Pair& angles, const Pair& torques) {
  const double determinant = length * std::sin(angles.second - angles.first);
  if (std::abs(determinant) < 1e-6) {
    return {};
  }
  return {-(torques.first * std::sin(angles.second) - torques.second * std::sin(angles.first)) / determinant,
          -(torques.second * std::cos(angles.first) - torques.first * std::cos(angles.second)) / determinant};
}

/// Contact from the force that the springs show (section 5.6.2): touchdown above half the weight, lift-off
/// below it once the centre of mass moves up.
class ContactDetection {
 public:
  explicit ContactDetection(double threshold) : threshold_(threshold) {}
  bool update(double force_up, double rate_up) {
    stands_ = stands_ ? !(force_up < threshold_ && rate_up > 0.0) : force_up > threshold_;
    return stands_;
  }
  bool stands() const { return stands_; }

 private:
  double threshold_;  // N
  bool stands_ = false;
};

}  // namespace plumbline::controllers::atrias
