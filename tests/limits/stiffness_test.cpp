// The approximate Jacobian where it is exact, and the effect that is named as the stiffest.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "simulator/integrate/plant_ode.h"
#include "simulator/model/known_effects.h"
#include "tests/limits/bench.h"

namespace plumbline::limits {
namespace {

// A damper c alone along a coordinate that weighs m there slows it at c/m: the only eigenvalue that is not
// zero.
TEST(Stiffness, OfADamperIsItsDampingOverTheInertiaFelt) {
  constexpr double damping = 100.0;
  const model::Model model = with_effect(leg_bench(), "viscous", "mLS", {damping});
  model::Plant plant(model, {});
  Eigen::VectorXd x = Eigen::VectorXd::Constant(plant.states(), 0.1);
  const std::vector<double> command(static_cast<std::size_t>(plant.motors()), 0.0);
  const model::Stiffest found = plant.stiffest(x.data(), command.data());
  EXPECT_EQ(found.element, "viscous at mLS");
  EXPECT_NEAR(found.rate, damping / plant.inertia_of("mLS"), 1e-6 * found.rate);
}

TEST(Stiffness, AskingForItChangesNothing) {
  const model::Model model =
      model::read_model(PLUMBLINE_ROOT "/robots/mabel/mabel_planar.yaml", model::known_effects());
  model::Plant plant(model, {});
  const Eigen::VectorXd x = Eigen::VectorXd::Constant(plant.states(), 0.01);
  const Eigen::VectorXd command = Eigen::VectorXd::Zero(plant.motors());
  Eigen::VectorXd before(plant.states()), after(plant.states());
  plant.rate(x.data(), command.data(), before.data());
  plant.stiffest(x.data(), command.data());
  plant.rate(x.data(), command.data(), after.data());
  EXPECT_EQ(before, after);
}

/// The whole machine with one foot in the ground, pulleys in their stops, bristles bent.
class WholeMachine : public testing::TestWithParam<const char*> {
 protected:
  WholeMachine()
      : plant_(model::read_model(std::string(PLUMBLINE_ROOT "/robots/mabel/") + GetParam(),
                                 model::known_effects()),
               {}),
        command_(Eigen::VectorXd::Constant(plant_.motors(), 1.0)),
        x_(Eigen::VectorXd::Zero(plant_.states())) {
    const int n = plant_.positions();
    for (int i = 0; i < n; ++i) x_[i] = -0.03 + 0.002 * i;
    x_.tail(plant_.states() - 2 * n).setConstant(1e-3);
    // Lower the machine until a foot is 1 mm deep: the height is found by its name.
    const std::vector<std::string> names = plant_.state_names();
    const std::string height = std::string(GetParam()) == "mabel.yaml" ? "boom_pitch" : "hip_z";
    int lift = 0;
    while (names[static_cast<std::size_t>(lift)] != "position of " + height) ++lift;
    for (int k = 0; k < 60; ++k) {
      const auto touches = plant_.touches(x_.data());
      x_[lift] += 0.5 * (std::max(touches[0].depth, touches[1].depth) - 1e-3);
    }
  }
  Eigen::VectorXd rate(const Eigen::VectorXd& x) {
    Eigen::VectorXd xdot(plant_.states());
    plant_.rate(x.data(), command_.data(), xdot.data());
    return xdot;
  }
  model::Plant plant_;
  Eigen::VectorXd command_, x_;
};

// At rest no force of inertia is linear in a velocity, and hidden states act through effects only: there the
// approximate Jacobian's columns are the whole truth.
TEST_P(WholeMachine, AtRestTheJacobianIsExactButForPositions) {
  ASSERT_GT(std::max(plant_.touches(x_.data())[0].depth, plant_.touches(x_.data())[1].depth), 0.9e-3);
  Eigen::MatrixXd A(plant_.states(), plant_.states());
  plant_.stiff_jacobian(x_.data(), command_.data(), A);
  for (Eigen::Index i = plant_.positions(); i < plant_.states(); ++i) {
    const double step = i < 2 * plant_.positions() ? 1e-6 : 1e-8;
    Eigen::VectorXd up = x_, down = x_;
    up[i] += step;
    down[i] -= step;
    const Eigen::VectorXd column = (rate(up) - rate(down)) / (2.0 * step);
    // Dampers with a rounded root bend over 1e-4 of speed: the laws' own step of 1e-4 m/s sees a mean slope.
    const double share = i < 2 * plant_.positions() ? 0.5 : 1e-5;
    EXPECT_LT((A.col(i) - column).norm(), share * column.norm() + 1e-6)
        << plant_.state_names()[static_cast<std::size_t>(i)];
  }
}

TEST_P(WholeMachine, NamesItsStopAsTheStiffest) {
  const model::Stiffest found = plant_.stiffest(x_.data(), command_.data());
  EXPECT_EQ(found.element.substr(0, 16), "hard_stop at bsp");
  EXPECT_GT(found.rate, 1e5);  // 1000 N m s/rad on a pulley of 1.9e-3 kg m^2
}

// A difference across a stop's surface, where its damping sets in, would be a stiffness of 1e12 N m/rad.
TEST_P(WholeMachine, AStopThatHasJustBeenMetIsAsStiffAsFurtherIn) {
  const std::vector<std::string> names = plant_.state_names();
  const auto pulley = std::find(names.begin(), names.end(), "position of bsp_left") - names.begin();
  ASSERT_LT(pulley, plant_.positions());
  x_[plant_.positions() + pulley] = -0.1;  // moving in, rad/s
  const auto jacobian_at = [&](double depth) {
    x_[pulley] = -depth;
    Eigen::MatrixXd A(plant_.states(), plant_.states());
    plant_.stiff_jacobian(x_.data(), command_.data(), A);
    return A;
  };
  const Eigen::MatrixXd inside = jacobian_at(1e-6);
  EXPECT_GT(inside.norm(), 1e5);
  EXPECT_LT((jacobian_at(1e-13) - inside).norm(), 1e-4 * inside.norm());
}

INSTANTIATE_TEST_SUITE_P(Mabel, WholeMachine, testing::Values("mabel_planar.yaml", "mabel.yaml"),
                         [](const auto& tested) {
                           return std::string(tested.param) == "mabel.yaml" ? "boom" : "plane";
                         });

}  // namespace
}  // namespace plumbline::limits
