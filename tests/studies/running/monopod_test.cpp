// Thumper's closed form against the simulator's plant on rigid ground, which knows nothing of it.
#include "controllers/monopod/monopod.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <fstream>
#include <iterator>
#include <random>

#include "simulator/model/known_effects.h"
#include "simulator/model/rigid_contact.h"
#include "simulator/model/robot_file.h"
#include "simulator/trace/error.h"
#include "validation/studies/running/monopod_file.h"

namespace plumbline::running_tests {
namespace {

using namespace monopod;

class Monopod : public testing::Test {
 protected:
  Monopod()
      : read(validation::read_monopod(PLUMBLINE_ROOT "/robots/thumper/monopod.yaml")),
        model(model::read_model(read.names.model, model::known_effects())),
        constants(read.constants),
        plant(model, {}),
        contact(plant) {
    rows.resize(6, plant.positions());
    const char* const names[] = {"leg_angle", "leg_shape", "mLS", "torso", "hip_x", "hip_z"};
    for (int i = 0; i < 6; ++i) {
      rows.row(i) = contact.kinematics().row_of(names[i]);
    }
  }

  /// In the plant's own coordinates.
  Eigen::VectorXd in_plant(const State& state) const {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
    x.head(plant.positions()) = rows.partialPivLu().solve(Eigen::VectorXd(state.q));
    x.segment(plant.positions(), plant.positions()) = rows.partialPivLu().solve(Eigen::VectorXd(state.v));
    return x;
  }
  Vector6 rates_of(const Eigen::VectorXd& x) const {
    return rows * x.segment(plant.positions(), plant.positions());
  }

  State drawn(bool spring_at_rest) {
    std::uniform_real_distribution<double> even(-1.0, 1.0);
    State state;
    state.q << 0.3 * even(random), 0.4 + 0.2 * even(random), 0.0, 0.2 * even(random), even(random),
        1.0 + 0.1 * even(random);
    state.v << 3.0 * even(random), 3.0 * even(random), 40.0 * even(random), 2.0 * even(random), even(random),
        even(random);
    state.q[kMotor] = constants.shape_ratio * (state.q[kLegShape] - (spring_at_rest ? 0.0 : 0.1));
    if (spring_at_rest) {
      state.v[kMotor] = constants.shape_ratio * state.v[kLegShape];
    }
    return state;
  }

  validation::MonopodModel read;
  model::Model model;
  Constants constants;
  model::Plant plant;
  model::RigidContact contact;
  Eigen::MatrixXd rows;
  std::mt19937 random{7};
};

TEST_F(Monopod, ReadsTheConstantsOfTheModel) {
  EXPECT_NEAR(total_mass(constants), 30.0, 3.0);  // "approximately"
  EXPECT_DOUBLE_EQ(constants.upper_length, 0.5);
  EXPECT_DOUBLE_EQ(constants.lower_length, 0.5);
  EXPECT_NEAR(constants.spring_ratio, 5.18, 1e-9);
}

/// What is said about the robot's file with one text replaced.
std::string refusal(const std::string& from, const std::string& to) {
  std::ifstream in(PLUMBLINE_ROOT "/robots/thumper/monopod.yaml");
  std::string all{std::istreambuf_iterator<char>(in), {}};
  all.replace(all.find(from), from.size(), to);
  const std::string model = "model: ";
  all.insert(all.find(model) + model.size(), PLUMBLINE_ROOT "/robots/thumper/");
  const std::string path = testing::TempDir() + "monopod.yaml";
  std::ofstream(path) << all;
  try {
    validation::read_monopod(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST_F(Monopod, RefusesPartsThatTheModelHasNot) {
  EXPECT_NE(refusal("upper: thigh_link", "upper: tigh_link").find("a link of the model"), std::string::npos);
  EXPECT_NE(refusal("knee: knee", "knee: ankle").find("a joint of the model"), std::string::npos);
  EXPECT_NE(refusal("motor: mLS", "motor: mLX").find("a motor of the model"), std::string::npos);
  EXPECT_NE(refusal("ratio: leg_angle", "ratio: arm").find("a ratio of the model"), std::string::npos);
  EXPECT_NE(refusal("spring: bsp", "spring: spr").find("a pulley of the model"), std::string::npos);
  EXPECT_NE(refusal("links:", "parts:").find("parts"), std::string::npos);
}

TEST_F(Monopod, AcceleratesAsThePlantWithThePinnedToe) {
  for (int i = 0; i < 20; ++i) {
    State state = drawn(false);
    stand_on_origin(constants, state, true);
    const Eigen::VectorXd x = in_plant(state);
    contact.hold({{0}, {}}, x.data());
    const Vector2 torque(7.0, -4.0);
    Eigen::VectorXd rate = Eigen::VectorXd::Zero(plant.states());
    contact.rate(x.data(), torque.data(), rate.data());
    const Dynamics d = dynamics(constants, state);
    const Acceleration a = accelerations(d, stance(d));
    const Vector6 acceleration = a.drift + a.gain * torque;
    EXPECT_LT((acceleration - rates_of(rate)).norm(), 1e-9 * (1.0 + acceleration.norm()));
    const Eigen::Vector3d force = contact.foot_force(0);
    EXPECT_LT((ground_force(d, acceleration) - Vector2(force.x(), force.z())).norm(),
              1e-8 * (1.0 + force.norm()));
  }
}

TEST_F(Monopod, AcceleratesAsThePlantWithTheSpringHeld) {
  for (int i = 0; i < 20; ++i) {
    const State state = drawn(true);
    const Eigen::VectorXd x = in_plant(state);
    contact.hold({{}, {"bsp"}}, x.data());
    const Vector2 torque(-5.0, 3.0);
    Eigen::VectorXd rate = Eigen::VectorXd::Zero(plant.states());
    contact.rate(x.data(), torque.data(), rate.data());
    const Dynamics d = dynamics(constants, state);
    const Acceleration a = accelerations(d, flight(constants, d));
    const Vector6 acceleration = a.drift + a.gain * torque;
    EXPECT_LT((acceleration - rates_of(rate)).norm(), 1e-9 * (1.0 + acceleration.norm()));
  }
}

TEST_F(Monopod, TakesBothImpactsAsThePlant) {
  for (int i = 0; i < 20; ++i) {
    const State flying = drawn(true);
    Eigen::VectorXd x = in_plant(flying);
    contact.strike({{0}, {}}, x.data());
    Dynamics d = dynamics(constants, flying);
    Vector6 after = impact(d, stance(d), flying.v);
    EXPECT_LT((after - rates_of(x)).norm(), 1e-9 * (1.0 + after.norm()));

    State leaving = drawn(true);
    leaving.v[kMotor] += 20.0;  // B_Spring runs onto its stop
    x = in_plant(leaving);
    contact.strike({{}, {"bsp"}}, x.data());
    d = dynamics(constants, leaving);
    after = impact(d, flight(constants, d), leaving.v);
    EXPECT_LT((after - rates_of(x)).norm(), 1e-9 * (1.0 + after.norm()));
  }
}

TEST_F(Monopod, HasThePlantsEnergy) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(plant.motors());
  const State one = drawn(false), other = drawn(false);
  const auto stored = [&](const State& s) {
    return plant.energetics(in_plant(s).data(), none.data()).stored;
  };
  EXPECT_NEAR(energy(constants, one) - energy(constants, other), stored(one) - stored(other), 1e-8);
}

}  // namespace
}  // namespace plumbline::running_tests
