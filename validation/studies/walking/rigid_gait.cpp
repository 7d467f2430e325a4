// Steps on the design model.
#include "validation/studies/walking/rigid_gait.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "simulator/integrate/rigid_contact_ode.h"
#include "simulator/trace/error.h"

namespace plumbline::validation {

using controllers::CurvePoint;
using controllers::WalkPhase;

namespace {

constexpr double kLongestPhase = 2.0;  // s: a phase that lasts longer does not end
constexpr int kFirstOutput = 3;        // in GaitCoordinates

int motor_of(const model::Model& model, const std::string& name) {
  const int motor = model.motor_index(name);
  if (motor < 0) {
    throw InputError(model.file + ": no motor is named '" + name + "'");
  }
  return motor;
}

}  // namespace

RigidWalker::RigidWalker(const RigidGait& gait) : gait_(gait), plant_(gait.model, {}), contact_(plant_) {
  const model::FootKinematics& names = contact_.kinematics();
  stance_foot_ = names.index_of(gait.stance.foot);
  swing_foot_ = names.index_of(gait.swing.foot);
  const int n = plant_.positions();
  rows_.resize(7, n);
  rows_.row(0) = -names.row_of(gait.stance.angle) - names.row_of(gait.torso);
  rows_.row(1) = names.row_of(gait.stance.spring);
  rows_.row(2) = names.row_of(gait.swing.spring);
  rows_.row(kFirstOutput + controllers::kStanceShape) = names.row_of(gait.stance.shape_motor);
  rows_.row(kFirstOutput + controllers::kSwingAngle) = names.row_of(gait.swing.angle);
  rows_.row(kFirstOutput + controllers::kSwingShape) = names.row_of(gait.swing.shape_motor);
  rows_.row(kFirstOutput + controllers::kTorso) = names.row_of(gait.torso);
  base_ = {names.row_of(gait.base[0]), names.row_of(gait.base[1])};
  shapes_[0] = names.row_of(gait.stance.shape);
  shapes_[1] = names.row_of(gait.swing.shape);
  motors_ = {motor_of(gait.model, gait.stance.angle_motor), motor_of(gait.model, gait.stance.shape_motor),
             motor_of(gait.model, gait.swing.angle_motor), motor_of(gait.model, gait.swing.shape_motor)};
  const auto sign = [&](const std::string& motor, const std::string& coordinate) {
    return names.row_of(motor).dot(names.row_of(coordinate)) < 0.0 ? -1.0 : 1.0;
  };
  motor_signs_ = {
      sign(gait.stance.angle_motor, gait.stance.angle), sign(gait.stance.shape_motor, gait.stance.shape),
      sign(gait.swing.angle_motor, gait.swing.angle), sign(gait.swing.shape_motor, gait.swing.shape)};
  // Roles are exchanged among the independent coordinates.
  const std::vector<std::string> states = plant_.state_names();
  const auto place = [&](const std::string& name) {
    const auto found = std::find(states.begin(), states.begin() + n, "position of " + name);
    if (found == states.begin() + n) {
      throw InputError(gait.file + ": exchange: found '" + name +
                       "', expected a joint or pulley that no ratio ties");
    }
    return static_cast<int>(found - states.begin());
  };
  exchange_ = Eigen::MatrixXd::Identity(n, n);
  for (const auto& [one, other] : gait.exchanged) {
    const int a = place(one);
    const int b = place(other);
    exchange_(a, a) = exchange_(b, b) = 0.0;
    exchange_(a, b) = exchange_(b, a) = 1.0;
  }
}

GaitCoordinates RigidWalker::coordinates(const Eigen::VectorXd& x, bool rates) const {
  const int n = plant_.positions();
  return rows_ * x.segment(rates ? n : 0, n);
}

// Everything but where the robot stands follows from these seven; the stance foot stands at (0, ground) and
// does not move.
Eigen::VectorXd RigidWalker::compose(const GaitCoordinates& q, const GaitCoordinates& v) {
  const int n = plant_.positions();
  Eigen::MatrixXd A(9, n);
  A << rows_, base_[0], base_[1];
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(A);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(9);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant_.states());
  right.head<7>() = q;
  x.head(n) = solver.solve(right);
  right.head<7>() = v;
  x.tail(n) = solver.solve(right);
  const model::PointMotion foot = contact_.kinematics().foot(stance_foot_, x.data());
  right << q, -foot.position.x(), ground_ - foot.position.z();
  x.head(n) = solver.solve(right);
  right << v, -foot.velocity.x(), -foot.velocity.z();
  x.tail(n) = solver.solve(right);
  return x;
}

Eigen::VectorXd RigidWalker::after_touchdown(const Eigen::Vector3d& before, double impact_scale) {
  const auto at = [&](double theta) {
    const std::array<CurvePoint, 4> h = wanted(gait_.gait, WalkPhase::spring_decompress, theta);
    GaitCoordinates q, v;
    q << theta, before[1], 0.0, h[0].value, h[1].value, h[2].value, h[3].value;
    v << before[0], before[2], 0.0, h[0].slope * before[0], h[1].slope * before[0], h[2].slope * before[0],
        h[3].slope * before[0];
    return compose(q, v);
  };
  const auto height = [&](double theta) {
    return contact_.kinematics().foot(swing_foot_, at(theta).data()).position.z() - ground_;
  };
  // Secant method: the swing foot comes down near the end of the curves.
  double theta = gait_.gait.theta_end;
  double other = theta - 0.02;
  double f = height(theta);
  double g = height(other);
  for (int round = 0; round < 30 && std::abs(f) > 1e-13 && f != g; ++round) {
    const double next = theta - f * (theta - other) / (f - g);
    other = theta;
    g = f;
    theta = next;
    f = height(theta);
  }
  return touchdown(at(theta), impact_scale, nullptr);
}

Eigen::Vector3d RigidWalker::before_touchdown(const Eigen::VectorXd& end) const {
  const GaitCoordinates q = coordinates(end, false);
  const GaitCoordinates v = coordinates(end, true);
  return {v[0], q[1], v[1]};
}

// Equations 16 to 18, then the old stance leg's motor takes its spring's deflection over and the legs
// exchange roles.
Eigen::VectorXd RigidWalker::touchdown(const Eigen::VectorXd& x, double impact_scale, RigidStep* step) {
  const int n = plant_.positions();
  Eigen::VectorXd after = x;
  const model::RigidContact::Blow blow =
      contact_.strike({{swing_foot_}, {gait_.stance.spring}}, after.data());
  after.tail(n) /= impact_scale;
  if (step != nullptr) {
    step->impulse = blow.feet.front();
    step->impact_loss = blow.lost;
    step->length = contact_.kinematics().foot(swing_foot_, x.data()).position.x() -
                   contact_.kinematics().foot(stance_foot_, x.data()).position.x();
  }
  // All but the springs (independent pulleys) stays where it is: the joints are independent, the motors
  // follow.
  const Eigen::RowVectorXd spring = rows_.row(1);
  after.head(n) -= spring.transpose() * (spring.dot(after.head(n)) / spring.squaredNorm());
  after.head(n) = (exchange_ * after.head(n)).eval();
  after.tail(n) = (exchange_ * after.tail(n)).eval();
  return after;
}

// A polynomial of degree 4 in s with both values at its beginning, and with value, slope and curvature zero
// at its end: as Bezier coefficients (value, value + slope length/4, 0, 0, 0).
CurvePoint RigidWalker::Correction::at(double theta) const {
  const double s = length > 0.0 ? (theta - begin) / length : 1.0;
  if (s >= 1.0) {
    return {};
  }
  const double a = value;
  const double b = value + 0.25 * slope * length;
  const double r = 1.0 - s;
  return {r * r * r * (a * r + 4.0 * b * s), 4.0 * r * r * (-a * r + b * (r - 3.0 * s)) / length,
          12.0 * r * (a * r - 2.0 * b * (r - s)) / (length * length)};
}

void RigidWalker::correct(const Eigen::VectorXd& x) {
  const GaitCoordinates q = coordinates(x, false);
  const GaitCoordinates v = coordinates(x, true);
  const controllers::WalkingGait& gait = gait_.gait;
  const std::array<CurvePoint, 4> h = wanted(gait, WalkPhase::motor_compress, q[0]);
  // The motor of the stance leg is at rest when mc ends; the torso's curve ends with si, the swing leg's with
  // the step.
  const std::array<double, 4> ends{gait.theta_mc, 0.5 * (gait.theta_begin + gait.theta_end),
                                   0.5 * (gait.theta_begin + gait.theta_end),
                                   0.5 * (gait.theta_begin + gait.theta_si)};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto row = kFirstOutput + static_cast<int>(i);
    corrections_[i] = {q[0], std::max(0.0, ends[i] - q[0]), q[row] - h[i].value,
                       v[0] > 0.0 ? v[row] / v[0] - h[i].slope : 0.0};
  }
}

// y'' = -2 w y' - w^2 y, all accelerations being affine in the torques.
void RigidWalker::exact(const std::array<CurvePoint, 4>& h, const double* x, const RigidGaitOptions& options,
                        double* u) {
  const int n = plant_.positions();
  const Eigen::Map<const Eigen::VectorXd> z(x, n);
  const Eigen::Map<const Eigen::VectorXd> w(x + n, n);
  Eigen::MatrixXd D(4, n);
  Eigen::Vector4d right;
  const double theta_rate = rows_.row(0).dot(w);
  for (int i = 0; i < 4; ++i) {
    CurvePoint curve = h[static_cast<std::size_t>(i)];
    const CurvePoint correction = corrections_[static_cast<std::size_t>(i)].at(rows_.row(0).dot(z));
    curve.value += correction.value;
    curve.slope += correction.slope;
    curve.curvature += correction.curvature;
    D.row(i) = rows_.row(kFirstOutput + i) - curve.slope * rows_.row(0);
    const double y = rows_.row(kFirstOutput + i).dot(z) - curve.value;
    right[i] = curve.curvature * theta_rate * theta_rate - 2.0 * options.bandwidth * D.row(i).dot(w) -
               options.bandwidth * options.bandwidth * y;
  }
  Eigen::VectorXd rate(plant_.states());
  std::fill(u, u + plant_.motors(), 0.0);
  contact_.rate(x, u, rate.data());
  const Eigen::Vector4d drift = D * rate.segment(n, n);
  Eigen::Matrix4d decoupling;
  for (int m = 0; m < 4; ++m) {
    const int motor = motors_[static_cast<std::size_t>(m)];
    u[motor] = 1.0;
    contact_.rate(x, u, rate.data());
    decoupling.col(m) = D * rate.segment(n, n) - drift;
    u[motor] = 0.0;
  }
  const Eigen::Vector4d torque = decoupling.partialPivLu().solve(right - drift);
  for (int m = 0; m < 4; ++m) {
    u[motors_[static_cast<std::size_t>(m)]] = torque[m];
  }
}

void RigidWalker::command(WalkPhase phase, const double* x, const RigidGaitOptions& options, double* u) {
  const int n = plant_.positions();
  const Eigen::Map<const Eigen::VectorXd> z(x, n);
  const Eigen::Map<const Eigen::VectorXd> w(x + n, n);
  const double theta = rows_.row(0).dot(z);
  const std::array<CurvePoint, 4> h = wanted(gait_.gait, phase, theta);
  if (options.control == GaitControl::exact) {
    exact(h, x, options, u);
    return;
  }
  const std::array<double, 4> star = feedforward(gait_.gait, phase, theta);
  const double theta_rate = rows_.row(0).dot(w);
  std::array<double, 4> back{};
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::RowVectorXd row = rows_.row(kFirstOutput + static_cast<int>(i));
    back[i] = gait_.kp[i] * (row.dot(z) - h[i].value) + gait_.kd[i] * (row.dot(w) - h[i].slope * theta_rate);
  }
  std::fill(u, u + plant_.motors(), 0.0);
  const auto at = [&](controllers::WalkMotor motor) -> double& {
    return u[motors_[static_cast<std::size_t>(motor)]];
  };
  // The torso is held against the stance leg: what turns the leg forward turns the torso back.
  at(controllers::kStanceAngleMotor) = star[0] + motor_signs_[0] * back[controllers::kTorso];
  at(controllers::kStanceShapeMotor) = star[1] - motor_signs_[1] * back[controllers::kStanceShape];
  at(controllers::kSwingAngleMotor) = star[2] - motor_signs_[2] * back[controllers::kSwingAngle];
  at(controllers::kSwingShapeMotor) = star[3] - motor_signs_[3] * back[controllers::kSwingShape];
}

double RigidWalker::event_value(WalkPhase phase, const double* x) {
  const Eigen::Map<const Eigen::VectorXd> z(x, plant_.positions());
  switch (phase) {
    case WalkPhase::motor_compress:
      return rows_.row(0).dot(z) - gait_.gait.theta_mc;
    case WalkPhase::spring_compress:
      return gait_.gait.spring_switch - rows_.row(1).dot(z);
    case WalkPhase::spring_inject:
      return rows_.row(0).dot(z) - gait_.gait.theta_si;
    case WalkPhase::spring_decompress:
      break;
  }
  return ground_ - contact_.kinematics().foot(swing_foot_, x).position.z();
}

void RigidWalker::record(double t, WalkPhase phase, const double* x, const RigidGaitOptions& options,
                         RigidStep& step) {
  const int n = plant_.positions();
  const Eigen::Map<const Eigen::VectorXd> z(x, n);
  const Eigen::Map<const Eigen::VectorXd> w(x + n, n);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(plant_.motors());
  Eigen::VectorXd rate(plant_.states());
  command(phase, x, options, u.data());
  contact_.rate(x, u.data(), rate.data());
  const rigid::FootLoad load = rigid::foot_load(contact_.foot_force(0));
  step.least_normal = std::min(step.least_normal, load.normal);
  step.largest_friction = std::max(step.largest_friction, load.needed_friction());
  if (!options.trace) {
    return;
  }
  const model::PointMotion swing = contact_.kinematics().foot(swing_foot_, x);
  std::vector<std::pair<std::pair<const char*, const char*>, double>> row{
      {{"t", "s"}, t},
      {{"phase", "1"}, static_cast<double>(phase)},
      {{"theta", "rad"}, rows_.row(0).dot(z)},
      {{"theta_rate", "rad/s"}, rows_.row(0).dot(w)},
      {{"angle_stance", "rad"}, -rows_.row(0).dot(z) - rows_.row(6).dot(z)},
      {{"angle_swing", "rad"}, rows_.row(4).dot(z)},
      {{"shape_motor_stance", "rad"}, rows_.row(3).dot(z)},
      {{"shape_motor_swing", "rad"}, rows_.row(5).dot(z)},
      {{"trunk", "rad"}, rows_.row(6).dot(z)},
      {{"shape_stance", "rad"}, shapes_[0].dot(z)},
      {{"shape_swing", "rad"}, shapes_[1].dot(z)},
      {{"spring_stance", "rad"}, rows_.row(1).dot(z)},
      {{"spring_rate", "rad/s"}, rows_.row(1).dot(w)},
      {{"swing_height", "m"}, swing.position.z() - ground_},
      {{"F_x", "N"}, contact_.foot_force(0).x()},
      {{"F_z", "N"}, contact_.foot_force(0).z()},
      // As printed: what turns the leg angle or shape up is above zero.
      {{"u_angle_stance", "N m"}, motor_signs_[0] * u[motors_[0]]},
      {{"u_shape_stance", "N m"}, motor_signs_[1] * u[motors_[1]]},
      {{"u_angle_swing", "N m"}, motor_signs_[2] * u[motors_[2]]},
      {{"u_shape_swing", "N m"}, motor_signs_[3] * u[motors_[3]]}};
  if (step.trace.columns.empty()) {
    for (const auto& [label, value] : row) {
      step.trace.columns.push_back({label.first, label.second, Eigen::VectorXd()});
    }
  }
  for (std::size_t c = 0; c < row.size(); ++c) {
    Eigen::VectorXd& values = step.trace.columns[c].values;
    values.conservativeResize(values.size() + 1);
    values[values.size() - 1] = row[c].second;
  }
}

bool RigidWalker::until_event(Eigen::VectorXd& x, WalkPhase phase, const RigidGaitOptions& options,
                              RigidStep& step) {
  const int states = plant_.states();
  integrate::RigidContactOde ode(
      plant_, contact_, [&](double, const double* at, double* u) { command(phase, at, options, u); }, 1,
      [&](double, const double* at, double* g) { g[0] = event_value(phase, at); });
  integrate::Options method;
  method.set_tolerance(options.tolerance);
  method.max_step = options.trace ? 2e-3 : 1e-2;
  integrate::Integrator integrator(ode, method);
  Eigen::VectorXd start = Eigen::VectorXd::Zero(ode.size());
  start.head(states) = x;
  integrator.start(0.0, start);
  const double from = step.time;
  Eigen::VectorXd u(plant_.motors());
  // Trapezoids between the method's steps.
  double last = 0.0;
  double last_power = 0.0;
  double last_square = 0.0;
  const auto sum = [&](double until, const Eigen::VectorXd& state) {
    command(phase, state.data(), options, u.data());
    double power = 0.0;
    for (int m = 0; m < plant_.motors(); ++m) {
      const std::string& name = gait_.model.motors[static_cast<std::size_t>(m)].name;
      power += std::max(0.0, u[m] * plant_.velocity_of(name, state.data()));
    }
    if (until > 0.0) {
      step.positive_work += 0.5 * (power + last_power) * (until - last);
      step.torque_squared += 0.5 * (u.squaredNorm() + last_square) * (until - last);
    }
    last = until;
    last_power = power;
    last_square = u.squaredNorm();
  };
  sum(0.0, start);
  record(from, phase, x.data(), options, step);
  while (integrator.time() < kLongestPhase) {
    integrator.step(kLongestPhase);
    if (!integrator.events().empty() && integrator.events().back().direction > 0) {
      const integrate::Event& event = integrator.events().back();
      x = event.state.head(states);
      sum(event.time, event.state);
      step.time = from + event.time;
      record(step.time, phase, x.data(), options, step);
      return true;
    }
    sum(integrator.time(), integrator.state());
    record(from + integrator.time(), phase, integrator.state().data(), options, step);
    const Eigen::VectorXd now = integrator.state().head(states);
    if (coordinates(now, true)[0] < 0.0) {
      step.failure = "theta is not monotonic: the robot falls back";
      return false;
    }
    if (std::abs(theta(now)) > 1.2) {
      step.failure = "the robot falls: no touchdown";
      return false;
    }
  }
  step.failure = "a phase lasts longer than 2 s";
  return false;
}

bool RigidWalker::walk(Eigen::VectorXd& x, const Walk& from, const RigidGaitOptions& options,
                       RigidStep& step) {
  contact_.hold({{stance_foot_}, {gait_.swing.spring}}, x.data());
  ground_ = contact_.kinematics().foot(stance_foot_, x.data()).position.z();
  contact_.project(x.data());
  if (from.phase == WalkPhase::motor_compress) {
    correct(x);
  } else {
    corrections_ = {};
  }
  for (int phase = static_cast<int>(from.phase); phase < controllers::kWalkPhases; ++phase) {
    if (from.to_switch && phase == static_cast<int>(WalkPhase::spring_decompress)) {
      return true;
    }
    if (!until_event(x, static_cast<WalkPhase>(phase), options, step)) {
      return false;
    }
    if (phase < 3) {
      step.phase_ends[static_cast<std::size_t>(phase)] = step.time;
    }
  }
  return true;
}

RigidStep RigidWalker::step(const Eigen::VectorXd& start, const RigidGaitOptions& options) {
  RigidStep step;
  step.least_normal = 1e9;
  Eigen::VectorXd x = start;
  try {
    step.walked = walk(x, {WalkPhase::motor_compress, false}, options, step);
  } catch (const std::runtime_error& error) {
    step.failure = error.what();
  }
  if (step.walked) {
    step.end = x;
    step.next = touchdown(x, options.impact_scale, &step);
  }
  return step;
}

}  // namespace plumbline::validation
