// The search without derivatives, fixed points of maps, and drawn robots.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/hopping/cma_search.h"
#include "validation/hopping/drawn_models.h"
#include "validation/hopping/fixed_point.h"
#include "validation/hopping/hop_search.h"
#include "validation/hopping/hopping_file.h"
#include "validation/predict/problem.h"

namespace plumbline::validation {
namespace {

// The minimum of an ellipsoid with a ratio of axes of 1000, turned against the axes.
TEST(CmaSearch, FindsTheMinimumOfANarrowEllipsoid) {
  const Eigen::Index n = 5;
  Eigen::VectorXd target(n);
  target << 1.0, -2.0, 0.5, 3.0, -1.0;
  const auto cost = [&](const Eigen::VectorXd& x) {
    const Eigen::VectorXd d = x - target;
    double sum = std::pow(d.sum(), 2);
    for (Eigen::Index i = 0; i < n; ++i) {
      sum += std::pow(10.0, 6.0 * static_cast<double>(i) / static_cast<double>(n - 1)) *
             std::pow(d[i] - (i > 0 ? d[i - 1] : 0.0), 2);
    }
    return sum;
  };
  CmaSearch search(Eigen::VectorXd::Zero(n), 0.5, 0, 7);
  EXPECT_EQ(search.population(), 8);
  for (int generation = 0; generation < 600; ++generation) {
    const Eigen::MatrixXd candidates = search.ask();
    Eigen::VectorXd costs(candidates.cols());
    for (Eigen::Index k = 0; k < candidates.cols(); ++k) {
      costs[k] = cost(candidates.col(k));
    }
    search.tell(costs);
  }
  EXPECT_LT((search.mean() - target).norm(), 1e-6);
  EXPECT_LT(search.width(), 1e-3);
}

TEST(CmaSearch, CanBeRepeatedAndRefusesNonsense) {
  CmaSearch one(Eigen::VectorXd::Zero(3), 0.3, 0, 4), same(Eigen::VectorXd::Zero(3), 0.3, 0, 4),
      other(Eigen::VectorXd::Zero(3), 0.3, 0, 5);
  const Eigen::MatrixXd first = one.ask();
  EXPECT_EQ(first, same.ask());
  EXPECT_NE(first, other.ask());
  EXPECT_THROW(CmaSearch(Eigen::VectorXd(), 0.3, 0, 1), std::invalid_argument);
  EXPECT_THROW(CmaSearch(Eigen::VectorXd::Zero(2), 0.0, 0, 1), std::invalid_argument);
  EXPECT_THROW(CmaSearch(Eigen::VectorXd::Zero(2), 0.3, 3, 1), std::invalid_argument);
}

// u1' = 1 + 1.5 (u1 - 1) + (u1 - 1)^2, u2' = 2 + 0.2 (u2 - 2) - 0.5 (u1 - 1): fixed point (1, 2), slope
// [[1.5, 0], [-0.5, 0.2]], multipliers 1.5 and 0.2, with jumps of 1e-4 as counts leave them.
std::optional<Eigen::VectorXd> rough_map(const Eigen::VectorXd& u) {
  if (u.norm() > 10.0) {
    return std::nullopt;
  }
  const double a = u[0] - 1.0;
  const double b = u[1] - 2.0;
  Eigen::VectorXd image(2);
  image << 1.0 + 1.5 * a + a * a, 2.0 + 0.2 * b - 0.5 * a;
  return 1e-4 * (1e4 * image).array().round().matrix();
}

TEST(FixedPoint, IsFoundThoughUnstableAndRough) {
  const FixedPoint point =
      find_fixed_point(rough_map, Eigen::Vector2d(1.1, 1.7), Eigen::Vector2d::Constant(1e-2), 0.02, 10, 2);
  EXPECT_TRUE(point.found);
  EXPECT_NEAR(point.at[0], 1.0, 1e-3);
  EXPECT_NEAR(point.at[1], 2.0, 1e-3);
  EXPECT_NEAR(point.growth, 1.5, 0.02);
}

TEST(FixedPoint, WhereTheMapEndsNothingIsFound) {
  const FixedPoint point =
      find_fixed_point(rough_map, Eigen::Vector2d(40.0, 0.0), Eigen::Vector2d::Constant(1e-2), 0.02, 10, 2);
  EXPECT_FALSE(point.found);
}

TEST(DrawnModels, StayWithinTheirShareAndDiffer) {
  const model::Model mabel =
      model::read_model(PLUMBLINE_ROOT "/robots/mabel/mabel_planar.yaml", model::known_effects());
  const std::vector<model::Model> drawn = draw_models(mabel, 3, 0.05, 1);
  ASSERT_EQ(drawn.size(), 3U);
  EXPECT_NE(drawn[0].skeleton.bodies[3].mass, drawn[1].skeleton.bodies[3].mass);
  for (const model::Model& one : drawn) {
    ASSERT_EQ(one.effects.size(), mabel.effects.size() + 4);
    for (std::size_t b = 0; b < one.skeleton.bodies.size(); ++b) {
      EXPECT_NEAR(one.skeleton.bodies[b].mass, mabel.skeleton.bodies[b].mass,
                  0.05001 * mabel.skeleton.bodies[b].mass);
    }
    int cables = 0;
    for (std::size_t e = 0; e < mabel.effects.size(); ++e) {
      if (one.effects[e].law->declaration().name == "cable_stretch") {
        const double factor = one.effects[e].values[0].value / mabel.effects[e].values[0].value;
        EXPECT_NE(factor, 1.0);
        EXPECT_NEAR(factor, 1.0, 0.05);
        ++cables;
      }
    }
    EXPECT_EQ(cables, 4);
    EXPECT_NEAR(one.effects.back().values[0].value, 1.0, 0.05);
    EXPECT_EQ(one.effects.back().law->declaration().name, "torque_constant_error");
  }
}

// Worked out by hand: half the hops missing costs 10; of the two settled hops (ten, less five and three) one
// is off by two tolerances, one by four: log(1 + (4 + 16)/2).
TEST(HoppingCost, IsWhatItsDescriptionSays) {
  Published travel;
  travel.measure = find_measure("travel");
  travel.quantity.value = -0.27;
  travel.tolerance.value = 0.03;
  HopRun run;
  run.fell = true;
  for (int h = 0; h < 10; ++h) {
    Hop hop;
    hop.travel = h == 6 ? -0.39 : -0.33;
    run.hops.push_back(hop);
  }
  EXPECT_NEAR(hopping_cost({}, {run}, 20, {travel}), 10.0 + std::log(11.0), 1e-12);
  EXPECT_NEAR(hopping_cost({}, {HopRun()}, 20, {travel}), 20.0 + std::log(901.0), 1e-12);
}

// What was found until then is not lost.
TEST(HopSearch, ReturnsTheBestSoFarWhenItIsInterrupted) {
  const model::Model mabel =
      model::read_model(PLUMBLINE_ROOT "/robots/mabel/mabel_planar.yaml", model::known_effects());
  const controllers::HoppingConfig shipped = read_hopping(PLUMBLINE_ROOT "/robots/mabel/hopping.yaml");
  StopFlag stop;
  HopSearchOptions options;
  options.trials = 100000;
  options.starts = 1;
  options.hops = 2;
  options.run.stop = &stop;
  double cheapest = std::numeric_limits<double>::infinity();
  const HopSearchResult best =
      search_gains(mabel, shipped, options, [&](int set, const HopSearchResult& result) {
        cheapest = std::min(cheapest, result.cost);
        stop.raised = set > 2;
      });
  EXPECT_TRUE(best.interrupted);
  EXPECT_EQ(best.cost, cheapest);
  EXPECT_THROW(search_gains(mabel, shipped, options, [](int, const HopSearchResult&) {}), Stopped);
}

}  // namespace
}  // namespace plumbline::validation
