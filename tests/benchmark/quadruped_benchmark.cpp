// One evaluation of a floating robot's accelerations, and a second of standing (standing.h): the plant with
// its feet in the ground, MuJoCo with the same feet on its plane, Simbody without a ground.
// `quadruped_benchmark unitree_go2/go2.xml`: no copy of a foreign model is kept here.
//
// The three take turns, so that whatever else the machine does falls on all; the best of many rounds counts.
// Before, all three must agree to 1e-9 without contact. Left out of all: armature, damping, dry friction,
// limits, actuators.
#include <Simbody.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <stdexcept>
#include <vector>

#include "simulator/model/known_effects.h"
#include "simulator/model/plant.h"
#include "simulator/model/robot_file.h"
#include "tests/benchmark/standing.h"
#include "tests/model/mujoco_peer.h"

namespace plumbline::benchmarks {
namespace {

using Eigen::Vector3d;

constexpr int kStates = 64;
constexpr int kRounds = 400;
constexpr double kDepth = 1e-3;  // m: of the lowest foot in the ground

/// The file without meshes, on a plane.
std::string on_plane(const std::string& file, const std::filesystem::path& folder) {
  tinyxml2::XMLDocument document;
  if (document.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS) {
    throw std::runtime_error(file + " cannot be read");
  }
  tinyxml2::XMLElement& root = *document.RootElement();
  test::take_away_meshes(root);
  tinyxml2::XMLElement* plane = root.FirstChildElement("worldbody")->InsertNewChildElement("geom");
  plane->SetAttribute("type", "plane");
  plane->SetAttribute("size", "5 5 0.1");
  const std::string to = (folder / "robot.xml").string();
  document.SaveFile(to.c_str());
  return to;
}

model::Model read(const std::filesystem::path& folder) {
  std::ofstream(folder / "model.yaml")
      << "plumbline: model/1\nrobot: r\nskeleton: robot.xml\nfeet: take\neffects:\n"
         "  - effect: ground_normal\n    at: feet\n    values:\n"
         "      stiffness: {value: 2e5, unit: N, assumed: benchmark}\n"
         "      damping: {value: 1e5, unit: N s/m, assumed: benchmark}\n"
         "  - effect: ground_friction\n    at: feet\n    values:\n"
         "      bristle_stiffness: {value: 2000, unit: 1/m, assumed: benchmark}\n"
         "      bristle_damping: {value: 1, unit: s/m, assumed: benchmark}\n"
         "      friction: {value: 0.8, unit: '1', assumed: benchmark}\n";
  return model::read_model((folder / "model.yaml").string(), model::known_effects());
}

SimTK::Vec3 vec(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

SimTK::Transform transform(const Eigen::Isometry3d& X) {
  SimTK::Mat33 m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      m(i, j) = X.linear()(i, j);
    }
  }
  return {SimTK::Rotation(m), vec(Vector3d(X.translation()))};
}

/// Simbody's own mobilizers: Free for the base, Pin for the legs.
class SimbodyPeer {
 public:
  explicit SimbodyPeer(const model::Skeleton& skeleton) : gravity_(forces_, matter_, vec(skeleton.gravity)) {
    for (const model::Joint& joint : skeleton.joints) {
      const model::Body& body = skeleton.bodies[static_cast<std::size_t>(joint.child)];
      if (joint.floats && body.is_between) {
        links_.emplace_back(SimTK::GroundIndex);
        continue;
      }
      const Eigen::Matrix3d& I = body.inertia;
      const SimTK::Inertia central(I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
      const SimTK::Body::Rigid rigid(SimTK::MassProperties(
          body.mass, vec(body.com), central.shiftFromMassCenter(vec(body.com), body.mass)));
      if (joint.floats) {
        links_.push_back(SimTK::MobilizedBody::Free(matter_.updGround(), rigid).getMobilizedBodyIndex());
        continue;
      }
      if (joint.type != model::JointType::revolute) {
        throw std::runtime_error("the benchmark knows a floating base and hinges");
      }
      const SimTK::Transform about(SimTK::Rotation(SimTK::UnitVec3(vec(joint.axis)), SimTK::ZAxis));
      SimTK::MobilizedBody& parent = matter_.updMobilizedBody(links_[static_cast<std::size_t>(joint.parent)]);
      links_.push_back(SimTK::MobilizedBody::Pin(parent, transform(joint.X_PJ) * about, rigid,
                                                 transform(joint.X_CJ) * about)
                           .getMobilizedBodyIndex());
    }
    state_ = system_.realizeTopology();
  }

  /// Of the joints behind the base; positions and rates in the chart's six coordinates and the hinges.
  Eigen::VectorXd accelerations(const Eigen::VectorXd& x) {
    const Eigen::Index n = state_.getNU();  // behind both n stand the bristles of the feet
    const Eigen::Matrix3d R = test::rotation_of(x.segment<3>(3));
    const Eigen::Quaterniond turn(R);
    const Vector3d w = R * test::rates_map(x.segment<3>(3)) * x.segment<3>(n + 3);  // in the world
    const double q[7] = {turn.w(), turn.x(), turn.y(), turn.z(), x[0], x[1], x[2]};
    for (int i = 0; i < 7; ++i) {
      state_.updQ()[i] = q[i];
    }
    for (int i = 0; i < 3; ++i) {
      state_.updU()[i] = w[i];
      state_.updU()[3 + i] = x[n + i];
    }
    for (Eigen::Index i = 6; i < n; ++i) {
      state_.updQ()[static_cast<int>(i) + 1] = x[i];
      state_.updU()[static_cast<int>(i)] = x[n + i];
    }
    system_.realize(state_, SimTK::Stage::Acceleration);
    Eigen::VectorXd a(n - 6);
    for (Eigen::Index i = 6; i < n; ++i) {
      a[i - 6] = state_.getUDot()[static_cast<int>(i)];
    }
    return a;
  }

 private:
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_{system_};
  SimTK::GeneralForceSubsystem forces_{system_};
  SimTK::Force::UniformGravity gravity_;
  std::vector<SimTK::MobilizedBodyIndex> links_;
  SimTK::State state_;
};

/// With the contacts of its plane, without what is left out of all and without the energies.
void leave_out(const test::Mujoco& mujoco) {
  mujoco.m->opt.disableflags = mjDSBL_LIMIT | mjDSBL_FRICTIONLOSS | mjDSBL_PASSIVE | mjDSBL_ACTUATION;
  mujoco.m->opt.enableflags = 0;
  std::fill(mujoco.m->dof_armature, mujoco.m->dof_armature + mujoco.m->nv, 0.0);
}

void forward(const test::Mujoco& mujoco, const Eigen::VectorXd& x) {
  const Eigen::Index n = mujoco.m->nv;
  test::set_state(mujoco, x.head(n), x.segment(n, n));
  mj_forward(mujoco.m, mujoco.d);
}

double microseconds(const std::function<void(const Eigen::VectorXd&)>& evaluate,
                    const std::vector<Eigen::VectorXd>& states) {
  const auto start = std::chrono::steady_clock::now();
  for (const Eigen::VectorXd& x : states) {
    evaluate(x);
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  return 1e6 * taken.count() / static_cast<double>(states.size());
}

void run(const std::string& file) {
  const auto folder = std::filesystem::temp_directory_path() / "plumbline_quadruped";
  std::filesystem::create_directories(folder);
  const std::string bare = on_plane(file, folder);
  const model::Model model = read(folder);
  model::Plant plant(model, {});
  SimbodyPeer simbody(model.skeleton);
  const test::Mujoco mujoco(bare);
  leave_out(mujoco);
  const int n = plant.positions();
  if (n != mujoco.m->nv || n < 7 || mujoco.m->nkey < 1) {
    throw std::runtime_error("the benchmark wants a floating robot with a keyframe to stand in");
  }
  Eigen::VectorXd home = Eigen::VectorXd::Zero(plant.states());
  home[2] = 1.0;
  for (int i = 6; i < n; ++i) {
    home[i] = mujoco.m->key_qpos[i + 1];
  }
  double lowest = 1.0;
  for (const model::Touch& touch : plant.touches(home.data())) {
    lowest = std::min(lowest, -touch.depth);
  }
  std::mt19937 random(3);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  std::vector<Eigen::VectorXd> standing(kStates, home), flying(kStates, home);
  double worst = 0.0;
  int contacts = 0, feet = 0;
  for (int k = 0; k < kStates; ++k) {
    Eigen::VectorXd& x = standing[static_cast<std::size_t>(k)];
    x[2] += -lowest - kDepth;
    for (int i = 0; i < n; ++i) {
      x[i] += i < 2 || i > 5 ? 1e-4 * draw(random) : 0.0;
      x[n + i] = 0.01 * draw(random);
    }
    Eigen::VectorXd& free = flying[static_cast<std::size_t>(k)];
    for (int i = 0; i < 2 * n; ++i) {
      free[i] += draw(random);
    }
    free[2] = 3.0;
    Eigen::VectorXd xdot(plant.states());
    plant.rate(free.data(), nullptr, xdot.data());
    forward(mujoco, free);
    const Eigen::VectorXd ours = xdot.segment(n + 6, n - 6);
    const Eigen::Map<const Eigen::VectorXd> theirs(mujoco.d->qacc + 6, n - 6);
    const double size = 1.0 + theirs.cwiseAbs().maxCoeff();
    if (mujoco.d->ncon == 0) {
      worst = std::max(worst, (ours - theirs).cwiseAbs().maxCoeff() / size);
    }
    worst = std::max(worst, (ours - simbody.accelerations(free)).cwiseAbs().maxCoeff() / size);
    forward(mujoco, x);
    contacts = std::max(contacts, mujoco.d->ncon);
    int pressed = 0;
    for (const model::Touch& touch : plant.touches(x.data())) {
      pressed += touch.depth > 0.0 ? 1 : 0;
    }
    feet = std::max(feet, pressed);
  }
  std::printf("%d degrees of freedom; largest difference of accelerations in the air %.1e (relative)\n", n,
              worst);
  if (!(worst < 1e-9)) {
    throw std::runtime_error("the three do not agree: nothing is timed");
  }
  Eigen::VectorXd xdot(plant.states());
  double ours = 1e9, theirs = 1e9, simbodys = 1e9, in_air = 1e9, mujoco_air = 1e9;
  for (int round = 0; round < kRounds; ++round) {
    const auto rate = [&](const Eigen::VectorXd& x) { plant.rate(x.data(), nullptr, xdot.data()); };
    const auto mj = [&](const Eigen::VectorXd& x) { forward(mujoco, x); };
    ours = std::min(ours, microseconds(rate, standing));
    theirs = std::min(theirs, microseconds(mj, standing));
    in_air = std::min(in_air, microseconds(rate, flying));
    mujoco_air = std::min(mujoco_air, microseconds(mj, flying));
    simbodys =
        std::min(simbodys, microseconds([&](const Eigen::VectorXd& x) { simbody.accelerations(x); }, flying));
  }
  std::printf("| evaluation | microseconds |\n| --- | --- |\n");
  std::printf("| plant, %d feet in the ground | %.1f |\n", feet, ours);
  std::printf("| MuJoCo %s, %d contacts | %.1f |\n", mj_versionString(), contacts, theirs);
  std::printf("| plant, in the air | %.1f |\n", in_air);
  std::printf("| MuJoCo, in the air | %.1f |\n", mujoco_air);
  std::printf("| Simbody, in the air | %.1f |\n", simbodys);
  time_standing(folder, model.skeleton, mujoco);
}

}  // namespace
}  // namespace plumbline::benchmarks

int main(int argc, char** argv) {
  if (argc != 2) {
    std::printf(
        "quadruped_benchmark FILE.xml: a floating robot in MJCF, such as unitree_go2/go2.xml of "
        "mujoco_menagerie\n");
    return 2;
  }
  try {
    plumbline::benchmarks::run(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "quadruped_benchmark: %s\n", error.what());
    return 1;
  }
  return 0;
}
