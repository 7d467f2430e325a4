#include "contact/shapes.h"

#include <algorithm>
#include <cmath>

namespace plumbline::contact {
namespace {

using Eigen::Vector3d;

/// Two points that are nearest to each other.
struct Nearest {
  Vector3d one, other;
};

double share(double value) { return std::clamp(value, 0.0, 1.0); }

/// Of two parallel segments: in the middle of what they share, or their nearest ends.
Nearest nearest_of_parallel(const Round& one, const Round& other) {
  const Vector3d along = one.to - one.from;
  const double squared = along.squaredNorm();
  const double at_from = along.dot(other.from - one.from) / squared;
  const double at_to = along.dot(other.to - one.from) / squared;
  const double begin = share(std::min(at_from, at_to));
  const double end = share(std::max(at_from, at_to));
  const Vector3d here = one.from + 0.5 * (begin + end) * along;
  const Vector3d way = other.to - other.from;
  return {here, other.from + share(way.dot(here - other.from) / way.squaredNorm()) * way};
}

/// Of two segments, each of which may be a point (Ericson, 5.1.9).
Nearest nearest_of(const Round& one, const Round& other) {
  constexpr double kParallel = 1e-14;  // square of the sine of the angle between them
  const Vector3d d1 = one.to - one.from;
  const Vector3d d2 = other.to - other.from;
  const Vector3d r = one.from - other.from;
  const double a = d1.squaredNorm();
  const double e = d2.squaredNorm();
  const double f = d2.dot(r);
  if (a == 0.0) {
    return {one.from, other.from + (e > 0.0 ? share(f / e) : 0.0) * d2};
  }
  const double c = d1.dot(r);
  if (e == 0.0) {
    return {one.from + share(-c / a) * d1, other.from};
  }
  const double b = d1.dot(d2);
  const double across = a * e - b * b;
  if (across <= kParallel * a * e) {
    return nearest_of_parallel(one, other);
  }
  double s = share((b * f - c * e) / across);
  const double t = (b * s + f) / e;
  if (t < 0.0 || t > 1.0) {
    s = share(((t < 0.0 ? 0.0 : b) - c) / a);
  }
  return {one.from + s * d1, other.from + share(t) * d2};
}

/// Of a ball about c whose nearest surface point s of the other shape is known.
Meeting beside(const Vector3d& s, const Vector3d& normal, double distance, double radius) {
  Meeting met;
  met.normal = normal;
  met.depth = radius - distance;
  met.point = s - 0.5 * met.depth * normal;
  return met;
}

Meeting meet_round(const Round& first, const Round& second) {
  const Nearest nearest = nearest_of(first, second);
  const Vector3d apart = nearest.one - nearest.other;
  const double distance = apart.norm();
  const Vector3d normal = distance > 0.0 ? Vector3d(apart / distance) : Vector3d::UnitZ();
  return beside(nearest.other + second.radius * normal, normal, distance - second.radius, first.radius);
}

/// Inside the box: out of the face that is nearest.
Meeting meet_from_inside(const Vector3d& c, const Box& box, double radius) {
  Eigen::Index axis = 0;
  const double distance = (box.half - c.cwiseAbs()).minCoeff(&axis);
  Vector3d normal = Vector3d::Zero();
  normal[axis] = c[axis] < 0.0 ? -1.0 : 1.0;
  return beside(c + distance * normal, normal, -distance, radius);
}

Meeting meet_box(const Round& ball, const Box& box) {
  const Vector3d c = box.pose.inverse(Eigen::Isometry) * ball.from;
  const Vector3d s = c.cwiseMax(-box.half).cwiseMin(box.half);
  const double distance = (c - s).norm();
  Meeting met = distance > 0.0 ? beside(s, (c - s) / distance, distance, ball.radius)
                               : meet_from_inside(c, box, ball.radius);
  met.point = box.pose * met.point;
  met.normal = box.pose.linear() * met.normal;
  return met;
}

Meeting meet_plane(const Round& ball, const Plane& plane) {
  const double distance = plane.normal.dot(ball.from - plane.point);
  return beside(ball.from - distance * plane.normal, plane.normal, distance, ball.radius);
}

std::vector<Round> corners_of(const Box& box) {
  std::vector<Round> corners;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d side((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0,
                        (corner & 4) != 0 ? 1.0 : -1.0);
    const Vector3d at = box.pose * side.cwiseProduct(box.half);
    corners.push_back({at, at, 0.0});
  }
  return corners;
}

}  // namespace

std::string name_of(const Shape& shape) {
  if (const auto* round = std::get_if<Round>(&shape)) {
    return !round->is_ball() ? "capsule" : round->radius > 0.0 ? "sphere" : "point";
  }
  return std::holds_alternative<Box>(shape) ? "box" : "plane";
}

Meeting meet(const Round& first, const Shape& second) {
  if (const auto* round = std::get_if<Round>(&second)) {
    return meet_round(first, *round);
  }
  if (const auto* box = std::get_if<Box>(&second)) {
    return meet_box(first, *box);
  }
  return meet_plane(first, std::get<Plane>(second));
}

std::vector<Round> parts_that_meet(const Shape& one, const Shape& other) {
  const bool on_plane = std::holds_alternative<Plane>(other);
  if (const auto* round = std::get_if<Round>(&one)) {
    const auto* beside_it = std::get_if<Round>(&other);
    if (beside_it != nullptr ? round->radius + beside_it->radius > 0.0 : round->is_ball()) {
      return {*round};
    }
    if (on_plane) {
      return {{round->from, round->from, round->radius}, {round->to, round->to, round->radius}};
    }
    return {};
  }
  const auto* box = std::get_if<Box>(&one);
  return box != nullptr && on_plane ? corners_of(*box) : std::vector<Round>{};
}

Round moved(const Eigen::Isometry3d& pose, const Round& round) {
  const Vector3d from = pose * round.from;
  return {from, round.is_ball() ? from : Vector3d(pose * round.to), round.radius};
}

}  // namespace plumbline::contact
