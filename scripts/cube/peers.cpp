// The tossed cube in MuJoCo and in Bullet: contact parameters searched on the train tosses, the held-out ones
// predicted. peers.sh builds and runs it. Both begin where the samples before the first touchdown say:
// straight lines under gravity and a constant angular velocity, by least squares.
//
//   peers mujoco|bullet DATA EVALUATIONS OUT
//
// writes OUT/toss_NNN.csv of the held-out tosses (t, x, y, z, quaternion w x y z) and the parameters it ended
// at.
#include <btBulletDynamicsCommon.h>
#include <mujoco/mujoco.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kSide = 0.1048;      // m
constexpr double kMass = 0.37;        // kg
constexpr double kGravity = 9.80665;  // m/s^2
constexpr int kTrain = 60;

struct Pose {
  Vector3d p;
  Quaterniond q;
};

struct Start {
  Pose pose;
  Vector3d v, w;  // in the world's axes
};

struct Toss {
  std::string name;
  std::vector<double> t;
  std::vector<Pose> poses;
  Start start;
};

double lowest_corner(const Pose& pose) {
  const Matrix3d R = pose.q.toRotationMatrix();
  return pose.p.z() - 0.5 * kSide * R.row(2).cwiseAbs().sum();
}

Vector3d rotation_vector(const Quaterniond& q) {
  const Eigen::AngleAxisd turn(q.w() < 0.0 ? Quaterniond(-q.w(), -q.x(), -q.y(), -q.z()) : q);
  return turn.angle() * turn.axis();
}

Start start_of(const Toss& toss) {
  std::size_t n = 0;
  while (n < toss.t.size() && lowest_corner(toss.poses[n]) > 0.0) {
    ++n;
  }
  n = std::max<std::size_t>(n, 5);
  const Quaterniond q0 = toss.poses.front().q;
  Eigen::MatrixXd A(static_cast<Eigen::Index>(n), 2), P(A.rows(), 3), R(A.rows(), 3);
  for (std::size_t k = 0; k < n; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const double t = toss.t[k] - toss.t.front();
    A.row(i) << 1.0, t;
    P.row(i) = (toss.poses[k].p + 0.5 * kGravity * t * t * Vector3d::UnitZ()).transpose();
    R.row(i) =
        rotation_vector(toss.poses[k].q * q0.inverse()).transpose();  // a cube's angular velocity stays
  }
  const auto solve = A.colPivHouseholderQr();
  const Eigen::MatrixXd p = solve.solve(P), r = solve.solve(R);
  const Vector3d turn = r.row(0).transpose();
  const double angle = turn.norm();
  const Quaterniond offset(
      Eigen::AngleAxisd(angle, angle > 0.0 ? Vector3d(turn / angle) : Vector3d::UnitX()));
  return {{p.row(0).transpose(), offset * q0}, p.row(1).transpose(), r.row(1).transpose()};
}

std::vector<Toss> read(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename().string().rfind("toss_", 0) == 0) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  std::vector<Toss> all;
  for (const auto& file : files) {
    Toss toss;
    toss.name = file.stem().string();
    std::ifstream in(file);
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
      std::replace(line.begin(), line.end(), ',', ' ');
      std::istringstream words(line);
      double t, x, y, z, w, i, j, k;
      words >> t >> x >> y >> z >> w >> i >> j >> k;
      toss.t.push_back(t);
      toss.poses.push_back({{x, y, z}, Quaterniond(w, i, j, k).normalized()});
    }
    toss.start = start_of(toss);
    all.push_back(std::move(toss));
  }
  return all;
}

/// What is searched, in the logarithm, but for the last: the table's height, m.
using Simulator = std::function<std::vector<Pose>(const Toss&, const VectorXd&)>;

// Stiffness and damping of the contact constraint (solref in its direct form), friction; height. MuJoCo's
// cone is elliptic, as its manual asks for where friction matters.
class Mujoco {
 public:
  Mujoco() {
    std::ostringstream xml;
    xml << "<mujoco><option timestep='0.0002' gravity='0 0 -" << kGravity
        << "' cone='elliptic' solver='Newton' iterations='50'/><worldbody><geom name='table' type='plane' "
           "size='5 5 1'/>"
        << "<body><freejoint/><geom name='cube' type='box' size='" << 0.5 * kSide << " " << 0.5 * kSide << " "
        << 0.5 * kSide << "' mass='" << kMass << "'/></body></worldbody></mujoco>";
    mjVFS files;
    mj_defaultVFS(&files);
    const std::string text = xml.str();
    mj_makeEmptyFileVFS(&files, "cube.xml", static_cast<int>(text.size()));
    std::copy(text.begin(), text.end(), static_cast<char*>(files.filedata[0]));
    char error[500] = "";
    model_ = mj_loadXML("cube.xml", &files, error, sizeof error);
    mj_deleteVFS(&files);
    if (model_ == nullptr) {
      throw std::runtime_error(error);
    }
    data_ = mj_makeData(model_);
  }
  ~Mujoco() {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }
  Mujoco(const Mujoco&) = delete;
  Mujoco& operator=(const Mujoco&) = delete;

  static VectorXd first() {
    return (VectorXd(4) << std::log(3000.0), std::log(50.0), std::log(0.2), 0.0).finished();
  }

  std::vector<Pose> run(const Toss& toss, const VectorXd& p) {
    for (int g = 0; g < 2; ++g) {
      model_->geom_solref[mjNREF * g] = -std::exp(p[0]);
      model_->geom_solref[mjNREF * g + 1] = -std::exp(p[1]);
      model_->geom_friction[3 * g] = std::exp(p[2]);
    }
    model_->geom_pos[2] = p[3];
    mj_resetData(model_, data_);
    const Start& start = toss.start;
    const Vector3d w = start.pose.q.inverse() * start.w;  // the free joint's is in the body's axes
    for (int i = 0; i < 3; ++i) {
      data_->qpos[i] = start.pose.p[i];
      data_->qvel[i] = start.v[i];
      data_->qvel[3 + i] = w[i];
    }
    const double q[4] = {start.pose.q.w(), start.pose.q.x(), start.pose.q.y(), start.pose.q.z()};
    std::copy(q, q + 4, data_->qpos + 3);
    std::vector<Pose> poses;
    for (const double t : toss.t) {
      while (data_->time < t - toss.t.front() - 0.5 * model_->opt.timestep) {
        mj_step(model_, data_);
      }
      const double* x = data_->qpos;
      poses.push_back({{x[0], x[1], x[2]}, Quaterniond(x[3], x[4], x[5], x[6])});
    }
    return poses;
  }

 private:
  mjModel* model_ = nullptr;
  mjData* data_ = nullptr;
};

// Contact stiffness and damping, friction; height.
class Bullet {
 public:
  static VectorXd first() {
    return (VectorXd(4) << std::log(3000.0), std::log(20.0), std::log(0.2), 0.0).finished();
  }

  static std::vector<Pose> run(const Toss& toss, const VectorXd& p) {
    constexpr double kScale = 10.0;  // Bullet's margins are made for bodies of a metre: lengths in decimetres
    constexpr double kStep = 1.0 / 2000.0;
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
    world.setGravity(btVector3(0, 0, btScalar(-kGravity * kScale)));
    world.getSolverInfo().m_numIterations = 50;
    btStaticPlaneShape table_shape(btVector3(0, 0, 1), btScalar(p[3] * kScale));
    btBoxShape cube_shape(btVector3(1, 1, 1) * btScalar(0.5 * kSide * kScale));
    btRigidBody table(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &table_shape));
    const double inertia = kMass * kSide * kSide / 6.0 * kScale * kScale;
    btRigidBody cube(btRigidBody::btRigidBodyConstructionInfo(btScalar(kMass), nullptr, &cube_shape,
                                                              btVector3(1, 1, 1) * btScalar(inertia)));
    for (btRigidBody* body : {&table, &cube}) {
      body->setContactStiffnessAndDamping(btScalar(std::exp(p[0])), btScalar(std::exp(p[1])));
      body->setFriction(btScalar(std::sqrt(std::exp(p[2]))));  // Bullet multiplies the two
    }
    const Start& start = toss.start;
    const auto vector = [](const Vector3d& v) {
      return btVector3(btScalar(v.x()), btScalar(v.y()), btScalar(v.z()));
    };
    const Quaterniond& q = start.pose.q;
    cube.setWorldTransform(
        btTransform(btQuaternion(btScalar(q.x()), btScalar(q.y()), btScalar(q.z()), btScalar(q.w())),
                    vector(kScale * start.pose.p)));
    cube.setLinearVelocity(vector(kScale * start.v));
    cube.setAngularVelocity(vector(start.w));
    cube.setActivationState(DISABLE_DEACTIVATION);
    world.addRigidBody(&table);
    world.addRigidBody(&cube);
    std::vector<Pose> poses;
    long steps = 0;
    for (const double t : toss.t) {
      for (; static_cast<double>(steps) * kStep < t - toss.t.front() - 0.5 * kStep; ++steps) {
        world.stepSimulation(btScalar(kStep), 0);
      }
      const btTransform& X = cube.getWorldTransform();
      const btVector3 o = X.getOrigin() / btScalar(kScale);
      const btQuaternion r = X.getRotation();
      poses.push_back({{o.x(), o.y(), o.z()}, Quaterniond(r.w(), r.x(), r.y(), r.z())});
    }
    world.removeRigidBody(&cube);
    world.removeRigidBody(&table);
    return poses;
  }
};

/// Mean over the samples of (|p error| / side + angle / rad) of a toss: both as in the table, equally
/// weighted.
double error_of(const Toss& toss, const std::vector<Pose>& poses) {
  double sum = 0.0;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    sum += (poses[k].p - toss.poses[k].p).norm() / kSide + poses[k].q.angularDistance(toss.poses[k].q);
  }
  return std::isfinite(sum) ? sum / static_cast<double>(poses.size()) : 10.0;
}

double cost(const std::vector<Toss>& tosses, const Simulator& run, const VectorXd& p) {
  double sum = 0.0;
  for (int i = 0; i < kTrain; ++i) {
    sum += error_of(tosses[static_cast<std::size_t>(i)], run(tosses[static_cast<std::size_t>(i)], p));
  }
  return sum / kTrain;
}

/// A (1+1) evolution strategy with the one-fifth rule (Rechenberg 1973): slow, and without anything to tune.
VectorXd searched(const std::vector<Toss>& tosses, const Simulator& run, VectorXd best, int evaluations) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const VectorXd units = (VectorXd(4) << 1.0, 1.0, 0.5, 1e-3).finished();
  double width = 0.7;
  double least = cost(tosses, run, best);
  for (int i = 1; i < evaluations; ++i) {
    VectorXd p = best;
    for (Eigen::Index k = 0; k < p.size(); ++k) {
      p[k] += width * units[k] * normal(random);
    }
    const double here = cost(tosses, run, p);
    const bool better = here < least;
    width *= better ? 1.5 : std::pow(1.5, -0.25);
    if (better) {
      best = p;
      least = here;
    }
  }
  std::printf("train error %.4f (side + rad) at %.5g, %.5g, %.4g, height %.3g mm\n", least, std::exp(best[0]),
              std::exp(best[1]), std::exp(best[2]), 1e3 * best[3]);
  return best;
}

void write(const std::string& file, const Toss& toss, const std::vector<Pose>& poses) {
  std::ofstream out(file);
  out << "t,x,y,z,qw,qx,qy,qz\n";
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Pose& at = poses[k];
    out << toss.t[k] << ',' << at.p.x() << ',' << at.p.y() << ',' << at.p.z() << ',' << at.q.w() << ','
        << at.q.x() << ',' << at.q.y() << ',' << at.q.z() << '\n';
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "peers mujoco|bullet DATA EVALUATIONS OUT\n";
    return 2;
  }
  const std::vector<Toss> tosses = read(argv[2]);
  if (tosses.size() <= kTrain) {
    std::cerr << argv[2] << ": found " << tosses.size() << " tosses, expected more than " << kTrain << "\n";
    return 2;
  }
  Mujoco mujoco;
  const bool in_bullet = std::string(argv[1]) == "bullet";
  const Simulator run = [&](const Toss& toss, const VectorXd& p) {
    return in_bullet ? Bullet::run(toss, p) : mujoco.run(toss, p);
  };
  const VectorXd p = searched(tosses, run, in_bullet ? Bullet::first() : Mujoco::first(), std::stoi(argv[3]));
  std::filesystem::create_directories(argv[4]);
  for (std::size_t i = kTrain; i < tosses.size(); ++i) {
    write(std::string(argv[4]) + "/" + tosses[i].name + ".csv", tosses[i], run(tosses[i], p));
  }
  return 0;
}
