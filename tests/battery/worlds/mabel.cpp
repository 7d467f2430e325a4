// Derivation. All axes along -y: a link at absolute angle q has what hangs c down and d across from its pivot
// at c e(q) + d n(q), with e = (sin q, -cos q), n = (cos q, sin q); de/dq = n, dn/dq = -e. Absolute angles
// are
//   T the torso's, a = T + p_LA + p_LS a thigh's, b = T + p_LA - p_LS a shin's, s = T + 2 p_LS a spring's
//   bar's;
// the shin's bar turns by b as well. From the hip h the centres of mass are at
//   torso u_t(T), thigh u(a), shin L e(a) + u(b), spring's bar -H e(T) + u(s), shin's bar u(b),
// u = c e + d n of the link's own c and d. Sums over what turns with one angle:
//   J_T = I_t + m_t |u_t|^2 + sum m_s H^2,      k_T = m_t u_t - sum m_s H e,
//   J_a = I_th + m_th |u|^2 + m_sh L^2,         k_a = m_th u + m_sh L e,
//   J_b = I + m |u|^2 of shin and shin's bar,   k_b = m u of both,   J_s, k_s of the spring's bar alone.
// With the mass m of all, the boom's at the hip included,
//   T = m h'^2/2 + h' . sum q_i' dk_i/dq + sum J_i q_i'^2/2 + sum over legs (f_ab a' b' + f_Ts T' s'),
//   f_ab(D) = m_sh L (c cos D + d sin D), D = a - b;  f_Ts(D) = -m_s H (c cos D + d sin D), D = T - s,
// from n(q1).n(q2) = cos(q1 - q2), n(q1).e(q2) = -sin(q1 - q2). Lagrange's terms beside M q'':
//   hip: -sum q_i'^2 k_i (dk/dq turned once more);   f(D) q1' q2':  -f' q2'^2 for q1,  +f' q1'^2 for q2.
// Gravity is (-g sin tilt, -g cos tilt): V = m g_. h + sum g_ . k_i with g_ = g (sin tilt, cos tilt).
// Angles over p are constant sums: M and the rest are turned into p by C' M C, C' h.
// Pulleys and motors turn by themselves (Park et al. count no reaction of theirs on the torso).
#include "tests/battery/worlds/mabel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plumbline::battery::worlds {
namespace {

enum Coordinate : int { kX, kZ, kTorso, kLeftAngle, kLeftShape, kRightAngle, kRightShape, kLeftPulley };
// Absolute: x, z, T, then of each leg a, b, s.
constexpr int kAbsolute = 9;
constexpr int kPlane = 7;  // coordinates without the pulleys
// s. In an impact a toe's slip, a few hundred grams on bristles under 2 kN, changes within some 30 us: steps
// of 20 us are half a floor off behind it, of 10 us less than a tenth.
constexpr double kImpactStep = 1e-5;
constexpr std::array<const char*, 2> kSides{"left", "right"};

using Absolute = Eigen::Matrix<double, kAbsolute, 1>;
using Square = Eigen::Matrix<double, kAbsolute, kAbsolute>;
using Chain = Eigen::Matrix<double, kAbsolute, kPlane>;
using Arm = Eigen::Vector2d;  // along and across in a link; x and z in the plane

int thigh_angle(int leg) { return 3 + 3 * leg; }
int shin_angle(int leg) { return 4 + 3 * leg; }
int spring_angle(int leg) { return 5 + 3 * leg; }

/// d(absolute)/dp
Chain chain_of_angles() {
  Chain c = Chain::Zero();
  c(0, kX) = c(1, kZ) = 1.0;
  c.col(kTorso).tail(kAbsolute - 2).setOnes();
  for (int leg = 0; leg < 2; ++leg) {
    const int angle = kLeftAngle + 2 * leg;
    const int shape = kLeftShape + 2 * leg;
    c(thigh_angle(leg), angle) = c(shin_angle(leg), angle) = 1.0;
    c(thigh_angle(leg), shape) = 1.0;
    c(shin_angle(leg), shape) = -1.0;
    c(spring_angle(leg), shape) = 2.0;
  }
  return c;
}

const Chain& chain() {
  static const Chain kChain = chain_of_angles();
  return kChain;
}

Arm down(double q) { return {std::sin(q), -std::cos(q)}; }
Arm across(double q) { return {std::cos(q), std::sin(q)}; }

Arm centre(const Link& link) { return {link.along, link.across}; }

/// The bodies of a leg in the rig's list.
struct Leg {
  const Link &thigh, &shin, &spring, &bar;
};
Leg leg_of(const Rig& rig, int leg) {
  const auto first = static_cast<std::size_t>(2 + 4 * leg);
  return {rig.bodies[first], rig.bodies[first + 1], rig.bodies[first + 2], rig.bodies[first + 3]};
}

/// Equations in absolute coordinates.
class Sum {
 public:
  Sum(const Rig& rig, Absolute q, Absolute w)
      : q_(std::move(q)),
        w_(std::move(w)),
        gravity_(rig.gravity * std::sin(rig.tilt), rig.gravity * std::cos(rig.tilt)) {}

  void hip(double mass) {
    M.topLeftCorner<2, 2>().diagonal().array() += mass;
    h.head<2>() += mass * gravity_;
  }
  /// All that turns with angle j about the hip or a pivot: its J and its k, along and across.
  void turns(int j, double inertia, const Arm& k) {
    const Arm arm = k.x() * down(q_[j]) + k.y() * across(q_[j]);
    const Arm slope = k.x() * across(q_[j]) - k.y() * down(q_[j]);
    M(j, j) += inertia;
    M.block<2, 1>(0, j) += slope;
    M.block<1, 2>(j, 0) += slope.transpose();
    h.head<2>() -= w_[j] * w_[j] * arm;
    h[j] += gravity_.dot(slope);
  }
  /// f(D) = k.x cos D + k.y sin D between two angles, D = q_i - q_j.
  void couple(int i, int j, const Arm& k) {
    const double D = q_[i] - q_[j];
    const double f = k.x() * std::cos(D) + k.y() * std::sin(D);
    const double slope = k.y() * std::cos(D) - k.x() * std::sin(D);
    M(i, j) += f;
    M(j, i) += f;
    h[i] -= slope * w_[j] * w_[j];
    h[j] += slope * w_[i] * w_[i];
  }

  Square M = Square::Zero();
  Absolute h = Absolute::Zero();

 private:
  Absolute q_, w_;
  Arm gravity_;
};

Sum sum_of(const Rig& rig, const Vector& p, const Vector& rate) {
  Sum sum(rig, chain() * p.head(kPlane), chain() * rate.head(kPlane));
  double mass = 0.0;
  for (const Link& link : rig.bodies) {
    mass += link.mass;
  }
  sum.hip(mass);
  const Link& torso = rig.bodies[1];
  sum.turns(2, torso.about_pivot(), torso.mass * centre(torso));
  for (int side = 0; side < 2; ++side) {
    const Leg leg = leg_of(rig, side);
    const double L = rig.length;
    const double H = rig.pivot;
    sum.turns(2, leg.spring.mass * H * H, {-leg.spring.mass * H, 0.0});
    sum.turns(thigh_angle(side), leg.thigh.about_pivot() + leg.shin.mass * L * L,
              leg.thigh.mass * centre(leg.thigh) + Arm(leg.shin.mass * L, 0.0));
    sum.turns(shin_angle(side), leg.shin.about_pivot() + leg.bar.about_pivot(),
              leg.shin.mass * centre(leg.shin) + leg.bar.mass * centre(leg.bar));
    sum.turns(spring_angle(side), leg.spring.about_pivot(), leg.spring.mass * centre(leg.spring));
    sum.couple(thigh_angle(side), shin_angle(side), leg.shin.mass * L * centre(leg.shin));
    sum.couple(2, spring_angle(side), -leg.spring.mass * H * centre(leg.spring));
  }
  return sum;
}

/// The lower end of a shin: h + L e(a) + f e(b).
FootMotion toe(const Rig& rig, const Ground& ground, const Vector& full, const Vector& full_rate) {
  const Absolute q = chain() * full.head(kPlane);
  const int a = thigh_angle(ground.leg);
  const int b = shin_angle(ground.leg);
  const double below = -ground.constant;
  FootMotion foot;
  foot.height = q[1] + rig.length * down(q[a]).y() + below * down(q[b]).y();
  Eigen::Matrix<double, 2, kAbsolute> by_angle = Eigen::Matrix<double, 2, kAbsolute>::Zero();
  by_angle(0, 0) = by_angle(1, 1) = 1.0;
  by_angle.col(a) = rig.length * across(q[a]);
  by_angle.col(b) = below * across(q[b]);
  const Eigen::Matrix<double, 2, kPlane> slope = by_angle * chain();
  foot.along = foot.up = Vector::Zero(rig.coordinates);
  foot.along.head(kPlane) = slope.row(0).transpose();
  foot.up.head(kPlane) = slope.row(1).transpose();
  foot.x_rate = slope.row(0).dot(full_rate.head(kPlane));
  foot.height_rate = slope.row(1).dot(full_rate.head(kPlane));
  return foot;
}

double joint_height(const model::Model& model, const std::string& name) {
  const auto found = std::find_if(model.skeleton.joints.begin(), model.skeleton.joints.end(),
                                  [&](const model::Joint& joint) { return joint.name == name; });
  return found->X_PJ.translation().z();
}

Vector factors(std::initializer_list<std::pair<int, double>> entries) {
  Vector row = Vector::Zero(kAbsolute);
  for (const auto& [coordinate, factor] : entries) {
    row[coordinate] = factor;
  }
  return row;
}

void add_leg(const model::Model& model, int leg, Rig& rig) {
  const std::string side = std::string("_") + kSides[static_cast<std::size_t>(leg)];
  const int angle = kLeftAngle + 2 * leg;
  const int shape = kLeftShape + 2 * leg;
  const int pulley = kLeftPulley + leg;
  for (const char* body : {"thigh", "shin", "cspring", "cshin"}) {
    rig.bodies.push_back(link_of(model, body + side));
  }
  rig.motors.push_back(motor_of(model, "mLA" + side, angle));
  rig.motors.push_back(motor_of(model, "mLS" + side, shape));
  rig.motors.back().also = pulley;
  rig.motors.back().also_ratio = model.find_ratio("leg_shape" + side)->ratios[1].value;
  rig.places.push_back({"leg_angle" + side, factors({{angle, 1.0}})});
  rig.places.push_back({"leg_shape" + side, factors({{shape, 1.0}})});
  rig.places.push_back({"thigh" + side, factors({{angle, 1.0}, {shape, 1.0}})});
  rig.places.push_back({"shin" + side, factors({{angle, 1.0}, {shape, -1.0}})});
  rig.places.push_back({"knee" + side, factors({{shape, -2.0}})});
  rig.places.push_back({"bsp" + side, factors({{pulley, 1.0}})});
  rig.pulleys.push_back(model.pulleys[static_cast<std::size_t>(leg)].inertia.value);
  rig.light.push_back(pulley);
  Ground ground;
  ground.name = model.feet[static_cast<std::size_t>(leg)].name;
  ground.constant = model.feet[static_cast<std::size_t>(leg)].point.z();
  ground.foot = toe;
  ground.leg = leg;
  rig.grounds.push_back(ground);
  const model::ContactSwitch& contact = model.switches[static_cast<std::size_t>(leg)];
  rig.switches.push_back(contact.name);
  rig.switch_force = contact.threshold;
}

}  // namespace

void mabel_equations(const Rig& rig, const Vector& p, const Vector& rate, Matrix& mass, Vector& bias) {
  const Sum sum = sum_of(rig, p, rate);
  mass.setZero();
  bias.setZero();
  mass.topLeftCorner(kPlane, kPlane) = chain().transpose() * sum.M * chain();
  bias.head(kPlane) = chain().transpose() * sum.h;
  for (std::size_t i = 0; i < rig.pulleys.size(); ++i) {
    const Eigen::Index at = kLeftPulley + static_cast<Eigen::Index>(i);
    mass(at, at) = rig.pulleys[i];
  }
}

Rig mabel(const model::Model& model) {
  Rig rig;
  rig.coordinates = kAbsolute;
  rig.equations = mabel_equations;
  rig.step = kImpactStep;
  rig.bodies = {link_of(model, "boom"), link_of(model, "torso_link")};
  rig.length = -joint_height(model, "knee_left");
  rig.pivot = joint_height(model, "csp_left");
  rig.places = {
      {"hip_x", factors({{kX, 1.0}})}, {"hip_z", factors({{kZ, 1.0}})}, {"torso", factors({{kTorso, 1.0}})}};
  add_leg(model, 0, rig);
  add_leg(model, 1, rig);
  return rig;
}

}  // namespace plumbline::battery::worlds
