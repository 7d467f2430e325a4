#include "tests/battery/worlds/mujoco_rig.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "tests/benchmark/mujoco_model.h"

namespace plumbline::battery::worlds {
namespace {

// Rigid gears: MuJoCo's constraints as stiff as its time step lets them be.
constexpr const char* kRigid = "solref='0.0002 1' solimp='0.9999 0.9999 0.001'";

/// Is it MuJoCo's own dry friction? At joints and motors, which are joints there.
bool is_friction_loss(const Hidden& e) { return e.effect == "coulomb"; }

std::string inertial(const Link& link) {
  std::ostringstream text;
  text.precision(17);
  // MuJoCo asks for inertias that a solid body can have; what turns out of the plane does no work.
  text << "<inertial pos='" << link.across << " 0 " << -link.along << "' mass='" << link.mass
       << "' diaginertia='" << link.central << ' ' << link.central << ' ' << link.central << "'/>";
  return text.str();
}

/// Links' coordinates over MuJoCo's joints, in the order of its tree, without rotors.
struct Tree {
  std::string bodies;
  std::vector<std::string> joints;
  Eigen::MatrixXd coordinates;    // coordinates x joints
  std::vector<std::string> ties;  // equality constraints between joints
};

std::string hinge(const std::string& name, const std::string& axis, const char* type = "hinge") {
  return "<joint name='" + name + "' type='" + type + "' axis='" + axis + "'/>";
}

Tree tree_of(const Rig& rig, const std::string& robot) {
  Tree tree;
  std::ostringstream b;
  b.precision(17);
  if (robot == "pendulum") {
    b << "<body name='arm'>" << hinge("shoulder", "0 1 0") << inertial(rig.bodies[0]) << "</body>";
    tree.joints = {"shoulder"};
    tree.coordinates = Eigen::MatrixXd::Ones(1, 1);
  } else if (robot == "leg_bench") {
    b << "<body name='thigh'>" << hinge("hip", "0 -1 0") << inertial(rig.bodies[0])
      << "<body name='shin' pos='0 0 " << -rig.length << "'>" << hinge("knee", "0 -1 0")
      << inertial(rig.bodies[1]) << "</body></body>"
      << "<body name='cspring'>" << hinge("csp", "0 -1 0") << inertial(rig.bodies[2]) << "</body>"
      << "<body name='cshin'>" << hinge("csh", "0 -1 0") << inertial(rig.bodies[3]) << "</body>";
    tree.joints = {"hip", "knee", "csp", "csh"};
    tree.coordinates.resize(2, 4);
    tree.coordinates << 1.0, 0.5, 0.0, 0.0,  //
        0.0, -0.5, 0.0, 0.0;
    tree.ties = {"csp:1 knee:1", "csh:1 hip:-1 knee:-1"};
  } else if (robot == "cart") {
    std::ostringstream axis;
    axis.precision(17);
    axis << std::cos(rig.incline) << " 0 " << std::sin(rig.incline);
    b << "<body name='cart'>" << hinge("way", axis.str(), "slide") << inertial(rig.bodies[0]) << "</body>";
    tree.joints = {"way"};
    tree.coordinates = Eigen::MatrixXd::Ones(1, 1);
  } else {
    b << "<body name='body'>" << hinge("rail", "0 0 1", "slide") << inertial(rig.bodies[0])
      << "<body name='slider'>" << hinge("guide", "0 0 -1", "slide") << inertial(rig.bodies[1])
      << "<body name='foot'>" << hinge("leg", "0 0 1", "slide") << inertial(rig.bodies[2])
      << "</body></body></body>";
    tree.joints = {"rail", "guide", "leg"};
    tree.coordinates = Eigen::MatrixXd::Identity(3, 3);
  }
  tree.bodies = b.str();
  return tree;
}

/// "csp:1 knee:1" as a fixed tendon.
std::string tendon(const std::string& name, const std::string& terms, const std::string& attributes) {
  std::ostringstream text;
  text << "<fixed name='" << name << "' " << attributes << ">";
  std::istringstream items(terms);
  for (std::string item; items >> item;) {
    const std::size_t colon = item.find(':');
    text << "<joint joint='" << item.substr(0, colon) << "' coef='" << item.substr(colon + 1) << "'/>";
  }
  text << "</fixed>";
  return text.str();
}

/// motor - ratio * coordinate over the joints.
std::string wind_up(const Tree& tree, const Motor& motor) {
  std::ostringstream text;
  text.precision(17);
  text << motor.name << ":1";
  for (std::size_t j = 0; j < tree.joints.size(); ++j) {
    const double factor = tree.coordinates(motor.drives, static_cast<Eigen::Index>(j));
    if (factor != 0.0) {
      text << ' ' << tree.joints[j] << ':' << -motor.ratio * factor;
    }
  }
  return text.str();
}

const Hidden* stretch_of(const Rig& rig, const Motor& motor) {
  for (const Hidden& e : rig.effects) {
    const Place* place = rig.place(e.at);
    if (is_compliance(e) && place != nullptr && place->row[motor.drives] == 1.0) {
      return &e;
    }
  }
  return nullptr;
}

double friction_loss(const Rig& rig, const std::string& at) {
  double level = 0.0;
  for (const Hidden& e : rig.effects) {
    level += is_friction_loss(e) && e.at == at ? e["level"] : 0.0;
  }
  return level;
}

/// The whole model. Places of the links that are no joint have their friction at a tendon.
std::string xml_of(const Rig& rig, const Tree& tree, const std::vector<std::string>& locked) {
  std::ostringstream x;
  x.precision(17);
  x << "<mujoco><compiler angle='radian' balanceinertia='false' inertiafromgeom='false' boundmass='0'/>"
    << "<size njmax='200' nconmax='10'/><option timestep='" << kStep << "' integrator='RK4' solver='Newton' "
    << "tolerance='1e-12' iterations='100' gravity='" << -rig.gravity * std::sin(rig.tilt) << " 0 "
    << -rig.gravity * std::cos(rig.tilt) << "'><flag contact='disable'/></option><worldbody>" << tree.bodies;
  for (const Motor& motor : rig.motors) {
    x << "<body name='rotor_" << motor.name << "'><joint name='" << motor.name
      << "' type='hinge' axis='0 1 0' frictionloss='" << friction_loss(rig, motor.name)
      << "' solreffriction='0.0002 1' solimpfriction='0.9999 0.9999 0.001'/><inertial pos='0 0 0' "
         "mass='0.001' "
      << "diaginertia='" << motor.inertia << ' ' << motor.inertia << ' ' << motor.inertia << "'/></body>";
  }
  x << "</worldbody><tendon>";
  std::ostringstream equal;
  for (std::size_t i = 0; i < tree.ties.size(); ++i) {
    const std::string name = "tie" + std::to_string(i);
    x << tendon(name, tree.ties[i], "");
    equal << "<tendon tendon1='" << name << "' " << kRigid << "/>";
  }
  for (const Motor& motor : rig.motors) {
    const Hidden* stretch = stretch_of(rig, motor);
    x << tendon("gear_" + motor.name, wind_up(tree, motor), "");
    if (stretch == nullptr) {
      equal << "<tendon tendon1='gear_" << motor.name << "' " << kRigid << "/>";
    }
    if (std::find(locked.begin(), locked.end(), motor.name) != locked.end()) {
      equal << "<joint joint1='" << motor.name << "' polycoef='LOCK_" << motor.name << " 0 0 0 0' " << kRigid
            << "/>";
    }
  }
  for (const Place& place : rig.places) {
    const double level = friction_loss(rig, place.name);
    if (level > 0.0) {
      std::ostringstream terms, attributes;
      terms.precision(17);
      for (std::size_t j = 0; j < tree.joints.size(); ++j) {
        const double factor = place.row.dot(tree.coordinates.col(static_cast<Eigen::Index>(j)));
        if (factor != 0.0) {
          terms << ' ' << tree.joints[j] << ':' << factor;
        }
      }
      attributes << "frictionloss='" << level
                 << "' solreffriction='0.0002 1' solimpfriction='0.9999 0.9999 0.001'";
      x << tendon("friction_" + place.name, terms.str(), attributes.str());
    }
  }
  x << "</tendon><equality>" << equal.str() << "</equality></mujoco>";
  return x.str();
}

void replace_all(std::string& text, const std::string& what, const std::string& with) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size())) {
    text.replace(at, what.size(), with);
  }
}

/// The rig while it runs: where things are in MuJoCo's arrays, lags, commands of the moment.
struct Running {
  const Rig* rig = nullptr;
  Eigen::MatrixXd to_full;  // links' coordinates and motors over MuJoCo's joints
  Vector commands;          // as they reach the winding: delayed and lagged
  Vector loads;             // that the gears passed on a step ago

  Vector full(const mjtNum* q) const {
    return to_full * Eigen::Map<const Eigen::VectorXd>(q, to_full.cols());
  }
};

thread_local Running* running = nullptr;

/// Everything that MuJoCo has no element for, as forces on its joints.
void add_forces(const mjModel* /*model*/, mjData* data) {
  if (running == nullptr) {
    return;
  }
  const Rig& rig = *running->rig;
  const Vector full = running->full(data->qpos);
  const Vector rate = running->full(data->qvel);
  Vector Q = Vector::Zero(full.size());
  const Eigen::Index n = rig.coordinates;
  for (std::size_t i = 0; i < rig.motors.size(); ++i) {
    const auto m = static_cast<Eigen::Index>(i);
    Q[n + m] += rig.motors[i].torque_per_unit * running->commands[m];
  }
  for (const Hidden& e : rig.effects) {
    const auto* motor = std::find_if(rig.motors.data(), rig.motors.data() + rig.motors.size(),
                                     [&](const Motor& one) { return one.name == e.at; });
    const bool at_motor = motor != rig.motors.data() + rig.motors.size();
    const auto m = static_cast<Eigen::Index>(motor - rig.motors.data());
    if (e.effect == "torque_bias") {
      Q[n + m] += e["bias"];
    } else if (is_of_drive(e)) {
      const double asked = rig.motors[static_cast<std::size_t>(m)].torque_per_unit * running->commands[m];
      Q[n + m] += delivered(e, asked, full[n + m], rate[n + m]) - asked;
    } else if (is_compliance(e)) {
      for (std::size_t i = 0; i < rig.motors.size(); ++i) {
        const Motor& one = rig.motors[i];
        if (rig.place(e.at)->row[one.drives] != 1.0) {
          continue;
        }
        const Eigen::Index at = n + static_cast<Eigen::Index>(i);
        const double f = compliance_force(e, full[at] - one.ratio * full[one.drives],
                                          rate[at] - one.ratio * rate[one.drives]);
        Q[at] += f;
        Q[one.drives] -= one.ratio * f;
      }
    } else if (is_force(e) && !is_friction_loss(e)) {
      const Vector row = at_motor ? Vector(Vector::Unit(full.size(), n + m)) : [&] {
        Vector r = Vector::Zero(full.size());
        r.head(n) = rig.place(e.at)->row;
        return r;
      }();
      constexpr double kAtRest[2] = {0.0, 0.0};  // bristles and masses on springs stay where they are
      Q += row * force(e, {row.dot(full), row.dot(rate), at_motor ? running->loads[m] : 0.0}, kAtRest);
    }
  }
  for (const Ground& ground : rig.grounds) {
    Q.head(n) += ground.row * ground_force_of(rig, ground, full, rate);
  }
  Eigen::Map<Eigen::VectorXd>(data->qfrc_passive, running->to_full.cols()) +=
      running->to_full.transpose() * Q;
}

/// Commands over a sample as the motors feel them.
class Delivery {
 public:
  explicit Delivery(const Rig& rig) : delay_(rig.motors.size(), 0.0), drift_(delay_), lag_(delay_) {
    for (const Hidden& e : rig.effects) {
      for (std::size_t i = 0; i < rig.motors.size(); ++i) {
        delay_[i] += e.effect == "bus_delay" ? e["delay"] : 0.0;
        if (rig.motors[i].name == e.at) {
          delay_[i] += e.effect == "command_delay" ? e["delay"] : 0.0;
          delay_[i] += e.effect == "clock_drift" ? e["offset"] : 0.0;
          drift_[i] += e.effect == "clock_drift" ? e["drift"] : 0.0;
          lag_[i] += e.effect == "actuator_lag" ? e["time_constant"] : 0.0;
        }
      }
    }
  }
  /// From t to t + kStep.
  void deliver(const Eigen::MatrixXd& given, double t, double period, Vector& u) {
    for (Eigen::Index m = 0; m < u.size(); ++m) {
      const auto i = static_cast<std::size_t>(m);
      const double now = t + 0.5 * kStep;
      const double back = (now - delay_[i] - drift_[i] * now) / period;
      const double held = given(m, std::max<Eigen::Index>(0, static_cast<Eigen::Index>(std::floor(back))));
      // The lag's own solution for a held command, at the middle of the step.
      u[m] = lag_[i] <= 0.0 || begun_ == 0 ? held : held + (u[m] - held) * std::exp(-kStep / lag_[i]);
    }
    ++begun_;
  }

 private:
  std::vector<double> delay_, drift_, lag_;
  long begun_ = 0;
};

Eigen::MatrixXd full_map(const Rig& rig, const Tree& tree) {
  const auto joints = static_cast<Eigen::Index>(tree.joints.size());
  const auto motors = static_cast<Eigen::Index>(rig.motors.size());
  Eigen::MatrixXd map = Eigen::MatrixXd::Zero(rig.coordinates + motors, joints + motors);
  map.topLeftCorner(rig.coordinates, joints) = tree.coordinates;
  map.bottomRightCorner(motors, motors).setIdentity();
  return map;
}

/// Joints at the start: links as they are, ties kept, gears unwound.
Eigen::VectorXd start_joints(const Rig& rig, const std::string& robot, const Vector& start) {
  Eigen::VectorXd q;
  if (robot == "leg_bench") {
    q.resize(4 + 2);
    q.head(4) << start[0] + start[1], -2.0 * start[1], 2.0 * start[1], start[0] - start[1];
  } else {
    q.resize(rig.coordinates + static_cast<Eigen::Index>(rig.motors.size()));
    q.head(rig.coordinates) = start;
  }
  for (std::size_t i = 0; i < rig.motors.size(); ++i) {
    q[q.size() - static_cast<Eigen::Index>(rig.motors.size() - i)] =
        rig.motors[i].ratio * start[rig.motors[i].drives];
  }
  return q;
}

}  // namespace

bool has_mujoco() { return true; }

Motion run_in_mujoco(const Rig& rig, const std::string& robot, const std::vector<std::string>& locked,
                     const Vector& start, Eigen::Index count, double period, const Commander& command) {
  const Tree tree = tree_of(rig, robot);
  const Eigen::VectorXd q0 = start_joints(rig, robot, start);
  const auto motors = static_cast<Eigen::Index>(rig.motors.size());
  std::string xml = xml_of(rig, tree, locked);
  for (Eigen::Index m = 0; m < motors; ++m) {
    std::ostringstream value;
    value.precision(17);
    value << q0[q0.size() - motors + m];
    replace_all(xml, "LOCK_" + rig.motors[static_cast<std::size_t>(m)].name, value.str());
  }
  const benchmarks::MujocoModel model = benchmarks::compile(xml);
  const benchmarks::MujocoData data(mj_makeData(model.get()));
  Eigen::Map<Eigen::VectorXd>(data->qpos, q0.size()) = q0;
  Running now{&rig, full_map(rig, tree), Vector::Zero(motors), Vector::Zero(motors)};
  running = &now;
  mjcb_passive = add_forces;
  Delivery delivery(rig);
  Motion motion;
  motion.positions.resize(now.to_full.rows(), count);
  motion.rates.resize(now.to_full.rows(), count);
  motion.commands.resize(motors, count);
  Vector given = Vector::Zero(motors);
  const auto steps = static_cast<int>(std::lround(period / kStep));
  for (Eigen::Index k = 0; k < count; ++k) {
    motion.positions.col(k) = now.full(data->qpos);
    motion.rates.col(k) = now.full(data->qvel);
    command(k, readings_of(rig, motion.positions.col(k)), given);
    motion.commands.col(k) = given;
    for (int s = 0; s < steps; ++s) {
      delivery.deliver(motion.commands, static_cast<double>(k) * period + s * kStep, period, now.commands);
      mj_step(model.get(), data.get());
      for (Eigen::Index m = 0; m < motors; ++m) {
        const Motor& motor = rig.motors[static_cast<std::size_t>(m)];
        now.loads[m] = motor.torque_per_unit * now.commands[m] -
                       motor.inertia * data->qacc[model->nv - static_cast<int>(motors - m)];
      }
    }
  }
  running = nullptr;
  mjcb_passive = nullptr;
  return motion;
}

}  // namespace plumbline::battery::worlds
