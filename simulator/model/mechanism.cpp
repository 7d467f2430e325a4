#include "simulator/model/mechanism.h"

#include <Simbody.h>

#include <cmath>
#include <stdexcept>

namespace plumbline::model {
namespace {

SimTK::Vec3 to_simtk(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

SimTK::Transform to_simtk(const Eigen::Isometry3d& X) {
  SimTK::Mat33 R;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      R(i, j) = X.linear()(i, j);
    }
  }
  return {SimTK::Rotation(R), to_simtk(Eigen::Vector3d(X.translation()))};
}

/// Simbody takes the inertia about the body origin.
SimTK::MassProperties mass_properties(const Body& body) {
  const Eigen::Matrix3d& I = body.inertia;
  const SimTK::Inertia about_com(I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
  const SimTK::Vec3 com = to_simtk(body.com);
  return {body.mass, com, about_com.shiftFromMassCenter(com, body.mass)};
}

/// Rotation that lays the mobilizer's own axis (z of a pin, x of a slider) along the joint's axis.
Eigen::Isometry3d along_axis(const Joint& joint) {
  const Eigen::Vector3d own =
      joint.type == JointType::prismatic ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = Eigen::Quaterniond::FromTwoVectors(own, joint.axis.normalized()).toRotationMatrix();
  return X;
}

}  // namespace

struct Mechanism::Impl {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  SimTK::State state;
  SimTK::Vec3 gravity;
  std::vector<int> coordinate_of_joint;
  std::vector<SimTK::MobilizedBodyIndex> moving;
  std::vector<double> masses;
  std::vector<SimTK::Vec3> coms;
  int size = 0;
  SimTK::Vector no_udot, no_mobility_force, residual, direction, momentum;
  SimTK::Vector_<SimTK::SpatialVec> weights;

  explicit Impl(const Skeleton& skeleton) : gravity(to_simtk(skeleton.gravity)) {
    build(skeleton);
    system.realizeTopology();
    state = system.getDefaultState();
    system.realizeModel(state);
    system.realize(state, SimTK::Stage::Instance);
    no_udot.resize(size);
    no_udot = 0;
    no_mobility_force = no_udot;
    direction = no_udot;
    weights.resize(matter.getNumBodies());
    weights = SimTK::SpatialVec(SimTK::Vec3(0), SimTK::Vec3(0));
  }

  void build(const Skeleton& skeleton) {
    // Bodies fixed to the world need no mobilizer: they only carry a pose.
    std::vector<SimTK::MobilizedBodyIndex> index(skeleton.bodies.size());
    std::vector<Eigen::Isometry3d> on_index(skeleton.bodies.size(), Eigen::Isometry3d::Identity());
    coordinate_of_joint.assign(skeleton.joints.size(), -1);
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
      const Joint& joint = skeleton.joints[j];
      const auto child = static_cast<std::size_t>(joint.child);
      const bool on_world = joint.parent < 0;
      const auto parent = static_cast<std::size_t>(on_world ? 0 : joint.parent);
      const SimTK::MobilizedBodyIndex base = on_world ? SimTK::GroundIndex : index[parent];
      const Eigen::Isometry3d X_base = on_world ? Eigen::Isometry3d::Identity() : on_index[parent];
      const Eigen::Isometry3d X_PJ = X_base * joint.X_PJ;
      if (joint.type == JointType::fixed && base == SimTK::GroundIndex) {
        index[child] = base;
        on_index[child] = X_PJ * joint.X_CJ.inverse();
        continue;
      }
      index[child] = add_mobilizer(skeleton.bodies[child], joint, base, X_PJ);
      if (joint.type != JointType::fixed) {
        coordinate_of_joint[j] = size++;
      }
      moving.push_back(index[child]);
      masses.push_back(skeleton.bodies[child].mass);
      coms.push_back(to_simtk(skeleton.bodies[child].com));
    }
  }

  SimTK::MobilizedBodyIndex add_mobilizer(const Body& body, const Joint& joint,
                                          SimTK::MobilizedBodyIndex base, const Eigen::Isometry3d& X_PJ) {
    const SimTK::Body::Rigid rigid(mass_properties(body));
    SimTK::MobilizedBody& parent = matter.updMobilizedBody(base);
    const SimTK::Transform X_PF = to_simtk(X_PJ * along_axis(joint));
    const SimTK::Transform X_BM = to_simtk(joint.X_CJ * along_axis(joint));
    switch (joint.type) {
      case JointType::revolute:
        return SimTK::MobilizedBody::Pin(parent, X_PF, rigid, X_BM).getMobilizedBodyIndex();
      case JointType::prismatic:
        return SimTK::MobilizedBody::Slider(parent, X_PF, rigid, X_BM).getMobilizedBodyIndex();
      case JointType::fixed:
        break;
    }
    return SimTK::MobilizedBody::Weld(parent, X_PF, rigid, X_BM).getMobilizedBodyIndex();
  }

  /// Only the matter subsystem is realised: the system's other parts (force caches) are not used here and
  /// would cost a fifth of the evaluation.
  void realize_velocity() {
    const SimTK::Subsystem::Guts& guts = matter.getSubsystemGuts();
    guts.realizeSubsystemTime(state);
    guts.realizeSubsystemPosition(state);
    guts.realizeSubsystemVelocity(state);
  }

  void set_state(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
    SimTK::Vector& Q = state.updQ();
    SimTK::Vector& U = state.updU();
    for (int i = 0; i < size; ++i) {
      Q[i] = q[i];
      U[i] = v[i];
    }
  }
};

Mechanism::Mechanism(const Skeleton& skeleton) {
  try {
    impl_ = std::make_unique<Impl>(skeleton);
  } catch (const SimTK::Exception::Base& error) {
    throw std::runtime_error(skeleton.file + ": Simbody refuses the skeleton: " + error.getMessageText());
  }
}
Mechanism::~Mechanism() = default;
Mechanism::Mechanism(Mechanism&&) noexcept = default;
Mechanism& Mechanism::operator=(Mechanism&&) noexcept = default;

int Mechanism::size() const { return impl_->size; }

int Mechanism::coordinate_of_joint(int joint) const {
  return impl_->coordinate_of_joint[static_cast<std::size_t>(joint)];
}

void Mechanism::evaluate(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::MatrixXd& S,
                         Eigen::MatrixXd& M_S, Eigen::VectorXd& h) {
  Impl& d = *impl_;
  d.set_state(q, v);
  d.realize_velocity();
  for (std::size_t b = 0; b < d.moving.size(); ++b) {
    const SimTK::MobilizedBody& body = d.matter.getMobilizedBody(d.moving[b]);
    const SimTK::Vec3 weight = d.masses[b] * d.gravity;
    const SimTK::Vec3 arm = body.getBodyRotation(d.state) * d.coms[b];
    d.weights[d.moving[b]] = SimTK::SpatialVec(arm % weight, weight);
  }
  d.matter.calcResidualForceIgnoringConstraints(d.state, d.no_mobility_force, d.weights, d.no_udot,
                                                d.residual);
  h.resize(d.size);
  for (int i = 0; i < d.size; ++i) {
    h[i] = d.residual[i];
  }
  M_S.resize(S.cols(), S.cols());
  for (Eigen::Index c = 0; c < S.cols(); ++c) {
    for (int i = 0; i < d.size; ++i) {
      d.direction[i] = S(i, c);
    }
    d.matter.multiplyByM(d.state, d.direction, d.momentum);
    for (Eigen::Index r = 0; r < S.cols(); ++r) {
      double sum = 0.0;
      for (int i = 0; i < d.size; ++i) {
        sum += S(i, r) * d.momentum[i];
      }
      M_S(r, c) = sum;
    }
  }
}

double Mechanism::energy(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  Impl& d = *impl_;
  d.set_state(q, v);
  d.realize_velocity();
  double potential = 0.0;
  for (std::size_t b = 0; b < d.moving.size(); ++b) {
    const SimTK::MobilizedBody& body = d.matter.getMobilizedBody(d.moving[b]);
    potential -= d.masses[b] * SimTK::dot(d.gravity, body.findStationLocationInGround(d.state, d.coms[b]));
  }
  return d.matter.calcKineticEnergy(d.state) + potential;
}

}  // namespace plumbline::model
