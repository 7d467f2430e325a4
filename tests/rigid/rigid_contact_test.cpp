// MABEL on rigid ground: energy on a pinned foot, momentum through an impact, and where a foot lifts off.
#include "simulator/model/rigid_contact.h"

#include <gtest/gtest.h>

#include "simulator/integrate/rigid_contact_ode.h"
#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"

namespace plumbline::rigid_tests {
namespace {

model::Model on_rigid_ground(const std::string& file) {
  model::Model model = model::read_model(PLUMBLINE_ROOT "/robots/" + file, model::known_effects());
  const auto of_the_ground = [](const model::EffectUse& use) {
    return use.law->sits_at(effects::Place::foot);
  };
  model.effects.erase(std::remove_if(model.effects.begin(), model.effects.end(), of_the_ground),
                      model.effects.end());
  return model;
}

Eigen::VectorXd standing(const model::Plant& plant) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  for (int i = 0; i < plant.positions(); ++i) {
    x[i] = 0.1 * std::sin(3.0 * i + 1.0);
    x[plant.positions() + i] = 0.3 * std::cos(2.0 * i);
  }
  return x;
}

TEST(RigidContact, KeepsTheEnergyOfAPinnedPhase) {
  model::Plant plant(on_rigid_ground("mabel/mabel_planar_rigid.yaml"), {});
  model::RigidContact contact(plant);
  Eigen::VectorXd x = standing(plant);
  const model::Holds holds{{0}, {"bsp_right"}};
  contact.strike(holds, x.data());
  contact.hold(holds, x.data());
  const Eigen::Vector3d where = contact.kinematics().foot(0, x.data()).position;
  integrate::RigidContactOde ode(plant, contact, [](double t, const double* /*x*/, double* u) {
    u[0] = 4.0 * std::sin(9.0 * t);
    u[1] = -6.0;
    u[2] = 2.0;
    u[3] = std::cos(7.0 * t);
  });
  integrate::Options options;
  options.set_tolerance(1e-8);
  integrate::Integrator integrator(ode, options);
  Eigen::VectorXd start = Eigen::VectorXd::Zero(ode.size());
  start.head(x.size()) = x;
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(plant.motors());
  const double before = plant.energetics(x.data(), none.data()).stored;
  integrator.start(0.0, start);
  integrator.advance(0.1);
  const Eigen::VectorXd& end = integrator.state();
  const double after = plant.energetics(end.data(), none.data()).stored;
  const double work = end[plant.states()];
  const double dissipated = end[plant.states() + 1];
  EXPECT_GT(std::abs(work), 0.1);
  EXPECT_NEAR(after - before, work - dissipated, 1e-6 * (std::abs(work) + dissipated));
  EXPECT_LT((contact.kinematics().foot(0, end.data()).position - where).norm(), 1e-12);
  EXPECT_LT(contact.kinematics().foot(0, end.data()).velocity.norm(), 1e-11);
}

// What the ground gives is all that changes the robot's momentum: M (w+ - w-) = J' Lambda read along hip_x
// and hip_z, which carry everything. The boom's inertia is part of it. And the energy that is lost is what
// the account says.
TEST(RigidContact, BalancesMomentumAndEnergyOfAnImpact) {
  model::Plant plant(on_rigid_ground("mabel/mabel_planar_rigid.yaml"), {});
  model::RigidContact contact(plant);
  const Eigen::VectorXd before = standing(plant);
  Eigen::VectorXd after = before;
  const model::RigidContact::Blow blow = contact.strike({{1}, {"bsp_left"}}, after.data());
  Eigen::VectorXd scratch = before;
  const Eigen::VectorXd no_torque = Eigen::VectorXd::Zero(plant.motors());
  plant.rate(before.data(), no_torque.data(), scratch.data());
  const Eigen::MatrixXd M = plant.mass_matrix();
  const int n = plant.positions();
  const Eigen::VectorXd momentum = M * (after - before).tail(n);
  EXPECT_NEAR(contact.kinematics().row_of("hip_x").dot(momentum), blow.feet[0].x(), 1e-10);
  EXPECT_NEAR(contact.kinematics().row_of("hip_z").dot(momentum), blow.feet[0].z(), 1e-10);
  EXPECT_GT(blow.feet[0].norm(), 0.1);
  EXPECT_LT(contact.kinematics().foot(1, after.data()).velocity.norm(), 1e-12);
  EXPECT_NEAR(plant.velocity_of("bsp_left", after.data()), 0.0, 1e-12);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(plant.motors());
  const double lost = plant.energetics(before.data(), none.data()).stored -
                      plant.energetics(after.data(), none.data()).stored;
  EXPECT_NEAR(blow.lost, lost, 1e-9);
  EXPECT_GT(lost, 0.0);
}

// The normal force as a switching function: the hopper pushed off its foot by its spring leaves the ground
// when the spring stops pressing more than the foot weighs.
TEST(RigidContact, FindsWhereAFootLiftsOff) {
  model::Plant plant(on_rigid_ground("hopper/hopper.yaml"), {});
  model::RigidContact contact(plant);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  const int height =
      static_cast<int>(contact.kinematics().row_of("height").cwiseAbs().maxCoeff() > 0.5 ? 0 : 1);
  x[height] = -0.03;
  Eigen::VectorXd spring = contact.kinematics().row_of("spring").transpose();
  x.head(plant.positions()) += 0.04 * spring;
  contact.hold({{0}, {}}, x.data());
  contact.project(x.data());
  Eigen::VectorXd scratch(plant.states());
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(plant.motors());
  const auto pressing = [&](const double* at) {
    contact.rate(at, none.data(), scratch.data());
    return contact.foot_force(0).z();
  };
  ASSERT_GT(pressing(x.data()), 50.0);
  integrate::RigidContactOde ode(
      plant, contact, [](double, const double*, double* u) { u[0] = 0.0; }, 1,
      [&](double /*t*/, const double* at, double* g) { g[0] = pressing(at); });
  integrate::Options options;
  options.set_tolerance(1e-8);
  integrate::Integrator integrator(ode, options);
  Eigen::VectorXd start = Eigen::VectorXd::Zero(ode.size());
  start.head(x.size()) = x;
  integrator.start(0.0, start);
  integrator.advance(0.5);
  ASSERT_FALSE(integrator.events().empty());
  const Eigen::VectorXd at = integrator.events().front().state;
  EXPECT_NEAR(pressing(at.data()), 0.0, 1e-3);
  EXPECT_GT(integrator.events().front().time, 0.02);
}

TEST(RigidContact, RefusesWhatItDoesNotKnow) {
  model::Plant plant(on_rigid_ground("mabel/mabel_planar_rigid.yaml"), {});
  model::RigidContact contact(plant);
  const Eigen::VectorXd x = standing(plant);
  EXPECT_THROW(contact.hold({{2}, {}}, x.data()), std::out_of_range);
  EXPECT_ANY_THROW(contact.hold({{0}, {"bsp_middle"}}, x.data()));
}

}  // namespace
}  // namespace plumbline::rigid_tests
