#include "tests/rigid/simbody_machine.h"

#include <Simbody.h>

namespace plumbline::rigid_tests {
namespace {

using model::Joint;
using model::JointType;

SimTK::Vec3 vec(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

SimTK::Transform transform(const Eigen::Isometry3d& X) {
  SimTK::Mat33 R;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      R(i, j) = X.linear()(i, j);
    }
  }
  return {SimTK::Rotation(R), vec(Eigen::Vector3d(X.translation()))};
}

SimTK::Transform mobilizer_frame(const Eigen::Isometry3d& X, const Joint& joint) {
  const SimTK::CoordinateAxis own = joint.type == JointType::prismatic ? SimTK::CoordinateAxis(SimTK::XAxis)
                                                                       : SimTK::CoordinateAxis(SimTK::ZAxis);
  const SimTK::Rotation along(SimTK::UnitVec3(vec(joint.axis)), own);
  return transform(X) * SimTK::Transform(along);
}

SimTK::Body::Rigid rigid(const model::Body& body) {
  const Eigen::Matrix3d& I = body.inertia;
  const SimTK::Vec3 com = vec(body.com);
  const SimTK::Inertia about_com(I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
  return SimTK::Body::Rigid(
      SimTK::MassProperties(body.mass, com, about_com.shiftFromMassCenter(com, body.mass)));
}

}  // namespace

struct SimbodyMachine::Impl {
  const model::Model model;
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  SimTK::GeneralForceSubsystem forces{system};
  SimTK::Force::UniformGravity gravity;
  SimTK::Force::DiscreteForces torques{forces, matter};
  std::vector<SimTK::MobilizedBodyIndex> links;
  std::map<std::string, SimTK::MobilizedBodyIndex> moving;  // joints, motors, pulleys
  std::vector<SimTK::ConstraintIndex> planes;
  SimTK::State state;

  explicit Impl(const model::Model& from)
      : model(from), gravity(forces, matter, vec(from.skeleton.gravity)) {}

  void add_links() {
    links.resize(model.skeleton.bodies.size());
    for (const Joint& joint : model.skeleton.joints) {
      const auto child = static_cast<std::size_t>(joint.child);
      const SimTK::MobilizedBodyIndex on =
          joint.parent < 0 ? SimTK::GroundIndex : links[static_cast<std::size_t>(joint.parent)];
      SimTK::MobilizedBody& parent = matter.updMobilizedBody(on);
      const SimTK::Transform X_PF = mobilizer_frame(joint.X_PJ, joint);
      const SimTK::Transform X_BM = mobilizer_frame(joint.X_CJ, joint);
      const SimTK::Body::Rigid body = rigid(model.skeleton.bodies[child]);
      if (joint.type == JointType::fixed) {
        links[child] = SimTK::MobilizedBody::Weld(parent, X_PF, body, X_BM);
        continue;
      }
      links[child] = joint.type == JointType::revolute
                         ? SimTK::MobilizedBodyIndex(SimTK::MobilizedBody::Pin(parent, X_PF, body, X_BM))
                         : SimTK::MobilizedBodyIndex(SimTK::MobilizedBody::Slider(parent, X_PF, body, X_BM));
      moving[joint.name] = links[child];
    }
  }

  // With all inertias that turn with it.
  void add_turning(const std::string& name, double inertia, bool angular) {
    for (const model::Inertia& more : model.inertias) {
      inertia += more.at == name ? more.value.value : 0.0;
    }
    const double mass = angular ? 1.0 : inertia;
    const SimTK::Inertia about =
        angular ? SimTK::Inertia(inertia, inertia, inertia) : SimTK::Inertia(1, 1, 1);
    // Rotors turn about the vertical and sliders lie level: no weight acts on them. Simbody's point about the
    // origin.
    const SimTK::Body::Rigid body(SimTK::MassProperties(mass, SimTK::Vec3(0), about));
    if (angular) {
      moving[name] = SimTK::MobilizedBody::Pin(matter.Ground(), body);
    } else {
      moving[name] = SimTK::MobilizedBody::Slider(matter.Ground(), body);
    }
  }

  void add_terms(const std::string& name, double factor, std::map<std::string, double>& sum) const {
    const model::Coordinate* coordinate =
        moving.count(name) > 0 && model.find_motor(name) != nullptr ? nullptr : model.find_coordinate(name);
    if (coordinate == nullptr) {
      sum[name] += factor;
      return;
    }
    for (const model::Term& term : coordinate->terms) {
      if (term.of == name) {
        sum[name] += factor * term.factor;
      } else {
        add_terms(term.of, factor * term.factor, sum);
      }
    }
  }

  void add_ratio(const model::Ratio& ratio) {
    std::map<std::string, double> sum;
    add_terms(ratio.motor, 1.0, sum);
    for (const model::Term& term : ratio.to) {
      add_terms(term.of, -term.factor, sum);
    }
    SimTK::Vector factors(static_cast<int>(sum.size()) + 1, 0.0);
    std::vector<SimTK::MobilizedBodyIndex> bodies;
    std::vector<SimTK::MobilizerQIndex> first;
    for (const auto& [name, factor] : sum) {
      factors[static_cast<int>(bodies.size())] = factor;
      bodies.push_back(moving.at(name));
      first.emplace_back(0);
    }
    const SimTK::Constraint::CoordinateCoupler coupler(matter, new SimTK::Function::Linear(factors), bodies,
                                                       first);
  }

  void pin(int foot, const std::vector<int>& axes) {
    const model::Foot& it = model.feet[static_cast<std::size_t>(foot)];
    for (const int axis : axes) {
      SimTK::Vec3 normal(0);
      normal[axis] = 1.0;
      planes.push_back(SimTK::Constraint::PointInPlane(
                           matter.Ground(), SimTK::UnitVec3(normal), 0.0,
                           matter.updMobilizedBody(links[static_cast<std::size_t>(it.body)]), vec(it.point))
                           .getConstraintIndex());
    }
  }

  Answer collect(const SimTK::Vector& by_mobility, const SimTK::Vector& multipliers, double sign) const {
    Answer answer;
    for (const auto& [name, body] : moving) {
      answer.coordinate[name] =
          by_mobility[static_cast<int>(matter.getMobilizedBody(body).getFirstUIndex(state))];
    }
    answer.at_feet.resize(static_cast<Eigen::Index>(planes.size()));
    const int others = multipliers.size() - static_cast<int>(planes.size());  // couplers were added first
    for (Eigen::Index i = 0; i < answer.at_feet.size(); ++i) {
      answer.at_feet[i] = sign * multipliers[others + static_cast<int>(i)];
    }
    return answer;
  }
};

SimbodyMachine::SimbodyMachine(const model::Model& model, const std::vector<int>& feet,
                               const std::vector<std::vector<int>>& axes)
    : impl_(std::make_unique<Impl>(model)) {
  Impl& d = *impl_;
  d.add_links();
  for (const model::Motor& motor : model.motors) {
    d.add_turning(motor.name, motor.rotor_inertia.value, motor.angular);
  }
  for (const model::Pulley& pulley : model.pulleys) {
    d.add_turning(pulley.name, pulley.inertia.value, true);
  }
  for (const model::Ratio& ratio : model.ratios) {
    d.add_ratio(ratio);
  }
  for (std::size_t f = 0; f < feet.size(); ++f) {
    d.pin(feet[f], axes[f]);
  }
  d.state = d.system.realizeTopology();
  d.system.realizeModel(d.state);
}

SimbodyMachine::~SimbodyMachine() = default;

void SimbodyMachine::set(const std::map<std::string, std::pair<double, double>>& states) {
  Impl& d = *impl_;
  for (const auto& [name, body] : d.moving) {
    const auto [q, u] = states.at(name);
    d.matter.getMobilizedBody(body).setOneQ(d.state, 0, q);
    d.matter.getMobilizedBody(body).setOneU(d.state, 0, u);
  }
}

SimbodyMachine::Answer SimbodyMachine::accelerate(const Eigen::VectorXd& torques) {
  Impl& d = *impl_;
  for (Eigen::Index m = 0; m < torques.size(); ++m) {
    const SimTK::MobilizedBody& body =
        d.matter.getMobilizedBody(d.moving.at(d.model.motors[static_cast<std::size_t>(m)].name));
    d.torques.setOneMobilityForce(d.state, body, SimTK::MobilizerUIndex(0), torques[m]);
  }
  d.system.realize(d.state, SimTK::Stage::Acceleration);
  return d.collect(d.state.getUDot(), d.state.getMultipliers(), -1.0);  // M du/dt + G' lambda = f
}

SimbodyMachine::Answer SimbodyMachine::strike() {
  Impl& d = *impl_;
  d.system.realize(d.state, SimTK::Stage::Velocity);
  SimTK::Vector wanted;
  d.matter.multiplyByG(d.state, d.state.getU(), wanted);
  SimTK::Vector impulse, along, change;
  d.matter.solveForConstraintImpulses(d.state, -wanted, impulse);
  d.matter.multiplyByGTranspose(d.state, impulse, along);
  d.matter.multiplyByMInv(d.state, along, change);
  return d.collect(d.state.getU() + change, impulse, 1.0);
}

}  // namespace plumbline::rigid_tests
