// Laws that the hopping robot must obey whatever its controller does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/control/gait/mabel_hops.h"

namespace plumbline::validation {
namespace {

constexpr double kBoom = 2.25, kPivot = 1.0, kHalfHip = 0.1, kLink = 0.5;  // m, mabel.sdf

integrate::Options tight(double tolerance) {
  integrate::Options options;
  options.method = integrate::Method::rosenbrock;
  options.relative_tolerance = tolerance;
  options.absolute_tolerance = Eigen::VectorXd::Constant(1, 1e-2 * tolerance);
  return options;
}

/// A hopping robot at its start, sample by sample.
class Hopper {
 public:
  Hopper(const std::string& model, double tolerance, const HopStart& start = {}, bool energy = false)
      : loaded_(hopping(mabel(model), start)),
        sampled_(loaded_.model, {}, &*loaded_.controller, options(tolerance, energy)) {
    sampled_.start(run::state_at_start(loaded_.model, loaded_.scenario));
  }
  run::SampledRun& operator*() { return sampled_; }
  run::SampledRun* operator->() { return &sampled_; }
  double time() const { return sampled_.simulation().time(); }
  Eigen::VectorXd state() const { return sampled_.simulation().state(); }
  double phase() const { return sampled_.controller()->log()[0]; }

 private:
  static run::SampledOptions options(double tolerance, bool energy) {
    run::SampledOptions options;
    options.integrator = tight(tolerance);
    options.energy = energy;
    return options;
  }

  run::LoadedScenario loaded_;
  run::SampledRun sampled_;
};

class HopPhysics : public testing::TestWithParam<const char*> {};

// Stored energy of links, gravity, springs, cables and ground = what the motors put in less what friction,
// dampers, stops and ground took, from the drop over landing and kickoff to the next flight.
TEST_P(HopPhysics, TheAccountOfEnergyClosesOverAHop) {
  Hopper s(GetParam(), 1e-6, {}, true);
  bool landed = false, flown = false;
  while (s.time() < 0.7) {
    s->sample();
    s->advance();
    landed = landed || s.phase() == 2.0;  // II
    flown = flown || s.phase() == 6.0;    // V
  }
  s->sample();
  EXPECT_TRUE(landed && flown);
  const double error = s->simulation().energy_error();
  const double exchanged = s->simulation().energy_exchanged();
  std::printf("%s: %.2g J of %.4g J missing, %ld steps\n", GetParam(), error, exchanged,
              s->simulation().summary().steps);
  EXPECT_GT(exchanged, 100.0);
  EXPECT_LT(std::abs(error) / exchanged, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Mabel, HopPhysics, testing::Values("mabel_planar.yaml", "mabel.yaml"),
                         [](const auto& tested) {
                           return std::string(tested.param) == "mabel.yaml" ? "boom" : "plane";
                         });

/// The tower's generalised momentum: with it cyclic, the angular momentum about the vertical through the
/// pivot. Kinetic energy is quadratic, so the difference is exact.
double tower_momentum(Hopper& s) {
  model::Plant& plant = s->plant();
  const Eigen::Index n = plant.positions();
  const int tower = plant.model().sensor_index("tower");
  const Eigen::VectorXd unit = plant.output_map().completeOrthogonalDecomposition().solve(
      Eigen::VectorXd::Unit(plant.sensors(), tower));
  Eigen::VectorXd up = s.state(), down = s.state();
  up.segment(n, n) += unit;
  down.segment(n, n) -= unit;
  return 0.5 * (plant.energetics(up.data(), s->command().data()).stored -
                plant.energetics(down.data(), s->command().data()).stored);
}

// The tower turns without friction and gravity is vertical: only the ground can change the angular momentum
// about the tower's axis, however the motors swing the legs.
TEST(BoomPhysics, AngularMomentumAboutTheTowerIsConservedInFlight) {
  Hopper s("mabel.yaml", 1e-8, {0.3, -0.3, 0.3});  // leaning back: the legs have to swing
  const double before = tower_momentum(s);
  const double rate_before = s->plant().velocity_of("tower", s.state().data());
  double largest = 0.0, turned = 0.0;
  while (s.time() < 0.15) {
    s->sample();
    ASSERT_LT(std::max(s->simulation().touches()[0].depth, s->simulation().touches()[1].depth), 0.0);
    s->advance();
    largest = std::max(largest, std::abs(tower_momentum(s) - before));
    turned = std::max(turned, std::abs(s->plant().velocity_of("tower", s.state().data()) - rate_before));
  }
  std::printf("angular momentum %.6g kg m^2/s, changed by %.2g; rate changed by %.2g rad/s\n", before,
              largest, turned);
  EXPECT_LT(largest, 1e-7 * std::abs(before));
  EXPECT_GT(turned, 1e-3);  // the rate itself does change
}

/// Closed form of a foot at the boom: turns of the tower about z and of the boom about -x, then the leg in
/// the plane across the boom.
Eigen::Vector3d foot_of(const model::Plant& plant, const double* x, const std::string& side) {
  const auto angle = [&](const std::string& name) { return plant.position_of(name, x); };
  const double across = side == "left" ? kHalfHip : -kHalfHip;
  const double thigh = angle("torso") + angle("thigh_" + side);
  const double shin = angle("torso") + angle("shin_" + side);
  const Eigen::Vector3d at_boom(kLink * (std::sin(thigh) + std::sin(shin)), across - kBoom,
                                -kLink * (std::cos(thigh) + std::cos(shin)));
  const double pitch = angle("boom_pitch"), tower = angle("tower");
  const Eigen::Vector3d lifted(at_boom.x(), std::cos(pitch) * at_boom.y() + std::sin(pitch) * at_boom.z(),
                               -std::sin(pitch) * at_boom.y() + std::cos(pitch) * at_boom.z());
  return {std::cos(tower) * lifted.x() - std::sin(tower) * lifted.y(),
          std::sin(tower) * lifted.x() + std::cos(tower) * lifted.y(), kPivot + lifted.z()};
}

// The boom is a chain of joints and rigid ratios are eliminated, so nothing can drift: after a hop the feet
// are where the closed form has them, and the hip is one boom's length from the pivot by construction.
TEST(BoomPhysics, TheClosureOfTheBoomDoesNotDrift) {
  Hopper s("mabel.yaml", 1e-5);
  double drift = 0.0, ratio = 0.0;
  while (s.time() < 0.8) {
    s->sample();
    const Eigen::VectorXd x = s.state();
    for (std::size_t f = 0; f < 2; ++f) {
      const std::string side = s->plant().model().feet[f].name;
      drift = std::max(drift,
                       (s->simulation().touches()[f].position - foot_of(s->plant(), x.data(), side)).norm());
      ratio = std::max(ratio, std::abs(s->plant().position_of("csp_" + side, x.data()) -
                                       2.0 * s->plant().position_of("leg_shape_" + side, x.data())));
    }
    s->advance();
  }
  std::printf("feet off by %.2g m, C_Spring by %.2g rad\n", drift, ratio);
  EXPECT_LT(drift, 1e-9);
  EXPECT_LT(ratio, 1e-9);
}

/// Figure 16: one leg straight down with its motor held, the other folded and tied, the torso balanced by
/// hand.
struct Standing {
  double leg_shape = 0.0, deflection = 0.0, weight = 0.0;  // rad, rad, N
};

/// A hand that keeps the hip from bobbing; at rest it does nothing.
model::Model steadied(model::Model model) {
  model::Quantity damping;
  damping.value = 700.0;
  damping.source = "a fraction of critical for 65 kg on the leg";
  model.effects.push_back({model::known_effects().find("viscous"), "hip_z", {damping}, 0});
  return model;
}

Standing stand(const model::Model& unsteady, const std::string& leg, double motor_shape) {
  const model::Model model = steadied(unsteady);
  const std::string other = leg == "left" ? "right" : "left";
  const double folded = 1.2;
  model::Plant plant(model, {{"torso", 0.0},
                             {"hip_x", 0.0},
                             {"leg_angle_" + leg, 0.0},
                             {"mLA_" + leg, 0.0},
                             {"mLS_" + leg, 31.42 * motor_shape},
                             {"leg_angle_" + other, 0.0},
                             {"mLA_" + other, 0.0},
                             {"leg_shape_" + other, folded},
                             {"mLS_" + other, 31.42 * folded},
                             {"bsp_" + other, 0.0}});
  integrate::PlantOde ode(plant, false, false);
  integrate::Integrator integrator(ode, tight(1e-5));
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  // Lowered until the foot touches: the first position with a foot on the ground, springs and cables slack.
  const Eigen::Index n = plant.positions();
  Eigen::MatrixXd C(3, n);
  Eigen::VectorXd y(3);
  const std::vector<std::string> names{"leg_shape_" + leg, "bsp_" + leg, "hip_z"};
  const std::vector<double> values{motor_shape, 0.0, 2.0 * kLink * std::cos(motor_shape)};
  for (Eigen::Index r = 0; r < 3; ++r) {
    const std::string& name = names[static_cast<std::size_t>(r)];
    y[r] = values[static_cast<std::size_t>(r)] - plant.position_of(name, x.data());
    for (Eigen::Index i = 0; i < n; ++i) {
      x[n + i] = 1.0;
      C(r, i) = plant.velocity_of(name, x.data());
      x[n + i] = 0.0;
    }
  }
  x.head(n) = C.completeOrthogonalDecomposition().solve(y);
  integrator.start(0.0, x);
  integrator.advance(3.0);
  x = integrator.state();
  EXPECT_LT(x.segment(n, n).norm(), 1e-3) << "at rest";
  const std::vector<model::Touch> touches = plant.touches(x.data());
  return {plant.position_of("leg_shape_" + leg, x.data()), plant.position_of("bsp_" + leg, x.data()),
          touches[leg == "left" ? 0 : 1].force.z()};
}

/// Slope and intercept of equation 22's torque, W sin(q_LS)/5.18, over the deflection, as fitted in
/// Figure 17.
Eigen::Vector2d fit_spring(const model::Model& model, const std::string& leg) {
  Eigen::MatrixXd A(4, 2);
  Eigen::VectorXd b(4);
  for (Eigen::Index k = 0; k < 4; ++k) {
    const double degrees = 8.0 + 5.0 * static_cast<double>(k);
    const Standing standing = stand(model, leg, degrees * 3.14159265358979323846 / 180.0);
    A.row(k) << standing.deflection, 1.0;
    b[k] = standing.weight * std::sin(standing.leg_shape) / 5.18;
  }
  return A.colPivHouseholderQr().solve(b);
}

/// The links below and beside the hip without weight, theirs on the torso: what equation 19 takes for
/// granted.
model::Model with_weightless_legs(model::Model model) {
  double moved = 0.0;
  for (model::Body& body : model.skeleton.bodies) {
    if (body.name.find("_left") != std::string::npos || body.name.find("_right") != std::string::npos) {
      moved += body.mass * (1.0 - 1e-2);
      body.inertia *= 1e-2;
      body.mass *= 1e-2;
    }
  }
  for (model::Body& body : model.skeleton.bodies) {
    body.mass += body.name == "torso_link" ? moved : 0.0;
  }
  return model;
}

TEST(SpringExperiment, ReturnsTheSpringsOfFigure17) {
  const model::Model model = with_weightless_legs(mabel("mabel_planar.yaml"));
  const Eigen::Vector2d left = fit_spring(model, "left"), right = fit_spring(model, "right");
  std::printf("weightless legs: left %.2f N m/rad and %.3f N m, right %.2f and %.3f\n", left[0], left[1],
              right[0], right[1]);
  EXPECT_NEAR(left[0], 115.1, 0.005 * 115.1);
  EXPECT_NEAR(right[0], 111.7, 0.005 * 111.7);
  EXPECT_NEAR(left[1], 2.214, 0.05);
  EXPECT_NEAR(right[1], 5.377, 0.05);
}

// Equation 19 has the whole weight act at the hip. The standing leg's own weight does not: less torque than
// it says.
TEST(SpringExperiment, TheLegsOwnWeightMakesTheSpringLookStiffer) {
  const Eigen::Vector2d left = fit_spring(mabel("mabel_planar.yaml"), "left");
  std::printf("whole robot: left %.2f N m/rad and %.3f N m\n", left[0], left[1]);
  EXPECT_GT(left[0], 115.1);
  EXPECT_LT(left[0], 1.08 * 115.1);
}

}  // namespace
}  // namespace plumbline::validation
