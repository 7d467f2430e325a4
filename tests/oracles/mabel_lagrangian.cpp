#include "tests/oracles/mabel_lagrangian.h"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <vector>

namespace plumbline::oracles {
namespace {

constexpr double kGravity = 9.80665;

/// A function of the coordinates with its first and second derivatives.
struct Jet {
  double value = 0.0;
  MabelVector gradient = MabelVector::Zero();
  MabelMatrix hessian = MabelMatrix::Zero();
};

Jet operator+(const Jet& a, const Jet& b) {
  return {a.value + b.value, a.gradient + b.gradient, a.hessian + b.hessian};
}
Jet operator*(double k, const Jet& a) { return {k * a.value, k * a.gradient, k * a.hessian}; }
/// f(a) from f, f' and f'' at a.
Jet chain(const Jet& a, double f, double f1, double f2) {
  return {f, f1 * a.gradient, f1 * a.hessian + f2 * a.gradient * a.gradient.transpose()};
}
Jet sin(const Jet& a) { return chain(a, std::sin(a.value), std::cos(a.value), -std::sin(a.value)); }
Jet cos(const Jet& a) { return chain(a, std::cos(a.value), -std::sin(a.value), -std::cos(a.value)); }

Jet coordinate(const MabelVector& q, int i) {
  Jet jet;
  jet.value = q[i];
  jet.gradient[i] = 1.0;
  return jet;
}

struct Point {
  Jet x, z;
};

/// From `origin` by (across, along) in a frame that is turned counter-clockwise (x to the right, z up).
Point offset(const Point& origin, const Jet& angle, double across, double along) {
  return {origin.x + across * cos(angle) + (-along) * sin(angle),
          origin.z + across * sin(angle) + along * cos(angle)};
}

struct Link {
  Point centre;
  Jet angle;
  double mass = 0.0;
  double inertia = 0.0;  // about the centre of mass
};

/// Table VI: mass, r_x, r_y, inertia about the joint.
struct LinkData {
  double mass, across, along, inertia;
};
constexpr LinkData kTorsoLink{40.8953, 0.01229, 0.18337, 2.3727};
constexpr LinkData kCSpring{1.8987, 0.0009406, 0.1181, 0.04377};
constexpr LinkData kCShin{1.6987, 0.0004345, 0.08684, 0.03223};
constexpr LinkData kThigh{3.2818, 0.0003110, 0.1978, 0.1986};
constexpr LinkData kShin{1.5007, 0.0009671, 0.1570, 0.08813};
constexpr double kThighLength = 0.5;
constexpr double kCSpringPivot = 0.2;  // above the hip: assumed in robots/mabel

// The boom, Table VI.
constexpr double kBoomMass = 7.2575, kBoomCom = 1.48494153, kBoomInertia = 20.4951, kBoomLength = 2.25;

// Equations 6 and 7.
constexpr double kRatioAngle = -23.53, kRatioShape = 31.42, kRatioSpring = 5.18;

constexpr double kSpringPulley = 1.8686e-3;  // Table III, J_Bsp

// Table VIII and equation 28; K_vd1 is 1000 (report of 16 March 2010, Table VI).
constexpr double kSpringDamping = 1.5, kStopCubic = 100.0, kStopDamping = 1000.0, kStopRoot = 50.0;
// Only robots/mabel has it: where the root of the stop is rounded off.
constexpr double kStopRounding = 1e-4;

struct LegData {
  int leg_angle, leg_shape, motor_angle, motor_shape, spring;
  double angle_inertia, shape_inertia;      // rotor and pulleys: Table IV (third combination) over Table V
  double angle_friction, shape_friction;    // Table VII
  double angle_stiffness, shape_stiffness;  // Table VIII
  double angle_cable_damping, shape_cable_damping;  // Table VIII
  double spring_stiffness, preload;                 // Figure 17
};
const std::array<LegData, 2> kLegs{
    LegData{kLegAngleLeft, kLegShapeLeft, kMotorAngleLeft, kMotorShapeLeft, kSpringLeft, 7.436e-4 / 1.332,
            1.112e-3 / 0.995, 4.316e-3, 9.844e-3, 3.5000, 2.9565, 0.0889, 0.0402, 115.1, 2.214},
    LegData{kLegAngleRight, kLegShapeRight, kMotorAngleRight, kMotorShapeRight, kSpringRight,
            7.328e-4 / 1.269, 1.431e-3 / 1.287, 4.615e-3, 9.027e-3, 3.8094, 2.9565, 0.3556, 0.0804, 111.7,
            5.377}};

/// A link that hangs from its pivot: Table VI measures r_y along it from the joint, at 180 deg in the paper.
Link hanging(const LinkData& data, const Point& pivot, const Jet& angle) {
  return {offset(pivot, angle, -data.across, -data.along), angle, data.mass,
          data.inertia - data.mass * (data.across * data.across + data.along * data.along)};
}

/// A motor with its pulleys, or B_Spring: their mass is the torso's, only their turning counts here.
Link spinning(double inertia, const Jet& angle) { return {{}, angle, 0.0, inertia}; }

std::vector<Link> links(const MabelOptions& options, const MabelVector& q) {
  const Point hip{coordinate(q, kHipX), coordinate(q, kHipZ)};
  const Jet torso = coordinate(q, kTorso);
  const Jet mount = options.rotor_spin ? torso : Jet{};
  std::vector<Link> all;
  all.push_back({offset(hip, torso, kTorsoLink.across, kTorsoLink.along), torso, kTorsoLink.mass,
                 kTorsoLink.inertia - kTorsoLink.mass * (kTorsoLink.across * kTorsoLink.across +
                                                         kTorsoLink.along * kTorsoLink.along)});
  for (const LegData& leg : kLegs) {
    const Jet angle = coordinate(q, leg.leg_angle);
    const Jet shape = coordinate(q, leg.leg_shape);
    // Equations 1 and 2: thigh = leg angle + leg shape, shin = leg angle - leg shape.
    const Jet thigh = torso + angle + shape;
    const Jet shin = torso + angle + (-1.0) * shape;
    const Point knee = offset(hip, thigh, 0.0, -kThighLength);
    all.push_back(hanging(kThigh, hip, thigh));
    all.push_back(hanging(kShin, knee, shin));
    all.push_back(hanging(kCSpring, offset(hip, torso, 0.0, kCSpringPivot), torso + 2.0 * shape));
    all.push_back(hanging(kCShin, hip, shin));
    all.push_back(spinning(leg.angle_inertia, coordinate(q, leg.motor_angle) + mount));
    all.push_back(spinning(leg.shape_inertia, coordinate(q, leg.motor_shape) + mount));
    all.push_back(spinning(kSpringPulley, coordinate(q, leg.spring) + mount));
  }
  return all;
}

double squared(double x) { return x * x; }

/// Equation 28 with Figure 17's preload.
double spring_torque(const LegData& leg, double q, double v) {
  const double elastic = -leg.spring_stiffness * q - leg.preload;
  if (q > 0.0) {
    return elastic - kSpringDamping * v;
  }
  const double stop = elastic - kStopCubic * q * q * q - kStopDamping * v;
  return v >= 0.0 ? stop : stop + kStopRoot * (std::sqrt(kStopRounding - v) - std::sqrt(kStopRounding));
}

/// d(all coordinates)/d(those that rigid cables leave).
Eigen::Matrix<double, kMabelCoordinates, 9> without_motors() {
  Eigen::Matrix<double, kMabelCoordinates, 9> S = Eigen::Matrix<double, kMabelCoordinates, 9>::Zero();
  int column = 0;
  for (int i = 0; i < kMabelCoordinates; ++i) {
    if (i == kMotorAngleLeft || i == kMotorShapeLeft || i == kMotorAngleRight || i == kMotorShapeRight) {
      continue;
    }
    S.col(column++) = mabel_without_stretch(MabelVector::Unit(i));
  }
  return S;
}

}  // namespace

MabelVector mabel_without_stretch(MabelVector q) {
  for (const LegData& leg : kLegs) {
    q[leg.motor_angle] = kRatioAngle * q[leg.leg_angle];
    q[leg.motor_shape] = kRatioShape * (q[leg.leg_shape] - q[leg.spring] / kRatioSpring);
  }
  return q;
}

double mabel_kinetic(const MabelOptions& options, const MabelVector& q, const MabelVector& v) {
  // The boom turns with the hip's motion over its length, about the tower and about the pivot.
  double twice = kBoomInertia * (squared(v[kHipX] / kBoomLength) + squared(v[kHipZ] / kBoomLength));
  for (const Link& link : links(options, q)) {
    twice += link.mass * (squared(link.centre.x.gradient.dot(v)) + squared(link.centre.z.gradient.dot(v))) +
             link.inertia * squared(link.angle.gradient.dot(v));
  }
  return 0.5 * twice;
}

double mabel_potential(const MabelVector& q) {
  double energy = kBoomMass * kGravity * kBoomCom / kBoomLength * q[kHipZ];
  for (const Link& link : links({}, q)) {
    energy += link.mass * kGravity * link.centre.z.value;
  }
  return energy;
}

MabelMatrix mabel_mass_matrix(const MabelOptions& options, const MabelVector& q) {
  MabelMatrix M = MabelMatrix::Zero();
  M(kHipX, kHipX) = M(kHipZ, kHipZ) = kBoomInertia / (kBoomLength * kBoomLength);
  for (const Link& link : links(options, q)) {
    M += link.mass * (link.centre.x.gradient * link.centre.x.gradient.transpose() +
                      link.centre.z.gradient * link.centre.z.gradient.transpose()) +
         link.inertia * link.angle.gradient * link.angle.gradient.transpose();
  }
  return M;
}

// With L = sum m |dp/dt|^2/2 + ..., Lagrange's d/dt(dL/dv) - dL/dq is sum m (dp/dq)' d2p/dt2 + ...; what
// remains of d2p/dt2 without accelerations is v' (d2p/dq2) v. All angles are linear in q and leave nothing.
MabelVector mabel_bias(const MabelOptions& options, const MabelVector& q, const MabelVector& v) {
  MabelVector bias = MabelVector::Zero();
  bias[kHipZ] = kBoomMass * kGravity * kBoomCom / kBoomLength;
  for (const Link& link : links(options, q)) {
    const Point& p = link.centre;
    bias += link.mass *
            (p.x.gradient * v.dot(p.x.hessian * v) + p.z.gradient * (v.dot(p.z.hessian * v) + kGravity));
  }
  return bias;
}

MabelVector mabel_forces(const MabelOptions& options, const MabelVector& q, const MabelVector& v,
                         const Eigen::Vector4d& torques) {
  MabelVector Q = MabelVector::Zero();
  for (std::size_t i = 0; i < kLegs.size(); ++i) {
    const LegData& leg = kLegs[i];
    const auto motor = static_cast<Eigen::Index>(2 * i);
    Q[leg.motor_angle] += torques[motor] - leg.angle_friction * v[leg.motor_angle];
    Q[leg.motor_shape] += torques[motor + 1] - leg.shape_friction * v[leg.motor_shape];
    Q[leg.spring] += spring_torque(leg, q[leg.spring], v[leg.spring]);
    if (!options.cables_stretch) {
      continue;
    }
    // Equations 23 to 25, with the sign that restores.
    MabelVector angle = MabelVector::Zero();
    angle[leg.motor_angle] = 1.0;
    angle[leg.leg_angle] = -kRatioAngle;
    MabelVector shape = MabelVector::Zero();
    shape[leg.motor_shape] = 1.0;
    shape[leg.leg_shape] = -kRatioShape;
    shape[leg.spring] = kRatioShape / kRatioSpring;
    Q -= angle * (leg.angle_stiffness * angle.dot(q) + leg.angle_cable_damping * angle.dot(v));
    Q -= shape * (leg.shape_stiffness * shape.dot(q) + leg.shape_cable_damping * shape.dot(v));
  }
  return Q;
}

MabelVector mabel_accelerations(const MabelOptions& options, const MabelVector& q, const MabelVector& v,
                                const Eigen::Vector4d& torques) {
  const MabelMatrix M = mabel_mass_matrix(options, q);
  const MabelVector right = mabel_forces(options, q, v, torques) - mabel_bias(options, q, v);
  if (options.cables_stretch) {
    return M.ldlt().solve(right);
  }
  const Eigen::Matrix<double, kMabelCoordinates, 9> S = without_motors();
  const Eigen::Matrix<double, 9, 9> reduced = S.transpose() * M * S;
  return S * reduced.ldlt().solve(S.transpose() * right);
}

}  // namespace plumbline::oracles
