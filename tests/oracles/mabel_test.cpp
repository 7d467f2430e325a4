// robots/mabel against the hand-derived Lagrangian, whose numbers were typed from the paper independently.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "simulator/model/mechanism.h"
#include "simulator/model/plant.h"
#include "simulator/model/robot_file.h"
#include "tests/oracles/mabel_in_the_air.h"
#include "tests/oracles/mabel_lagrangian.h"

namespace plumbline::oracles {
namespace {

model::Model read(const std::string& name) { return mabel_in_the_air(name); }

model::Model with_rigid_cables(model::Model model) {
  const auto stretches = [](const model::EffectUse& use) {
    return use.law->declaration().name == "cable_stretch";
  };
  model.effects.erase(std::remove_if(model.effects.begin(), model.effects.end(), stretches),
                      model.effects.end());
  return model;
}

/// Names of the oracle's coordinates in the model, in the oracle's order.
const std::vector<std::string>& names() {
  static const std::vector<std::string> kNames{
      "hip_x",     "hip_z",     "torso",    "leg_angle_left",  "leg_shape_left",
      "mLA_left",  "mLS_left",  "bsp_left", "leg_angle_right", "leg_shape_right",
      "mLA_right", "mLS_right", "bsp_right"};
  return kNames;
}

/// The plant in the oracle's coordinates: oracle = map * independent ones.
class PlantInOracleCoordinates {
 public:
  explicit PlantInOracleCoordinates(const model::Model& model, std::vector<std::string> of = names())
      : plant_(model, {}), map_(static_cast<Eigen::Index>(of.size()), plant_.positions()) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(plant_.states());
    for (Eigen::Index i = 0; i < plant_.positions(); ++i) {
      x[i] = 1.0;
      for (Eigen::Index k = 0; k < map_.rows(); ++k) {
        map_(k, i) = plant_.position_of(of[static_cast<std::size_t>(k)], x.data());
      }
      x[i] = 0.0;
    }
    solver_.compute(map_);
  }
  int positions() const { return plant_.positions(); }
  Eigen::VectorXd accelerations(const MabelVector& q, const MabelVector& v, const Eigen::Vector4d& torques) {
    const Eigen::Index n = plant_.positions();
    Eigen::VectorXd x(plant_.states());
    Eigen::VectorXd rate(plant_.states());
    x.head(n) = solver_.solve(q);
    x.segment(n, n) = solver_.solve(v);
    const Eigen::Vector4d command = in_order_of_motors(torques);
    plant_.rate(x.data(), command.data(), rate.data());
    return map_ * rate.segment(n, n);
  }

 private:
  /// The oracle has left leg angle, left leg shape, then right.
  Eigen::Vector4d in_order_of_motors(const Eigen::Vector4d& torques) const {
    const std::vector<std::string> order{"mLA_left", "mLS_left", "mLA_right", "mLS_right"};
    Eigen::Vector4d command;
    for (int i = 0; i < 4; ++i) {
      command[plant_.model().motor_index(order[static_cast<std::size_t>(i)])] = torques[i];
    }
    return command;
  }
  model::Plant plant_;
  Eigen::MatrixXd map_;
  Eigen::FullPivLU<Eigen::MatrixXd> solver_;
};

struct State {
  MabelVector q, v;
  Eigen::Vector4d torques;
};

/// Springs deflected and against their stops, cables stretched by up to 100 deg at the motors.
State draw(std::mt19937& generator, bool stretch) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator);
  };
  State s;
  s.q << between(-2, 2), between(0.5, 1.5), between(-1, 1), between(-1, 1), between(-0.1, 1.2), 0, 0,
      between(-0.1, 0.4), between(-1, 1), between(-0.1, 1.2), 0, 0, between(-0.1, 0.4);
  s.v << between(-2, 2), between(-2, 2), between(-3, 3), between(-5, 5), between(-5, 5), 0, 0, between(-4, 4),
      between(-5, 5), between(-5, 5), 0, 0, between(-4, 4);
  s.q = mabel_without_stretch(s.q);
  s.v = mabel_without_stretch(s.v);
  for (const int motor : {kMotorAngleLeft, kMotorShapeLeft, kMotorAngleRight, kMotorShapeRight}) {
    const double give = between(-1.75, 1.75);
    const double rate = between(-50, 50);
    s.q[motor] += stretch ? give : 0.0;
    s.v[motor] += stretch ? rate : 0.0;
  }
  s.torques << between(-10, 10), between(-20, 20), between(-10, 10), between(-20, 20);
  return s;
}

/// Largest difference over the states, each coordinate relative to its root mean square.
double worst_difference(PlantInOracleCoordinates& plant, const MabelOptions& options, int states) {
  std::mt19937 generator(2011);
  Eigen::ArrayXd largest = Eigen::ArrayXd::Zero(kMabelCoordinates);
  Eigen::ArrayXd square = Eigen::ArrayXd::Zero(kMabelCoordinates);
  for (int i = 0; i < states; ++i) {
    const State s = draw(generator, options.cables_stretch);
    const MabelVector expected = mabel_accelerations(options, s.q, s.v, s.torques);
    const Eigen::VectorXd actual = plant.accelerations(s.q, s.v, s.torques);
    largest = largest.max((actual - expected).array().abs());
    square += expected.array().square() / states;
  }
  return (largest / square.sqrt()).maxCoeff();
}

TEST(Mabel, PlanarModelAgreesWithTheLagrangian) {
  const model::Model model = read("mabel_planar.yaml");
  for (const bool stretch : {false, true}) {
    PlantInOracleCoordinates plant(stretch ? model : with_rigid_cables(model));
    EXPECT_EQ(plant.positions(), stretch ? 13 : 9);
    const double worst = worst_difference(plant, {stretch, false}, 1000);
    EXPECT_LT(worst, 1e-9) << (stretch ? "cables stretch" : "cables rigid");
    std::printf("worst relative difference, cables %s: %.2g\n", stretch ? "stretching" : "rigid", worst);
  }
}

// What the rotors' turning with the torso would change; sources.md states it.
TEST(Mabel, RotorSpinWithTheTorsoIsSmall) {
  std::mt19937 generator(1);
  double torso = 0.0;
  double square = 0.0;
  for (int i = 0; i < 200; ++i) {
    const State s = draw(generator, false);
    const MabelVector without = mabel_accelerations({false, false}, s.q, s.v, s.torques);
    const MabelVector with = mabel_accelerations({false, true}, s.q, s.v, s.torques);
    torso += std::pow(with[kTorso] - without[kTorso], 2);
    square += std::pow(without[kTorso], 2);
  }
  std::printf("rotor spin changes the torso's acceleration by %.3g (rms share)\n", std::sqrt(torso / square));
  EXPECT_LT(std::sqrt(torso / square), 0.1);
}

/// A boom `times` as long, with the same inertia at the hip.
model::Model with_longer_boom(model::Model model, double times) {
  model::Body& boom = model.skeleton.bodies[static_cast<std::size_t>(model.body_index("boom"))];
  boom.com *= times;
  boom.inertia *= times * times;
  for (model::Joint& joint : model.skeleton.joints) {
    if (joint.name == "torso") {
      joint.X_PJ.translation() *= times;
    }
  }
  return model;
}

/// Difference of the 3-D model from the planar one near a level boom, hip motion in metres: the worst of the
/// coordinates, each relative to its root mean square over the states.
double difference_from_plane(double times) {
  const double length = 2.25 * times;
  const model::Model model = with_rigid_cables(with_longer_boom(read("mabel.yaml"), times));
  std::vector<std::string> of = names();
  of[kHipX] = "tower";
  of[kHipZ] = "boom_pitch";
  PlantInOracleCoordinates plant(model, of);
  std::mt19937 generator(5);
  Eigen::ArrayXd difference = Eigen::ArrayXd::Zero(kMabelCoordinates);
  Eigen::ArrayXd size = Eigen::ArrayXd::Zero(kMabelCoordinates);
  for (int i = 0; i < 100; ++i) {
    State s = draw(generator, false);
    s.q[kHipX] = s.q[kHipZ] = 0.0;
    const MabelVector expected = mabel_accelerations({false, false}, s.q, s.v, s.torques);
    s.v[kHipX] /= length;
    s.v[kHipZ] /= length;
    Eigen::VectorXd actual = plant.accelerations(s.q, s.v, s.torques);
    actual[kHipX] *= length;
    actual[kHipZ] *= length;
    difference += (actual - expected).array().square();
    size += expected.array().square();
  }
  return std::sqrt((difference / size).maxCoeff());
}

TEST(Mabel, LongBoomGoesOverIntoThePlane) {
  const double thousand = difference_from_plane(1e3);
  std::printf("3-D against planar: boom as it is %.3g, 1000 times as long %.3g\n", difference_from_plane(1.0),
              thousand);
  EXPECT_LT(thousand, 1e-3);
  // First order in one over the length.
  EXPECT_NEAR(difference_from_plane(1e4) / thousand, 0.1, 0.02);
}

// At rest with straight legs, by hand: each part at its own distance from the tower (legs at 2.25 -+ 0.1 m).
TEST(Mabel, TowerAndBoomFeelEachPartAtItsOwnDistance) {
  const model::Skeleton skeleton = read("mabel.yaml").skeleton;
  model::Mechanism mechanism(skeleton);
  const int n = mechanism.size();
  const auto index = [&](const std::string& joint) {
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
      if (skeleton.joints[j].name == joint) {
        return mechanism.coordinate_of_joint(static_cast<int>(j));
      }
    }
    return -1;
  };
  Eigen::MatrixXd M;
  Eigen::VectorXd h;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
  mechanism.evaluate(zero, zero, M, h);

  const double inner = 2.15;
  const double outer = 2.35;
  const double leg = 3.2818 + 1.5007 + 1.8987 + 1.6987;
  EXPECT_NEAR(h[index("boom_pitch")],
              9.80665 * (7.2575 * 1.48494153 + 40.8953 * 2.25 + leg * (inner + outer)), 1e-9);

  // izz of torso and legs (a tenth of the inertia about the hip's axis) and their offsets forward, m r_x^2.
  const auto about_vertical = [](double m, double across, double along, double joint_inertia) {
    return 0.1 * (joint_inertia - m * (across * across + along * along)) + m * across * across;
  };
  const double turning = about_vertical(40.8953, 0.01229, 0.18337, 2.3727) +
                         2.0 * (about_vertical(3.2818, 0.000311, 0.1978, 0.1986) +
                                about_vertical(1.5007, 0.0009671, 0.157, 0.08813) +
                                about_vertical(1.8987, 0.0009406, 0.1181, 0.04377) +
                                about_vertical(1.6987, 0.0004345, 0.08684, 0.03223));
  const int tower = index("tower");
  EXPECT_NEAR(M(tower, tower),
              20.4951 + 40.8953 * 2.25 * 2.25 + leg * (inner * inner + outer * outer) + turning, 1e-9);

  // A leg that swings forward pushes the tower at its own distance.
  const double swung = 3.2818 * 0.1978 + 1.5007 * (0.5 + 0.157);
  EXPECT_NEAR(M(tower, index("hip_left")), inner * swung, 1e-12);
  EXPECT_NEAR(M(tower, index("hip_right")), outer * swung, 1e-12);
  // The torso leans backward as it turns, the hip's reaction carries it: sign and size of the coupling.
  EXPECT_NEAR(
      M(tower, index("torso")),
      -2.25 * 40.8953 * 0.18337 + (inner + outer) * (swung + 1.8987 * (0.1181 - 0.2) + 1.6987 * 0.08684),
      1e-12);
  EXPECT_GT(M(index("boom_pitch"), index("boom_pitch")), 0.0);
}

// The carriage has no mass of its own: a payload there must not divide by it.
TEST(Mabel, APayloadOnALinkWithoutMassIsAPoint) {
  model::Model model = read("mabel_planar.yaml");
  model::EffectUse payload;
  payload.law = effects::Catalogue::all().find("added_mass");
  payload.at = "carriage";
  payload.values.resize(1);
  payload.values[0].value = 3.0;
  model::Plant plant(model, {});
  model.effects.push_back(payload);
  model::Plant loaded(model, {});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  x.segment(plant.positions(), plant.positions()).setOnes();
  const double speed = plant.velocity_of("hip_x", x.data());
  ASSERT_NE(speed, 0.0);
  const Eigen::Vector4d command = Eigen::Vector4d::Zero();
  EXPECT_NEAR(
      loaded.energetics(x.data(), command.data()).stored - plant.energetics(x.data(), command.data()).stored,
      0.5 * 3.0 * speed * speed, 1e-9);
}

// The planar file is checked number by number through the accelerations; the other must say the same.
TEST(Mabel, BothFilesSayTheSameOfDrivetrainAndEffects) {
  const model::Model plane = read("mabel_planar.yaml");
  const model::Model boom = read("mabel.yaml");
  ASSERT_EQ(plane.motors.size(), boom.motors.size());
  for (std::size_t i = 0; i < plane.motors.size(); ++i) {
    EXPECT_EQ(plane.motors[i].name, boom.motors[i].name);
    EXPECT_EQ(plane.motors[i].rotor_inertia.value, boom.motors[i].rotor_inertia.value);
    EXPECT_EQ(plane.motors[i].torque_constant.value, boom.motors[i].torque_constant.value);
  }
  ASSERT_EQ(plane.ratios.size(), boom.ratios.size());
  for (std::size_t i = 0; i < plane.ratios.size(); ++i) {
    EXPECT_EQ(plane.ratios[i].motor, boom.ratios[i].motor);
    ASSERT_EQ(plane.ratios[i].to.size(), boom.ratios[i].to.size());
    for (std::size_t k = 0; k < plane.ratios[i].to.size(); ++k) {
      EXPECT_EQ(plane.ratios[i].to[k].of, boom.ratios[i].to[k].of);
      EXPECT_EQ(plane.ratios[i].to[k].factor, boom.ratios[i].to[k].factor);
    }
  }
  ASSERT_EQ(plane.effects.size(), boom.effects.size() + 1);  // the boom's weight at hip_z
  EXPECT_EQ(plane.effects.front().label(), "preload at hip_z");
  for (std::size_t i = 0; i < boom.effects.size(); ++i) {
    EXPECT_EQ(plane.effects[i + 1].label(), boom.effects[i].label());
    EXPECT_EQ(plane.effects[i + 1].numbers(), boom.effects[i].numbers());
  }
}

TEST(Mabel, SensorsHaveThePapersResolutions) {
  const model::Model boom = read("mabel.yaml");
  const model::Model plane = read("mabel_planar.yaml");
  const auto degrees = [](const model::Model& model, const std::string& sensor) {
    return model.find_sensor(sensor)->resolution * 180.0 / std::acos(-1.0);
  };
  for (const char* side : {"_left", "_right"}) {
    for (const model::Model& model : {boom, plane}) {
      for (const char* sensor : {"mLA", "mLS", "bsp", "knee"}) {
        EXPECT_NEAR(degrees(model, std::string(sensor) + side), 0.1758, 5e-5);
      }
      EXPECT_NEAR(degrees(model, std::string("thigh") + side), 0.008878, 5e-7);
      EXPECT_NEAR(degrees(model, "torso"), 0.05859, 5e-6);
    }
  }
  EXPECT_NEAR(degrees(boom, "boom_pitch"), 0.009988, 5e-7);  // printed: 0.09988
  EXPECT_NEAR(degrees(boom, "tower"), 0.001216, 5e-7);
  EXPECT_NEAR(degrees(plane, "hip_z") / 2.25, 0.009988, 5e-7);
  EXPECT_NEAR(degrees(plane, "hip_x") / 2.25, 0.001216, 5e-7);
}

TEST(Mabel, MassesSumToThePapers65Kg) {
  double mass = 0.0;
  for (const model::Body& body : read("mabel.yaml").skeleton.bodies) {
    mass += body.mass;
  }
  EXPECT_NEAR(mass, 40.8953 + 2 * (3.2818 + 1.5007 + 1.8987 + 1.6987) + 7.2575, 1e-12);
}

}  // namespace
}  // namespace plumbline::oracles
