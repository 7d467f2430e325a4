// Motion on closed loops: closed forms, energy, what is kept over 10 s, the order of convergence.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "simulator/integrate/plant_ode.h"
#include "tests/model/loop_mechanisms.h"

namespace plumbline::model {
namespace {

using integrate::Integrator;
using integrate::Method;
using integrate::Options;
using integrate::PlantOde;

constexpr double kCrank = 0.1, kRod = 0.35;  // m

/// A crank about y at the origin, a slider along x, and a rod without mass between them.
Model slider_crank() {
  Model model;
  model.file = "model.yaml";
  const int crank = test::hang(model, test::bar("crank", 0.8, {0.0, 0.0, 0.0}, 0.006), -1,
                               test::at({0.0, 0.0, 0.0}), Eigen::Vector3d::UnitY());
  const int slider = test::hang(model, test::bar("slider", 0.5, {0.0, 0.0, 0.0}, 0.001), -1,
                                test::at({0.0, 0.0, 0.0}), Eigen::Vector3d::UnitX(), JointType::prismatic);
  model.skeleton.gravity.setZero();
  model.loops.push_back(test::loop(Loop::Type::rod, {crank, {kCrank, 0, 0}}, {slider, {0, 0, 0}}, kRod));
  model.loops_near = {{"j_slider", 0.4}};
  return model;
}

/// Where the slider is for a crank angle, and the derivatives by it.
struct Slide {
  double x, slope, curvature;
};
Slide slide(double angle) {
  // x = r cos + w, w^2 = l^2 - r^2 sin^2: w' = -r^2 sin cos / w.
  const double s = std::sin(angle), c = std::cos(angle);
  const double w = std::sqrt(kRod * kRod - kCrank * kCrank * s * s);
  const double w1 = -kCrank * kCrank * s * c / w;
  const double w2 = (-kCrank * kCrank * (c * c - s * s) - w1 * w1) / w;
  return {kCrank * c + w, -kCrank * s + w1, -kCrank * c + w2};
}

constexpr double kCrankInertia = 1.3 * 0.006, kSliderMass = 0.5;

Eigen::VectorXd start_of(Plant& plant, double angle, double speed) {
  Eigen::MatrixXd first = Eigen::MatrixXd::Zero(1, plant.positions());
  first(0, 0) = 1.0;
  Eigen::VectorXd z = plant.home();
  EXPECT_TRUE(plant.closure()->close(first, Eigen::VectorXd::Constant(1, angle), z));
  Eigen::VectorXd x(plant.states());
  x << z, plant.closure()->velocities(first, Eigen::VectorXd::Constant(1, speed), z);
  return x;
}

// (I + m x'^2) theta'' + m x' x'' theta'^2 = 0.
TEST(SliderCrank, MovesAsItsClosedForm) {
  Plant plant(slider_crank(), {});
  for (double angle = -3.0; angle < 3.1; angle += 0.25) {
    const double speed = 4.0 + angle;
    const Eigen::VectorXd x = start_of(plant, angle, speed);
    const Slide at = slide(angle);
    EXPECT_NEAR(x[1], at.x, 1e-13);
    EXPECT_NEAR(x[3], at.slope * speed, 1e-12);
    Eigen::VectorXd rate(4);
    plant.rate(x.data(), nullptr, rate.data());
    const double expected = -kSliderMass * at.slope * at.curvature * speed * speed /
                            (kCrankInertia + kSliderMass * at.slope * at.slope);
    EXPECT_NEAR(rate[2], expected, 1e-11 * (1.0 + std::abs(expected)));
    EXPECT_NEAR(rate[3], at.slope * expected + at.curvature * speed * speed, 1e-10);
  }
}

// theta' from the energy alone, after some thirty turns.
TEST(SliderCrank, KeepsItsClosedFormOverTenSeconds) {
  Plant plant(slider_crank(), {});
  PlantOde ode(plant, false, false);
  Options options;
  options.set_tolerance(1e-10);
  Integrator integrator(ode, options);
  const Eigen::VectorXd x0 = start_of(plant, 0.3, 20.0);
  integrator.start(0.0, x0);
  integrator.advance(10.0);
  const Eigen::VectorXd& x = integrator.state();
  const auto inertia = [](double angle) {
    return kCrankInertia + kSliderMass * slide(angle).slope * slide(angle).slope;
  };
  EXPECT_GT(x[0], 100.0);  // it turns
  EXPECT_NEAR(x[1], slide(x[0]).x, 1e-12);
  EXPECT_NEAR(x[2], 20.0 * std::sqrt(inertia(0.3) / inertia(x[0])), 2e-6);  // 1e-10 a step, 1e4 steps
}

struct Method_of {
  Method method;
  double tolerance, energy;  // what is left of the energy, of its reach
};

class LoopsOverTenSeconds : public testing::TestWithParam<Method_of> {};

// A four-bar linkage that swings and turns over under gravity, and two arms tied at their tips.
TEST_P(LoopsOverTenSeconds, KeepEnergyAndStayClosed) {
  Model arms = test::two_arms(3);
  arms.loops.push_back(test::loop(Loop::Type::connect, test::tip(0, 3), test::tip(1, 3)));
  for (const Model& model : {test::four_bar(), arms}) {
    Plant plant(model, {});
    PlantOde ode(plant, false, false);
    Options options;
    options.set_tolerance(GetParam().tolerance);
    options.method = GetParam().method;
    Integrator integrator(ode, options);
    Eigen::VectorXd x = start_of(plant, plant.home()[0], 3.0);
    const double before = plant.energetics(x.data(), nullptr).stored;
    integrator.start(0.0, x);
    double position = 0.0, velocity = 0.0, energy = 0.0, speed = 0.0;
    for (int k = 1; k <= 1000; ++k) {
      integrator.advance(0.01 * k);
      x = integrator.state();
      const Eigen::Vector2d open = plant.loop_errors(x.data());
      position = std::max(position, open[0]);
      velocity = std::max(velocity, open[1]);
      speed = std::max(speed, x.tail(plant.positions()).cwiseAbs().maxCoeff());
      energy = std::max(energy, std::abs(plant.energetics(x.data(), nullptr).stored - before));
    }
    RecordProperty("position_error", std::to_string(position));
    std::cout << to_string(GetParam().method) << ": open by " << position << " m and " << velocity
              << " m/s, energy off by " << energy << " J of " << before << " J, "
              << integrator.summary().steps << " steps, moved by at most "
              << integrator.summary().largest_projection << " m in a step\n";
    EXPECT_LT(position, 1e-12 * 0.45);
    EXPECT_LT(velocity, 1e-12 * speed);
    EXPECT_LT(energy, GetParam().energy);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Methods, LoopsOverTenSeconds,
    testing::Values(Method_of{Method::explicit_rk, 1e-10, 1e-7}, Method_of{Method::rosenbrock, 1e-6, 1e-3},
                    Method_of{Method::implicit_rk, 1e-8, 1e-5}, Method_of{Method::bdf, 1e-9, 1e-4}),
    [](const testing::TestParamInfo<Method_of>& tested) { return to_string(tested.param.method); });

// p = log2(e(h) / e(h/2)) with fixed steps; the reference by order 5 with steps ten times shorter. A
// projection moves a state by its local error at most, and so takes nothing off the order (Hairer, Lubich,
// Wanner, Geometric Numerical Integration, IV.4).
TEST(Loops, KeepTheOrderOfTheMethod) {
  Plant plant(test::four_bar(), {});
  const Eigen::VectorXd x0 = start_of(plant, plant.home()[0], 3.0);
  const auto after = [&](Method method, int order, int steps) {
    PlantOde ode(plant, false, false);
    Options options;
    options.set_tolerance(1e-12);
    options.method = method;
    options.order = order;
    options.fixed_step = 0.5 / steps;
    Integrator integrator(ode, options);
    integrator.start(0.0, x0);
    integrator.advance(0.5);
    return integrator.state();
  };
  const Eigen::VectorXd exact = after(Method::explicit_rk, 5, 2000);
  const auto error = [&](Method method, int order, int steps) {
    return (after(method, order, steps) - exact).norm();
  };
  for (const int order : {2, 3, 4}) {
    const double rate =
        std::log2(error(Method::explicit_rk, order, 100) / error(Method::explicit_rk, order, 200));
    EXPECT_NEAR(rate, order, 0.3);
  }
  EXPECT_NEAR(std::log2(error(Method::rosenbrock, 0, 200) / error(Method::rosenbrock, 0, 400)), 3.0, 0.3);
}

// What a search moves off the loops comes back as the slope says.
TEST(Loops, ClosingHasTheSlopeItSays) {
  Plant plant(test::four_bar(), {});
  const Eigen::VectorXd x = start_of(plant, plant.home()[0] + 0.3, 3.0);
  const Eigen::MatrixXd slope = plant.closing_slope(x.data());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    Eigen::VectorXd up = x, down = x;
    constexpr double kStep = 1e-5;
    up[i] += kStep;
    down[i] -= kStep;
    plant.close_loops(up.data());
    plant.close_loops(down.data());
    EXPECT_LT(((up - down) / (2.0 * kStep) - slope.col(i)).norm(), 1e-7);
  }
}

// Hanging under gravity: no acceleration, and the potential is the least of its neighbours on the loop.
TEST(Loops, FindTheirEquilibrium) {
  Plant plant(test::four_bar(), {});
  const Eigen::VectorXd z = plant.equilibrium(start_of(plant, 1.2, 0.0).head(plant.positions()), nullptr);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  x.head(plant.positions()) = z;
  Eigen::VectorXd rate(plant.states());
  plant.rate(x.data(), nullptr, rate.data());
  EXPECT_LT(rate.cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_LT(plant.loop_errors(x.data())[0], 1e-12);
  const double here = plant.energetics(x.data(), nullptr).stored;
  for (const double aside : {-0.05, 0.05}) {
    EXPECT_GT(plant.energetics(start_of(plant, z[0] + aside, 0.0).data(), nullptr).stored, here);
  }
}

}  // namespace
}  // namespace plumbline::model
