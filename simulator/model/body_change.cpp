#include "simulator/model/body_change.h"

#include "simulator/trace/error.h"

namespace plumbline::model {
namespace {

/// Body and a point mass at r, given in the body's frame, become one rigid body (theorem of parallel axes).
void hang_on(Body& body, double mass, const Eigen::Vector3d& r) {
  if (mass == 0.0) {
    return;
  }
  const double total = body.mass + mass;
  const Eigen::Vector3d lever = r - body.com;
  body.inertia += body.mass * mass / total *
                  (lever.squaredNorm() * Eigen::Matrix3d::Identity() - lever * lever.transpose());
  body.com += mass / total * lever;
  body.mass = total;
}

/// The body's matter moves by a linear map about its centre of mass.
void stretch(Body& body, const Eigen::Matrix3d& map) {
  if (map.isIdentity(0.0)) {
    return;
  }
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d moments = 0.5 * body.inertia.trace() * identity - body.inertia;
  const Eigen::Matrix3d moved = map * moments * map.transpose();
  body.inertia = moved.trace() * identity - moved;
}

}  // namespace

void change_body(Body& body, const effects::StructureChange& change, const std::string& who) {
  const double mass = body.mass + change.mass;
  if (!(mass > 0.0)) {
    throw InputError(who + ": found a total mass of " + std::to_string(mass) + " kg, expected more than 0");
  }
  // A payload changes the inertia in proportion, as if the link's own material were denser.
  if (body.mass > 0.0) {
    body.inertia *= mass / body.mass;
  }
  body.mass = mass;
  body.com += change.com_shift;
  stretch(body, change.stretch);
  hang_on(body, change.payload, change.payload_at);
}

}  // namespace plumbline::model
