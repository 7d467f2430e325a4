// The linearisation of a robot that stands on the ground, against differences of its rates.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "simulator/model/known_effects.h"
#include "simulator/model/plant.h"
#include "simulator/model/robot_file.h"

namespace plumbline::model {
namespace {

/// Both feet about a millimetre in the ground, everything in motion.
class GroundSlopes : public testing::TestWithParam<std::string> {
 protected:
  GroundSlopes() : plant_(read_model(PLUMBLINE_ROOT "/robots/mabel/" + GetParam(), known_effects()), {}) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> spread(-0.2, 0.2);
    x_ = Eigen::VectorXd::Zero(plant_.states());
    const Eigen::Index n = plant_.positions();
    x_[0] = 0.4;
    x_.segment(3, 4) << 0.2, -0.3, -0.1, -0.35;  // hips and knees
    x_.segment(n, n) = Eigen::VectorXd::NullaryExpr(n, [&]() { return spread(random); });
    for (int round = 0; round < 20; ++round) {
      const double depth =
          std::min(plant_.foot_depth(0, x_.data()).depth, plant_.foot_depth(1, x_.data()).depth);
      x_[1] += (depth - 1e-3) / -plant_.depth_slope(0, x_.data())[1];
    }
    for (const char* name : {"bsp_left", "bsp_right"}) {  // off the edge of the stop, where slopes jump
      for (Eigen::Index i = 0; i < n; ++i) {
        if (plant_.state_names()[static_cast<std::size_t>(i)] == std::string("position of ") + name) {
          x_[i] = 0.05;
        }
      }
    }
    commands_ = Eigen::VectorXd::Constant(plant_.motors(), 0.7);
  }

  Eigen::VectorXd rate(const Eigen::VectorXd& x) {
    Eigen::VectorXd xdot = Eigen::VectorXd::Zero(x.size());
    plant_.rate(x.data(), commands_.data(), xdot.data());
    return xdot;
  }

  void linearise(const std::vector<ParameterId>& parameters) {
    linearise_over(Eigen::VectorXd::Zero(plant_.states()), parameters);
  }

  void linearise_over(const Eigen::VectorXd& change, const std::vector<ParameterId>& parameters) {
    const Eigen::VectorXd held = Eigen::VectorXd::Zero(plant_.motors());
    const SampleMotion sample{x_.data(), change.data(), commands_.data(), held.data(), 1e-3};
    plant_.tangent(sample, parameters,
                   Eigen::VectorXd::Constant(static_cast<Eigen::Index>(parameters.size()), 1e-6), true, A_,
                   B_);
  }

  Plant plant_;
  Eigen::VectorXd x_, commands_;
  Eigen::MatrixXd A_, B_;
};

TEST_P(GroundSlopes, AreThoseOfTheRates) {
  ASSERT_GT(plant_.foot_depth(0, x_.data()).depth, 0.0);
  ASSERT_GT(plant_.foot_depth(1, x_.data()).depth, 0.0);
  linearise({});
  for (Eigen::Index i = 0; i < x_.size(); ++i) {
    const double step = i < plant_.positions() ? 1e-8 : 1e-7;
    Eigen::VectorXd moved = x_;
    moved[i] = x_[i] + step;
    const Eigen::VectorXd up = rate(moved);
    moved[i] = x_[i] - step;
    const Eigen::VectorXd expected = (up - rate(moved)) / (2.0 * step);
    EXPECT_LT((A_.col(i) - expected).norm(), 1e-5 * expected.norm() + 0.2)
        << plant_.state_names()[static_cast<std::size_t>(i)] << ": " << expected.norm();
  }
}

// The integrator lands in steps of a nanometre: the jump of the bristles' rate counts whole on each.
TEST_P(GroundSlopes, HoldTheJumpOfTheBristlesWhereAFootLands) {
  constexpr double kWay = 1e-9;  // m
  for (int round = 0; round < 20; ++round) {
    x_[1] += plant_.foot_depth(0, x_.data()).depth / -plant_.depth_slope(0, x_.data())[1];
  }
  const Eigen::Index bristles = plant_.states() - 2 * plant_.positions();
  x_.tail(bristles).setConstant(1e-3);  // bent, so that they straighten in the air
  Eigen::VectorXd change = Eigen::VectorXd::Zero(plant_.states());
  change[1] = kWay / plant_.depth_slope(0, x_.data())[1];
  linearise_over(change, {});
  const Eigen::VectorXd jump = rate(x_ + 0.5 * change) - rate(x_ - 0.5 * change);
  EXPECT_GT(jump.tail(bristles).norm(), 0.05);  // m/s
  EXPECT_LT((A_ * change - jump).tail(bristles).norm(), 1e-3 * jump.tail(bristles).norm());
}

class GroundSlopesByTheBoom : public GroundSlopes {};

TEST_P(GroundSlopesByTheBoom, AreThoseOfTheRates) {
  const int effect = static_cast<int>(plant_.model().effects.size()) - 1;
  ASSERT_EQ(plant_.model().effects.back().law->declaration().name, "boom");
  const std::vector<ParameterId> parameters{{effect, 0}, {effect, 1}};
  linearise(parameters);
  const Eigen::RowVectorXd depth = plant_.depth_slope(1, x_.data(), parameters);
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const double step = 1e-6;
    const double here = plant_.value(parameters[p]);
    plant_.set_value(parameters[p], here + step);
    const Eigen::VectorXd up = rate(x_);
    const double deeper = plant_.foot_depth(1, x_.data()).depth;
    plant_.set_value(parameters[p], here - step);
    const Eigen::VectorXd expected = (up - rate(x_)) / (2.0 * step);
    const double expected_depth = (deeper - plant_.foot_depth(1, x_.data()).depth) / (2.0 * step);
    plant_.set_value(parameters[p], here);
    const auto column = static_cast<Eigen::Index>(p);
    EXPECT_GT(expected.norm(), 1.0);
    EXPECT_LT((B_.col(column) - expected).norm(), 1e-4 * expected.norm());
    EXPECT_NEAR(depth[column], expected_depth, 1e-5 * std::abs(expected_depth));
  }
}

INSTANTIATE_TEST_SUITE_P(Mabel, GroundSlopes,
                         testing::Values("mabel_planar.yaml", "mabel.yaml", "mabel_planar_boom.yaml"),
                         [](const auto& one) { return one.param.substr(0, one.param.find('.')); });

INSTANTIATE_TEST_SUITE_P(Mabel, GroundSlopesByTheBoom, testing::Values("mabel_planar_boom.yaml"),
                         [](const auto&) { return "mabel_planar_boom"; });

}  // namespace
}  // namespace plumbline::model
