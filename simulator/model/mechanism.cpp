#include "simulator/model/mechanism.h"

#include <Simbody.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "simulator/model/engine.h"
#include "simulator/model/rigid_part.h"
#include "simulator/model/tree_dynamics.h"

namespace plumbline::model {
namespace {

Engine chosen = Engine::tree;

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

/// Simbody takes none that no body has (a URDF may state one): then the same with all three principal moments
/// larger by as much as they lack.
Eigen::Matrix3d possible(const Eigen::Matrix3d& inertia) {
  const Eigen::Vector3d p = principal_moments(inertia);
  const double lacking = std::max(-p[0], p[2] - p[0] - p[1]);
  const double rounding = SimTK::SignificantReal * std::max(1.0, p.sum());  // Simbody's own
  return lacking <= rounding ? inertia : inertia + lacking * Eigen::Matrix3d::Identity();
}

/// Simbody takes the inertia about the body origin.
SimTK::MassProperties mass_properties(const Body& body) {
  const Eigen::Matrix3d I = possible(body.inertia);
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

void set_engine(Engine engine) { chosen = engine; }

// Simbody holds the tree, checks it and gives its energy. Poses, mass matrix and bias are TreeDynamics':
// Simbody's own operators cost one pass over the tree for each column, and its kinematics as much as all the
// rest here.
struct Mechanism::Impl {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  SimTK::State state;
  Eigen::Vector3d gravity;
  std::vector<int> coordinate_of_joint;
  std::vector<SimTK::MobilizedBodyIndex> moving;
  std::vector<TreeBody> bodies;
  std::vector<int> tree_index;  // of each body of the skeleton
  int size = 0;
  std::unique_ptr<TreeDynamics> tree;

  explicit Impl(const Skeleton& skeleton) : gravity(skeleton.gravity) {
    build(skeleton);
    system.realizeTopology();
    state = system.getDefaultState();
    system.realizeModel(state);
    system.realize(state, SimTK::Stage::Instance);
    tree = std::make_unique<TreeDynamics>(bodies, size, gravity);
  }

  void build(const Skeleton& skeleton) {
    // Bodies fixed to the world need no mobilizer: they only carry a pose.
    std::vector<SimTK::MobilizedBodyIndex> index(skeleton.bodies.size());
    std::vector<Eigen::Isometry3d> on_index(skeleton.bodies.size(), Eigen::Isometry3d::Identity());
    tree_index.assign(skeleton.bodies.size(), -1);
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
      tree_index[child] = static_cast<int>(moving.size());
      moving.push_back(index[child]);
      bodies.push_back(tree_body(skeleton.bodies[child], joint, X_PJ, on_world ? -1 : tree_index[parent],
                                 coordinate_of_joint[j]));
    }
  }

  static TreeBody tree_body(const Body& body, const Joint& joint, const Eigen::Isometry3d& X_PJ, int parent,
                            int coordinate) {
    TreeBody it;
    it.parent = parent;
    it.coordinate = coordinate;
    it.slides = joint.type == JointType::prismatic;
    it.axis = joint.X_CJ.linear() * joint.axis.normalized();
    it.arc = {joint.X_CJ.linear() * joint.arc.turn, joint.arc.straight};
    it.hinge = joint.X_CJ.translation();
    it.X_PB = X_PJ * joint.X_CJ.inverse();
    it.mass = body.mass;
    it.com = body.com;
    it.inertia = body.inertia;
    return it;
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
        if (joint.arc.is_bent()) {
          return add_arc(parent, rigid, joint, X_PJ);
        }
        return SimTK::MobilizedBody::Slider(parent, X_PF, rigid, X_BM).getMobilizedBodyIndex();
      case JointType::fixed:
        break;
    }
    return SimTK::MobilizedBody::Weld(parent, X_PF, rigid, X_BM).getMobilizedBodyIndex();
  }

  /// A pin about the arc's centre.
  static SimTK::MobilizedBodyIndex add_arc(SimTK::MobilizedBody& parent, const SimTK::Body::Rigid& rigid,
                                           const Joint& joint, const Eigen::Isometry3d& X_PJ) {
    const Eigen::Vector3d axis = joint.axis.normalized();
    Eigen::Isometry3d at_centre = Eigen::Isometry3d::Identity();
    at_centre.linear() =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), joint.arc.turn).toRotationMatrix();
    at_centre.translation() = centre_of(axis, joint.arc);
    Eigen::Isometry3d on_child = at_centre;
    on_child.translation() -= joint.arc.straight * axis;
    return SimTK::MobilizedBody::Pin(parent, to_simtk(X_PJ * at_centre), rigid,
                                     to_simtk(joint.X_CJ * on_child))
        .getMobilizedBodyIndex();
  }

  /// Of Simbody's coordinate over ours: a slide along an arc is a pin there.
  static double turn_of(const TreeBody& body) { return body.arc.is_bent() ? body.arc.turn.norm() : 1.0; }

  void set_state(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
    SimTK::Vector& Q = state.updQ();
    SimTK::Vector& U = state.updU();
    for (const TreeBody& body : bodies) {
      const int i = body.coordinate;
      if (i >= 0) {
        Q[i] = turn_of(body) * (q[i] - body.arc.straight);
        U[i] = turn_of(body) * v[i];
      }
    }
    const SimTK::Subsystem::Guts& guts = matter.getSubsystemGuts();
    guts.realizeSubsystemTime(state);
    guts.realizeSubsystemPosition(state);
    guts.realizeSubsystemVelocity(state);
  }

  /// M and h by Simbody's operators: h is the force that leaves all accelerations at zero under gravity.
  void ask_simbody(Eigen::MatrixXd& M, Eigen::VectorXd& h) {
    if (h.size() == 0) {
      return;  // Simbody's operators read the first element of an empty vector
    }
    SimTK::Matrix mass;
    matter.calcM(state, mass);
    SimTK::Vector_<SimTK::SpatialVec> weights(matter.getNumBodies(), SimTK::SpatialVec(SimTK::Vec3(0)));
    for (std::size_t b = 0; b < moving.size(); ++b) {
      const SimTK::MobilizedBody& body = matter.getMobilizedBody(moving[b]);
      const SimTK::Vec3 arm = body.expressVectorInGroundFrame(state, to_simtk(bodies[b].com));
      const SimTK::Vec3 weight = bodies[b].mass * to_simtk(gravity);
      weights[moving[b]] = SimTK::SpatialVec(arm % weight, weight);
    }
    SimTK::Vector residual;
    matter.calcResidualForceIgnoringConstraints(state, SimTK::Vector(), weights, SimTK::Vector(), residual);
    for (const TreeBody& row : bodies) {
      for (const TreeBody& column : bodies) {
        if (row.coordinate >= 0 && column.coordinate >= 0) {
          M(row.coordinate, column.coordinate) =
              turn_of(row) * turn_of(column) * mass(row.coordinate, column.coordinate);
        }
      }
      if (row.coordinate >= 0) {
        h[row.coordinate] = turn_of(row) * residual[row.coordinate];
      }
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

int Mechanism::tree_body(int body) const { return impl_->tree_index[static_cast<std::size_t>(body)]; }

const TreeDynamics& Mechanism::tree() const { return *impl_->tree; }

void Mechanism::evaluate(const Eigen::VectorXd& q, const Eigen::VectorXd& v, Eigen::MatrixXd& M,
                         Eigen::VectorXd& h) {
  Impl& d = *impl_;
  if (!q.allFinite()) {  // an integrator that has gone astray wants to be told by the rates
    M.setConstant(d.size, d.size, std::numeric_limits<double>::quiet_NaN());
    h.setConstant(d.size, std::numeric_limits<double>::quiet_NaN());
    return;
  }
  d.tree->place(q);
  d.tree->assemble(v, M, h);
  if (chosen == Engine::simbody) {  // the tree has the poses and velocities that feet ask for
    d.set_state(q, v);
    d.ask_simbody(M, h);
  }
}

double Mechanism::energy(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  Impl& d = *impl_;
  d.set_state(q, v);
  double potential = 0.0;
  for (std::size_t b = 0; b < d.moving.size(); ++b) {
    const SimTK::MobilizedBody& body = d.matter.getMobilizedBody(d.moving[b]);
    const SimTK::Vec3 com = body.findStationLocationInGround(d.state, to_simtk(d.bodies[b].com));
    potential -= d.bodies[b].mass * d.gravity.dot(Eigen::Vector3d(com[0], com[1], com[2]));
  }
  return d.matter.calcKineticEnergy(d.state) + potential;
}

}  // namespace plumbline::model
