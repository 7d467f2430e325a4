#include "validation/studies/spring_mass/spring_mass.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plumbline::spring_mass {
namespace {

Eigen::Vector3d acceleration(const Body& body, const Eigen::Vector3d& leg) {
  const double pull = body.stiffness / body.mass * (body.rest_length / leg.norm() - 1.0);
  return pull * leg - Eigen::Vector3d(0.0, 0.0, body.gravity);
}

Moment advanced(const Body& body, const Moment& from, double h) {
  const Eigen::Vector3d a1 = acceleration(body, from.position);
  const Eigen::Vector3d v2 = from.velocity + 0.5 * h * a1;
  const Eigen::Vector3d a2 = acceleration(body, from.position + 0.5 * h * from.velocity);
  const Eigen::Vector3d v3 = from.velocity + 0.5 * h * a2;
  const Eigen::Vector3d a3 = acceleration(body, from.position + 0.5 * h * v2);
  const Eigen::Vector3d v4 = from.velocity + h * a3;
  const Eigen::Vector3d a4 = acceleration(body, from.position + h * v3);
  return {from.position + h / 6.0 * (from.velocity + 2.0 * v2 + 2.0 * v3 + v4),
          from.velocity + h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4)};
}

/// The part of the step `h` after which the leg is at its rest length; it is shorter at the beginning.
double time_of_release(const Body& body, const Moment& from, double h) {
  double low = 0.0, high = h;
  double excess_low = from.position.norm() - body.rest_length;
  double excess_high = advanced(body, from, h).position.norm() - body.rest_length;
  for (int i = 0; i < 60 && high - low > 1e-15; ++i) {
    double middle = low + (high - low) * excess_low / (excess_low - excess_high);
    middle = i % 3 == 2 ? 0.5 * (low + high) : middle;  // against a secant that stays on one side
    const double excess = advanced(body, from, middle).position.norm() - body.rest_length;
    if (std::abs(excess) < 1e-13) {
      return middle;
    }
    (excess < 0.0 ? low : high) = middle;
    (excess < 0.0 ? excess_low : excess_high) = excess;
  }
  return high;
}

double slope_of(const Eigen::Vector3d& leg) { return std::hypot(leg.x(), leg.y()) / leg.z(); }

}  // namespace

std::string to_string(Ending ending) {
  switch (ending) {
    case Ending::apex:
      return "apex";
    case Ending::stumbled:
      return "stumbled";
    case Ending::fell:
      return "fell";
    case Ending::no_flight:
      break;
  }
  return "no flight";
}

Stance stance(const Body& body, const Moment& touchdown,
              const std::function<void(double, const Moment&)>& seen) {
  Stance result;
  const double h = 2.0 * pi * std::sqrt(body.mass / body.stiffness) / 1000.0;
  Moment now = touchdown;
  result.friction = slope_of(now.position);
  for (int i = 0; i < 20000; ++i) {
    if (seen) {
      seen(result.duration, now);
    }
    const Moment next = advanced(body, now, h);
    if (next.position.z() <= 0.0) {
      result.ending = Ending::fell;
      return result;
    }
    if (next.position.norm() >= body.rest_length && next.position.dot(next.velocity) > 0.0) {
      const double last = time_of_release(body, now, h);
      result.takeoff = advanced(body, now, last);
      result.duration += last;
      result.friction = std::max(result.friction, slope_of(result.takeoff.position));
      result.ending = result.takeoff.velocity.z() > 0.0 ? Ending::apex : Ending::no_flight;
      if (seen) {
        seen(result.duration, result.takeoff);
      }
      return result;
    }
    now = next;
    result.duration += h;
    result.friction = std::max(result.friction, slope_of(now.position));
  }
  return result;  // it turns about the foot for ever: it has fallen
}

double apex_speed(const Body& body, double apex) {
  return std::sqrt(std::max(0.0, 2.0 * body.energy / body.mass - 2.0 * body.gravity * apex));
}

Step step(const Body& body, double apex, const LegAngles& leg) {
  if (!(apex <= body.energy / (body.mass * body.gravity) * (1.0 + 1e-12))) {
    throw std::invalid_argument("spring-mass step: the apex is higher than the energy allows");
  }
  Step result;
  const double fall = apex - body.rest_length * std::sin(leg.attack);
  if (fall < -1e-12) {
    result.ending = Ending::stumbled;
    return result;
  }
  result.fall = std::sqrt(2.0 * std::max(0.0, fall) / body.gravity);
  const double across = body.rest_length * std::cos(leg.attack);
  result.touchdown = {
      {-across * std::cos(leg.splay), -across * std::sin(leg.splay), body.rest_length * std::sin(leg.attack)},
      {apex_speed(body, apex), 0.0, -body.gravity * result.fall}};
  const Stance stood = stance(body, result.touchdown);
  result.ending = stood.ending;
  result.stance = stood.duration;
  result.friction = stood.friction;
  result.takeoff = stood.takeoff;
  if (stood.ending != Ending::apex) {
    return result;
  }
  const Moment& off = stood.takeoff;
  result.rise = off.velocity.z() / body.gravity;
  result.apex = off.position.z() + 0.5 * off.velocity.z() * result.rise;
  result.deflection = std::atan2(off.velocity.y(), off.velocity.x());
  return result;
}

}  // namespace plumbline::spring_mass
