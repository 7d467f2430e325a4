// A rod of a closed loop that an effect lets stretch: beside closed forms, differences, and the rod that
// holds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "simulator/effects/parameters.h"
#include "simulator/integrate/plant_ode.h"
#include "simulator/model/known_effects.h"
#include "simulator/model/positions_from.h"
#include "simulator/trace/error.h"
#include "tests/model/loop_mechanisms.h"

namespace plumbline::model {
namespace {

constexpr double kCrank = 0.1, kRod = 0.35;                       // m
constexpr double kCrankInertia = 1.3 * 0.006, kSlider = 0.5;      // kg m^2, kg
constexpr double kStiffness = 4e3, kDamping = 15.0, kGap = 2e-3;  // N/m, N s/m, m

EffectUse use_of(const std::string& law, const std::vector<double>& values) {
  EffectUse use{known_effects().find(law), "loop", {}, 0};
  for (const double value : values) {
    Quantity quantity;
    quantity.value = value;
    use.values.push_back(quantity);
  }
  return use;
}

/// A crank about y at the origin and a slider along x, in no gravity, and a rod of kRod between them.
Model pulled(const std::vector<EffectUse>& effects) {
  Model model;
  model.file = "model.yaml";
  const int crank = test::hang(model, test::bar("crank", 0.8, {0.0, 0.0, 0.0}, 0.006), -1,
                               test::at({0.0, 0.0, 0.0}), Eigen::Vector3d::UnitY());
  const int slider = test::hang(model, test::bar("slider", kSlider, {0.0, 0.0, 0.0}, 0.001), -1,
                                test::at({0.0, 0.0, 0.0}), Eigen::Vector3d::UnitX(), JointType::prismatic);
  model.skeleton.gravity.setZero();
  model.loops.push_back(test::loop(Loop::Type::rod, {crank, {kCrank, 0, 0}}, {slider, {0, 0, 0}}, kRod));
  model.loops_near = {{"j_slider", 0.4}};
  model.effects = effects;
  return model;
}

/// s = d - l with d^2 = (x - r cos)^2 + (r sin)^2, its slopes and its rate, by hand.
struct ByHand {
  double stretch, by_angle, by_slide, rate;
  explicit ByHand(const Eigen::VectorXd& x) {
    const double c = std::cos(x[0]), s = std::sin(x[0]);
    const double d = std::hypot(x[1] - kCrank * c, kCrank * s);
    stretch = d - kRod;
    by_angle = x[1] * kCrank * s / d;
    by_slide = (x[1] - kCrank * c) / d;
    rate = by_angle * x[2] + by_slide * x[3];
  }
  Eigen::Vector2d accelerations(double force) const {
    return {force * by_angle / kCrankInertia, force * by_slide / kSlider};
  }
};

class StretchedRod : public testing::Test {
 protected:
  Eigen::VectorXd somewhere(int states) {
    std::uniform_real_distribution<double> draw(-1.0, 1.0);
    Eigen::VectorXd x = Eigen::VectorXd::NullaryExpr(states, [&] { return draw(random_); });
    x[0] *= 3.0;
    x[1] =
        kCrank * std::cos(x[0]) + std::sqrt(kRod * kRod - std::pow(kCrank * std::sin(x[0]), 2)) + 0.01 * x[1];
    return x;
  }
  std::mt19937_64 random_{17};
};

TEST_F(StretchedRod, PullsAsItsClosedForm) {
  Plant plant(pulled({use_of("cable_stretch", {kStiffness, kDamping})}), {});
  EXPECT_FALSE(plant.has_loops());
  ASSERT_EQ(plant.states(), 4);
  for (int i = 0; i < 100; ++i) {
    const Eigen::VectorXd x = somewhere(4);
    const ByHand rod(x);
    const effects::Motion at = plant.motion_at(effects::Place::ratio, "loop", x.data());
    EXPECT_NEAR(at.position, rod.stretch, 1e-15);
    EXPECT_NEAR(at.velocity, rod.rate, 1e-14);
    Eigen::VectorXd rate(4);
    plant.rate(x.data(), nullptr, rate.data());
    const Eigen::Vector2d expected = rod.accelerations(-kStiffness * rod.stretch - kDamping * rod.rate);
    EXPECT_LT((rate.tail(2) - expected).norm(), 1e-11 * (1.0 + expected.norm()));
  }
}

// Within its play a rod lets everything go; beyond it pushes and pulls.
TEST_F(StretchedRod, HasPlay) {
  Plant plant(pulled({use_of("backlash", {kGap, kStiffness, 0.0})}), {});
  for (int i = 0; i < 100; ++i) {
    const Eigen::VectorXd x = somewhere(4);
    const ByHand rod(x);
    const double excess = rod.stretch - std::clamp(rod.stretch, -0.5 * kGap, 0.5 * kGap);
    Eigen::VectorXd rate(4);
    plant.rate(x.data(), nullptr, rate.data());
    const Eigen::Vector2d expected = rod.accelerations(-kStiffness * excess);
    EXPECT_LT((rate.tail(2) - expected).norm(), 1e-10 * (1.0 + expected.norm()));
    Eigen::VectorXd g(plant.switch_count());
    plant.switches(x.data(), g.data());
    EXPECT_NEAR(g[0], rod.stretch - 0.5 * kGap, 1e-15);
  }
}

// With a law that has a state, too (a coupling that slips).
TEST_F(StretchedRod, HasTheSlopesOfItsRates) {
  for (const EffectUse& use : {use_of("cable_stretch", {kStiffness, kDamping}),
                               use_of("slipping_coupling", {30.0, kStiffness, kDamping})}) {
    Plant plant(pulled({use}), {});
    const int n = plant.states();
    const auto rate = [&](const Eigen::VectorXd& x) {
      Eigen::VectorXd xdot(n);
      plant.rate(x.data(), nullptr, xdot.data());
      return xdot;
    };
    for (int i = 0; i < 20; ++i) {
      Eigen::VectorXd x = somewhere(n);
      x.tail(n - 4) *= 0.01;
      const Eigen::VectorXd still = Eigen::VectorXd::Zero(n);
      Eigen::MatrixXd A, B;
      plant.tangent({x.data(), still.data(), nullptr, nullptr, 1e-3}, {{0, 0}}, Eigen::VectorXd::Ones(1),
                    true, A, B);
      for (int k = 0; k < n; ++k) {
        const double step = 1e-6;
        Eigen::VectorXd moved = x;
        moved[k] += step;
        const Eigen::VectorXd up = rate(moved);
        moved[k] -= 2.0 * step;
        const Eigen::VectorXd expected = (up - rate(moved)) / (2.0 * step);
        EXPECT_LT((A.col(k) - expected).norm(), 1e-5 * (1.0 + expected.norm())) << k;
      }
      const double value = plant.value({0, 0});
      plant.set_value({0, 0}, value + 1.0);
      const Eigen::VectorXd up = rate(x);
      plant.set_value({0, 0}, value);
      EXPECT_LT((B.col(0) - (up - rate(x))).norm(), 1e-6 * (1.0 + B.norm()));
    }
  }
}

TEST_F(StretchedRod, IsAsStiffAsItIsWhereverItWasBefore) {
  const Model model = pulled({use_of("cable_stretch", {kStiffness, kDamping})});
  Plant fresh(model, {});
  Plant moved(model, {});
  const Eigen::VectorXd elsewhere = somewhere(4);
  Eigen::VectorXd rate(4);
  moved.rate(elsewhere.data(), nullptr, rate.data());
  const Eigen::VectorXd x = somewhere(4);
  const Stiffest found = fresh.stiffest(x.data(), nullptr);
  EXPECT_EQ(found.element, "cable_stretch at loop");
  EXPECT_GT(found.rate, 1.0);
  EXPECT_EQ(moved.stiffest(x.data(), nullptr).rate, found.rate);
}

TEST_F(StretchedRod, KeepsTheEnergyThatItStores) {
  Plant plant(pulled({use_of("cable_stretch", {kStiffness, 0.0})}), {});
  integrate::PlantOde ode(plant, false, false);
  integrate::Options options;
  options.set_tolerance(1e-10);
  integrate::Integrator integrator(ode, options);
  Eigen::VectorXd x(4);
  x << 0.3, 0.46, 20.0, 0.0;
  const double before = plant.energetics(x.data(), nullptr).stored;
  integrator.start(0.0, x);
  integrator.advance(2.0);
  x = integrator.state();
  EXPECT_GT(std::abs(ByHand(x).stretch), 1e-5);
  EXPECT_NEAR(plant.energetics(x.data(), nullptr).stored, before, 1e-6 * before);
}

// The stiffer the spring, the nearer to the rod that holds: by the force on it over its stiffness.
TEST_F(StretchedRod, IsTheRodThatHoldsWhenItIsStiff) {
  const auto rest = [](double stiffness) {
    EffectUse spring = use_of("spring", {50.0, 0.0});
    spring.at = "j_slider";
    EffectUse hold = use_of("spring", {80.0, 1.0});
    hold.at = "j_crank";
    Model model = pulled({spring, hold});
    if (std::isfinite(stiffness)) {
      model.effects.push_back(use_of("cable_stretch", {stiffness, 1.0}));
    }
    model.skeleton.bodies.front().com = {0.05, 0.0, 0.0};
    model.skeleton.gravity = {0.0, 0.0, -9.8};
    Plant plant(model, {});
    return Eigen::VectorXd(plant.equilibrium(plant.home(), nullptr));
  };
  const Eigen::VectorXd rigid = rest(effects::kInfinity);
  const double soft = (rest(1e5) - rigid).norm();
  const double stiff = (rest(1e6) - rigid).norm();
  EXPECT_GT(soft, 1e-5);
  EXPECT_NEAR(soft / stiff, 10.0, 0.1);
}

// It holds at the law's null value, and where no effect sits; in a start from sensors it has its length.
TEST_F(StretchedRod, HoldsUntilAnEffectLetsGo) {
  Plant rigid(pulled({use_of("cable_stretch", {effects::kInfinity, 0.0})}), {});
  EXPECT_TRUE(rigid.has_loops());
  EXPECT_THAT(rigid.model().places(effects::Place::ratio), testing::ElementsAre("loop"));
  EXPECT_FALSE(rigid.model().place_is_angular(effects::Place::ratio, "loop"));
  EXPECT_EQ(rigid.motion_at(effects::Place::ratio, "loop", rigid.home().data()).position, 0.0);
  Plant loose(pulled({use_of("cable_stretch", {kStiffness, kDamping})}), {});
  const PositionsFrom seen(loose, {observe_place(loose, "j_crank", 1e-4)});
  EXPECT_TRUE(seen.determined());
  const Eigen::VectorXd z = seen.positions(Eigen::MatrixXd::Constant(1, 1, 0.8));
  Eigen::VectorXd x = Eigen::VectorXd::Zero(4);
  x.head(2) = z;
  EXPECT_NEAR(z[0], 0.8, 1e-12);
  EXPECT_NEAR(ByHand(x).stretch, 0.0, 1e-12);
  // Both ends seen: the rod's length is what is left between them.
  const PositionsFrom both(loose,
                           {observe_place(loose, "j_crank", 1e-4), observe_place(loose, "j_slider", 1e-4)});
  EXPECT_GT(both.deviations().minCoeff(), 0.9e-4);
}

// A brace that nothing can move while it holds; when it stretches the linkage's own loop goes on holding.
TEST_F(StretchedRod, LeavesOtherLoopsClosed) {
  Model model = test::four_bar();
  model.loops.front().name = "pin";
  model.loops.push_back(test::loop(Loop::Type::rod, {-1, {0.1, 0, 1.4}}, {1, {0.2, 0, 0}}, 0.25));
  EXPECT_THROW(Plant(model, {}), InputError);
  model.effects = {use_of("cable_stretch", {kStiffness, 0.0})};
  Plant plant(model, {});
  EXPECT_TRUE(plant.has_loops());
  EXPECT_EQ(plant.holding()->size() + 1, plant.closure()->size());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(6);
  x.head(3) = plant.home();
  EXPECT_NEAR(plant.motion_at(effects::Place::ratio, "loop", x.data()).position, 0.0, 1e-12);
  const double before = plant.energetics(x.data(), nullptr).stored;
  integrate::PlantOde ode(plant, false, false);
  integrate::Options options;
  options.set_tolerance(1e-10);
  integrate::Integrator integrator(ode, options);
  integrator.start(0.0, x);
  integrator.advance(0.5);
  x = integrator.state();
  EXPECT_GT(std::abs(plant.motion_at(effects::Place::ratio, "loop", x.data()).position), 1e-5);
  EXPECT_LT(plant.loop_errors(x.data()).maxCoeff(), 1e-9);
  EXPECT_NEAR(plant.energetics(x.data(), nullptr).stored, before, 1e-7);
}

}  // namespace
}  // namespace plumbline::model
