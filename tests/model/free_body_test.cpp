// Free bodies against closed forms: a parabola, a symmetric top, what a tree without forces keeps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/body_poses.h"
#include "simulator/model/joint_chain.h"
#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/run/commanded_run.h"
#include "simulator/run/start.h"
#include "simulator/trace/error.h"
#include "tests/model/floating_states.h"
#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::model {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

/// A body with that centre of mass and those moments, beside links as the text says.
std::string urdf(const std::string& com, const Vector3d& moments, const std::string& more = "") {
  return "<robot name='body'><link name='trunk'><inertial><origin xyz='" + com +
         "'/><mass value='2'/><inertia ixx='" + std::to_string(moments[0]) + "' iyy='" +
         std::to_string(moments[1]) + "' izz='" + std::to_string(moments[2]) +
         "' ixy='0' ixz='0' iyz='0'/></inertial></link>" + more + "</robot>";
}

/// Two links that hang on the trunk, one behind the other.
const char* const kArm = R"(
<link name='upper'><inertial><origin xyz='0.1 0 -0.2'/><mass value='0.7'/>
  <inertia ixx='0.02' iyy='0.02' izz='0.01' ixy='0' ixz='0' iyz='0'/></inertial></link>
<link name='lower'><inertial><origin xyz='0 0.05 -0.2'/><mass value='0.4'/>
  <inertia ixx='0.01' iyy='0.012' izz='0.005' ixy='0' ixz='0' iyz='0'/></inertial></link>
<joint name='hip' type='continuous'><parent link='trunk'/><child link='upper'/><origin xyz='0.2 0.1 0'/><axis xyz='0 1 0'/></joint>
<joint name='knee' type='continuous'><parent link='upper'/><child link='lower'/><origin xyz='0 0 -0.4'/><axis xyz='1 0 0'/></joint>)";

class FreeBody : public testing::Test {
 protected:
  Model model(const std::string& skeleton, double gravity) const {
    folder_.write("body.urdf", skeleton);
    return read_model(
        folder_.write("model.yaml",
                      "plumbline: model/1\nrobot: body\nskeleton: body.urdf\nfloating_base: true\n"
                      "gravity: {value: " +
                          std::to_string(gravity) + ", unit: m/s^2, assumed: test}\n"),
        known_effects());
  }

  static Eigen::VectorXd after(Plant& plant, const Eigen::VectorXd& x0, double seconds) {
    run::CommandedOptions options;
    options.integrator.relative_tolerance = 1e-11;
    options.integrator.absolute_tolerance = Eigen::VectorXd::Constant(1, 1e-12);
    options.energy = false;
    constexpr double kPeriod = 0.01;
    const auto samples = static_cast<Eigen::Index>(std::lround(seconds / kPeriod)) + 1;
    return run::run_commands(plant, x0, Eigen::MatrixXd::Zero(0, samples), kPeriod, 0.0, {}, nullptr, options)
        .states.col(samples - 1);
  }

  /// Positions and rates of a free body with that orientation and angular velocity (world's axes).
  static Eigen::VectorXd state(const Vector3d& p, const Vector3d& v, const Eigen::Matrix3d& R,
                               const Vector3d& w) {
    Eigen::VectorXd x(12);
    const Vector3d angles = test::angles_of(R);
    x << p, angles, v, test::rates_map(angles).inverse() * (R.transpose() * w);
    return x;
  }

  test::TemporaryFolder folder_;
};

TEST_F(FreeBody, HasCoordinatesOfStandardNames) {
  const Model free = model(urdf("0 0 0", {0.1, 0.2, 0.25}, kArm), 9.81);
  Plant plant(free, {});
  ASSERT_EQ(plant.positions(), 8);
  const char* const names[] = {"base_x",     "base_y",    "base_z", "base_yaw",
                               "base_pitch", "base_roll", "hip",    "knee"};
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(plant.state_names()[static_cast<std::size_t>(i)], std::string("position of ") + names[i]);
  }
  EXPECT_EQ(free.places(effects::Place::body), (std::vector<std::string>{"trunk", "upper", "lower"}));
}

// The centre of mass of a thrown body that tumbles: p + v t + g t^2/2.
TEST_F(FreeBody, ThrownFliesAlongAParabola) {
  const Vector3d com(0.1, -0.05, 0.2);
  Plant plant(model(urdf("0.1 -0.05 0.2", {0.1, 0.2, 0.25}), 9.81), {});
  const Eigen::Matrix3d R0 = test::rotation_of({0.3, -0.2, 0.5});
  const Vector3d w(0.4, 0.2, 5.0), p(1.0, 2.0, 3.0), v(2.0, -1.0, 4.0);
  const Eigen::VectorXd end = after(plant, state(p, v, R0, w), 1.2);
  const Vector3d begin = p + R0 * com;
  const Vector3d speed = v + w.cross(R0 * com);
  const Vector3d expected = begin + 1.2 * speed - 0.5 * 9.81 * 1.44 * Vector3d::UnitZ();
  const Vector3d found = end.head<3>() + test::rotation_of(end.segment<3>(3)) * com;
  EXPECT_LT((found - expected).norm(), 1e-8);  // the integrator's tolerance over 120 samples
}

// Torque-free symmetric top: it precesses about its angular momentum L at L/A and turns about its own axis by
// L.e (1/C - 1/A) (Landau and Lifshitz, Mechanics, section 33).
TEST_F(FreeBody, ASymmetricTopPrecessesAsTheClosedForm) {
  constexpr double kA = 0.2, kC = 0.35, kSeconds = 3.0;
  Plant plant(model(urdf("0 0 0", {kA, kA, kC}), 0.0), {});
  const Eigen::Matrix3d R0 = test::rotation_of({0.4, 0.5, -0.3});
  const Vector3d L = 1.1 * Vector3d(0.1, -0.2, 1.0).normalized();
  const Vector3d in_body = R0.transpose() * L;
  const Vector3d w = R0 * Vector3d(in_body.x() / kA, in_body.y() / kA, in_body.z() / kC);
  const Eigen::VectorXd end = after(plant, state({0, 0, 0}, {0, 0, 0}, R0, w), kSeconds);
  const double precession = L.norm() / kA;
  const double spin = in_body.z() * (1.0 / kC - 1.0 / kA);
  const Eigen::Matrix3d expected =
      Eigen::AngleAxisd(precession * kSeconds, L.normalized()).toRotationMatrix() * R0 *
      Eigen::AngleAxisd(spin * kSeconds, Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_LT((test::rotation_of(end.segment<3>(3)) - expected).norm(), 1e-8);
}

/// Momentum and angular momentum about the origin, by differences of poses: no formula of the plant's.
Eigen::Matrix<double, 6, 1> momenta(Plant& plant, const Eigen::VectorXd& x) {
  constexpr double kStep = 1e-5;
  const Skeleton& skeleton = plant.model().skeleton;
  const Eigen::Index n = plant.positions();
  Eigen::VectorXd forth = x, back = x;
  forth.head(n) += kStep * x.segment(n, n);
  back.head(n) -= kStep * x.segment(n, n);
  const auto here = body_poses(skeleton, plant.joint_positions(x.data()));
  const auto later = body_poses(skeleton, plant.joint_positions(forth.data()));
  const auto before = body_poses(skeleton, plant.joint_positions(back.data()));
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (std::size_t b = 0; b < skeleton.bodies.size(); ++b) {
    const Body& body = skeleton.bodies[b];
    const Vector3d v = (later[b] * body.com - before[b] * body.com) / (2.0 * kStep);
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(later[b].linear() * before[b].linear().transpose()));
    const Vector3d w = turn.angle() * turn.axis() / (2.0 * kStep);
    const Eigen::Matrix3d R = here[b].linear();
    sum.head<3>() += body.mass * v;
    sum.tail<3>() += (here[b] * body.com).cross(body.mass * v) + R * body.inertia * R.transpose() * w;
  }
  return sum;
}

TEST_F(FreeBody, WithoutForcesATreeKeepsEnergyMomentumAndAngularMomentum) {
  Plant plant(model(urdf("0.02 0 0.1", {0.1, 0.2, 0.25}, kArm), 0.0), {});
  Eigen::VectorXd x(16);
  x << 0.3, -0.2, 1.0, 0.4, 0.3, -0.2, 0.5, -0.7, 0.2, 0.4, -0.1, 0.8, 0.3, -0.5, 1.5, -2.0;
  const Eigen::VectorXd end = after(plant, x, 1.5);
  ASSERT_GT((end - x).head(8).norm(), 1.0);
  EXPECT_NEAR(plant.energetics(end.data(), nullptr).stored, plant.energetics(x.data(), nullptr).stored, 1e-9);
  EXPECT_LT((momenta(plant, end) - momenta(plant, x)).cwiseAbs().maxCoeff(),
            1e-7);  // differences: 1e-10/1e-5
}

TEST_F(FreeBody, NearTheChartsSingularityIsRefusedInOneLine) {
  Plant plant(model(urdf("0 0 0", {0.1, 0.2, 0.25}), 9.81), {});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(12);
  Eigen::VectorXd rate(12);
  x[4] = std::acos(kLostCosineOfPitch) - 1e-6;
  plant.rate(x.data(), nullptr, rate.data());
  EXPECT_TRUE(rate.allFinite());
  x[4] += 2e-6;
  EXPECT_THAT([&] { plant.rate(x.data(), nullptr, rate.data()); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr(
                  "base_pitch: found a pitch of 1.57 rad, expected |cos(pitch)| of at least 0.001")));
  run::Start start;
  start.positions = {{"base_pitch", -1.57}};
  EXPECT_THAT(
      [&] { run::start_state(plant, start); },
      testing::ThrowsMessage<std::runtime_error>(HasSubstr("base_pitch: found a pitch of -1.57 rad")));
}

TEST_F(FreeBody, BadBasesAreRefusedInOneLine) {
  const auto refusal = [&](const std::string& line, const std::string& skeleton) {
    folder_.write("body.urdf", skeleton);
    const std::string file =
        folder_.write("bad.yaml", "plumbline: model/1\nrobot: body\nskeleton: body.urdf\n" + line + "\n");
    return test::refusal([&] { read_model(file, known_effects()); });
  };
  const std::string body = urdf("0 0 0", {0.1, 0.2, 0.25});
  EXPECT_THAT(refusal("floating_base: free", body), HasSubstr("bad.yaml:4: floating_base: found \"free\""));
  const std::string on_world = urdf(
      "0 0 0", {0.1, 0.2, 0.25},
      "<link name='world'/><joint name='rail' type='prismatic'><parent link='world'/><child link='trunk'/>"
      "<axis xyz='1 0 0'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint>");
  EXPECT_THAT(refusal("floating_base: true", on_world), HasSubstr("one root link that no joint leads to"));
  EXPECT_THAT(refusal("floating_base: true",
                      urdf("0 0 0", {0.1, 0.2, 0.25},
                           "<link name='arm'><inertial><mass value='1'/><inertia ixx='1' iyy='1' "
                           "izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link><joint name='base_x' "
                           "type='continuous'><parent link='trunk'/><child link='arm'/></joint>")),
              HasSubstr("base_x: found two joints of this name"));
}

}  // namespace
}  // namespace plumbline::model
