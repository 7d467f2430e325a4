// Hidden states of a drive, carried along a known motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "simulator/effects/catalogue.h"
#include "simulator/model/plant.h"
#include "simulator/model/robot_file.h"

namespace plumbline::model {
namespace {

constexpr double kSample = 1e-3;  // s

Model with_loop(double time_constant, double damping_ratio) {
  Model model = read_model("tests/robots/pendulum/model.yaml", effects::Catalogue::all());
  EffectUse loop;
  loop.law = effects::Catalogue::all().find("current_loop");
  loop.at = "drive";
  for (const double value : {time_constant, damping_ratio}) {
    Quantity quantity;
    quantity.value = value;
    loop.values.push_back(quantity);
  }
  model.effects.push_back(loop);
  return model;
}

/// The torque that a loop delivers after `time` under a step from 0 to 1 (Astrom and Murray, section 6.3):
/// 1 - (s2 e^(s1 t) - s1 e^(s2 t)) / (s2 - s1) with the roots s1, s2 of its polynomial.
double step_response(double time, double time_constant, double damping_ratio) {
  const std::complex<double> root = std::sqrt(std::complex<double>(damping_ratio * damping_ratio - 1.0));
  const std::complex<double> one = (-damping_ratio + root) / time_constant;
  const std::complex<double> two = (-damping_ratio - root) / time_constant;
  return 1.0 - ((two * std::exp(one * time) - one * std::exp(two * time)) / (two - one)).real();
}

// A loop from twenty times faster than the sample to twice slower: exact in all.
TEST(CarriedStates, FollowACurrentLoopHoweverFastItIs) {
  for (const double time_constant : {5e-5, 2e-4, 2e-3}) {
    const Plant plant(with_loop(time_constant, 0.5), {});
    Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
    Eigen::VectorXd command = Eigen::VectorXd::Zero(plant.motors());
    plant.settle(command.data(), x.data());
    command[0] = 0.3;
    const double asked = 0.3 * plant.torque_gain(0);
    const std::vector<int> carried = plant.carried_states();
    ASSERT_EQ(carried.size(), 2U);
    const int delivered = carried.front();
    for (int k = 1; k <= 5; ++k) {
      const Eigen::VectorXd at = x;
      plant.carry_states(at.data(), at.data(), command.data(), kSample, x.data());
      EXPECT_NEAR(x[delivered], asked * step_response(k * kSample, time_constant, 0.5), 1e-6 * asked)
          << time_constant << " after " << k << " samples";
    }
  }
}

}  // namespace
}  // namespace plumbline::model
