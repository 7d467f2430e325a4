// The project's rigid bodies against Simbody's, for every robot that ships: accelerations with and without
// pinned feet, the feet's reactions, and the impact's impulses.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "simulator/model/known_effects.h"
#include "simulator/model/rigid_contact.h"
#include "simulator/model/robot_file.h"
#include "tests/rigid/simbody_machine.h"
#include "tests/robots/shipped.h"

namespace plumbline::rigid_tests {
namespace {

// Simbody solves M and constraints together in coordinates of its own; gears of 31 and rotors of 1e-4 kg m^2
// beside links of 40 kg cost it four to five digits of the sixteen.
constexpr double kRelative = 1e-9;

class EveryRobot : public testing::TestWithParam<std::string> {
 protected:
  EveryRobot() : model_(model::read_model(GetParam(), model::known_effects())) {
    model_.effects.clear();  // Simbody is to know masses, gears and gravity only
    for (model::Motor& motor : model_.motors) {
      motor.torque_limit.value = 0.0;  // none: random commands are larger
    }
    plant_ = std::make_unique<model::Plant>(model_, std::vector<model::Lock>{});
    kinematics_ = std::make_unique<model::FootKinematics>(*plant_);
    draw();
  }

  void draw() {
    std::uniform_real_distribution<double> spread(-0.6, 0.6);
    x_ = Eigen::VectorXd::NullaryExpr(plant_->states(), [&]() { return spread(random_); });
    x_.tail(plant_->positions()) *= 3.0;
    torques_ = Eigen::VectorXd::NullaryExpr(plant_->motors(), [&]() { return 10.0 * spread(random_); });
  }

  /// The axes in which a foot can move at all: a robot in the plane has two.
  std::vector<std::vector<int>> axes_of(const std::vector<int>& feet) {
    std::vector<std::vector<int>> all;
    for (const int foot : feet) {
      const Eigen::MatrixXd J = kinematics_->foot(foot, x_.data()).jacobian;
      all.emplace_back();
      for (int axis = 0; axis < 3; ++axis) {
        if (J.row(axis).norm() > 1e-9) {
          all.back().push_back(axis);
        }
      }
    }
    return all;
  }

  /// Feet alone and in pairs, where the rows that hold them are independent: what single forces do is then
  /// one answer.
  std::vector<std::vector<int>> ways_to_stand() {
    std::vector<std::vector<int>> ways;
    const int feet = static_cast<int>(model_.feet.size());
    for (int foot = 0; foot < feet; ++foot) {
      for (int other = foot; other < feet; ++other) {
        std::vector<int> way{foot};
        if (other != foot) {
          way.push_back(other);
        }
        Eigen::MatrixXd J(0, plant_->positions());
        Eigen::Index rows = 0;
        const auto axes = axes_of(way);
        for (std::size_t f = 0; f < way.size(); ++f) {
          for (const int axis : axes[f]) {
            J.conservativeResize(rows + 1, Eigen::NoChange);
            J.row(rows++) = kinematics_->foot(way[f], x_.data()).jacobian.row(axis);
          }
        }
        if (Eigen::JacobiSVD<Eigen::MatrixXd>(J).singularValues().tail<1>()[0] > 1e-3) {
          ways.push_back(way);
        }
      }
    }
    return ways;
  }

  std::map<std::string, std::pair<double, double>> states() const {
    std::map<std::string, std::pair<double, double>> all;
    for (const std::string& name : names()) {
      all[name] = {plant_->position_of(name, x_.data()), plant_->velocity_of(name, x_.data())};
    }
    return all;
  }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const model::Joint& joint : model_.skeleton.joints) {
      if (joint.type != model::JointType::fixed) {
        all.push_back(joint.name);
      }
    }
    for (const model::Motor& motor : model_.motors) {
      all.push_back(motor.name);
    }
    for (const model::Pulley& pulley : model_.pulleys) {
      all.push_back(pulley.name);
    }
    return all;
  }

  /// Of dw/dt (or w after an impact) and the feet's forces; each against the largest of its kind.
  double difference(const Eigen::VectorXd& w, const std::vector<Eigen::Vector3d>& at_feet,
                    const std::vector<std::vector<int>>& axes, const SimbodyMachine::Answer& expected) const {
    double largest = 1e-6;
    double worst = 0.0;
    for (const auto& [name, value] : expected.coordinate) {
      largest = std::max(largest, std::abs(value));
      worst = std::max(worst, std::abs(value - kinematics_->row_of(name).dot(w)));
    }
    worst /= largest;
    double off = 0.0;
    Eigen::Index row = 0;
    for (std::size_t f = 0; f < axes.size(); ++f) {
      for (const int axis : axes[f]) {
        off = std::max(off, std::abs(expected.at_feet[row++] - at_feet[f][axis]));
      }
    }
    return row == 0 ? worst : std::max(worst, off / expected.at_feet.cwiseAbs().maxCoeff());
  }

  std::mt19937_64 random_{42};
  model::Model model_;
  std::unique_ptr<model::Plant> plant_;
  std::unique_ptr<model::FootKinematics> kinematics_;
  Eigen::VectorXd x_, torques_;
};

// Commands of a motor in volts or amperes become torques in the plant alone.
Eigen::VectorXd delivered(const model::Plant& plant, const Eigen::VectorXd& commands) {
  Eigen::VectorXd torques = commands;
  for (int m = 0; m < plant.motors(); ++m) {
    torques[m] *= plant.torque_gain(m);
  }
  return torques;
}

TEST_P(EveryRobot, MovesAsInSimbody) {
  SimbodyMachine simbody(model_, {}, {});
  double worst = 0.0;
  for (int state = 0; state < 10; ++state) {
    draw();
    simbody.set(states());
    Eigen::VectorXd rate = Eigen::VectorXd::Zero(plant_->states());
    plant_->rate(x_.data(), torques_.data(), rate.data());
    worst = std::max(worst, difference(rate.tail(plant_->positions()), {}, {},
                                       simbody.accelerate(delivered(*plant_, torques_))));
  }
  RecordProperty("worst", fmt::format("{:.1e}", worst));
  EXPECT_LT(worst, kRelative);
}

TEST_P(EveryRobot, StandsAsInSimbody) {
  if (model_.feet.empty()) {
    GTEST_SKIP() << "no feet";
  }
  double worst = 0.0;
  for (const std::vector<int>& feet : ways_to_stand()) {
    const auto axes = axes_of(feet);
    SimbodyMachine simbody(model_, feet, axes);
    model::RigidContact contact(*plant_);
    for (int state = 0; state < 10; ++state) {
      draw();
      contact.strike({feet, {}}, x_.data());  // velocities that the pins allow
      contact.hold({feet, {}}, x_.data());
      simbody.set(states());
      Eigen::VectorXd rate = Eigen::VectorXd::Zero(plant_->states());
      contact.rate(x_.data(), torques_.data(), rate.data());
      std::vector<Eigen::Vector3d> forces;
      for (int f = 0; f < static_cast<int>(feet.size()); ++f) {
        forces.push_back(contact.foot_force(f));
      }
      worst = std::max(worst, difference(rate.tail(plant_->positions()), forces, axes,
                                         simbody.accelerate(delivered(*plant_, torques_))));
    }
  }
  RecordProperty("worst", fmt::format("{:.1e}", worst));
  EXPECT_LT(worst, kRelative);
}

TEST_P(EveryRobot, IsStruckAsInSimbody) {
  if (model_.feet.empty()) {
    GTEST_SKIP() << "no feet";
  }
  double worst = 0.0;
  for (const std::vector<int>& feet : ways_to_stand()) {
    const auto axes = axes_of(feet);
    SimbodyMachine simbody(model_, feet, axes);
    model::RigidContact contact(*plant_);
    for (int state = 0; state < 10; ++state) {
      draw();
      simbody.set(states());
      const SimbodyMachine::Answer expected = simbody.strike();
      const model::RigidContact::Blow blow = contact.strike({feet, {}}, x_.data());
      worst = std::max(worst, difference(x_.tail(plant_->positions()), blow.feet, axes, expected));
    }
  }
  RecordProperty("worst", fmt::format("{:.1e}", worst));
  EXPECT_LT(worst, kRelative);
}

INSTANTIATE_TEST_SUITE_P(Shipped, EveryRobot, testing::ValuesIn(shipped_robots()), robot_label);

}  // namespace
}  // namespace plumbline::rigid_tests
