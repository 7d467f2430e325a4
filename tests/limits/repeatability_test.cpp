// The same question twice has the same answer, to the last bit.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "simulator/trace/sha256.h"
#include "tests/limits/bench.h"
#include "validation/identify/predict/estimate.h"

namespace plumbline::limits {
namespace {

model::Model several_effects() {
  model::Model model = with_effect(leg_bench(), "coulomb", "mLA", {0.05, 0.05});
  model = with_effect(model, "cable_stretch", "leg_angle", {5.0, 0.01});
  return with_effect(model, "actuator_lag", "mLS", {0.005});
}

TEST(Repeatability, TwoRunsAreTheSameBitForBit) {
  const model::Model model = several_effects();
  const validation::Experiment experiment = both_motors(model, 0.5);
  const run::CommandedRun one = simulate(model, experiment, options_at(1e-6));
  const run::CommandedRun two = simulate(model, experiment, options_at(1e-6));
  EXPECT_TRUE(one.states == two.states);
  EXPECT_TRUE(one.outputs == two.outputs);
  EXPECT_EQ(one.energy_error, two.energy_error);
  EXPECT_EQ(one.summary.rate_evaluations, two.summary.rate_evaluations);
}

TEST(Repeatability, TwoPredictorsGiveTheSameResiduals) {
  const model::Model model = several_effects();
  const validation::Trial trial = validation::twin(leg_bench(), both_motors(model, 1.0), {});
  validation::Predictor one(model, trial, {});
  validation::Predictor two(model, trial, {});
  for (const validation::Window& window : validation::cut_windows({trial}, {})) {
    const Eigen::VectorXd x0 = one.initial_state(window);
    EXPECT_TRUE(x0 == two.initial_state(window));
    const Eigen::VectorXd r = one.residual(window, x0);
    EXPECT_TRUE(r == two.residual(window, x0));
    EXPECT_TRUE(r == one.residual(window, x0)) << "a predictor remembers its last window";
    EXPECT_TRUE(one.linearise(window, x0, {}).Jx == two.linearise(window, x0, {}).Jx);
  }
}

/// A number in twenty to nine digits of the largest in its row (a channel): the C library's sines differ in
/// the last bit from one processor to another, what cancels to nothing has no digits of its own, and the
/// fewer numbers, the less likely one of them stands just where it is rounded the other way.
std::string nine_digits(const Eigen::MatrixXd& table) {
  std::string text;
  for (Eigen::Index row = 0; row < table.rows(); ++row) {
    const double largest = table.row(row).cwiseAbs().maxCoeff();
    const double unit = std::pow(10.0, std::ceil(std::log10(std::max(largest, 1e-300))) - 9.0);
    for (Eigen::Index column = 0; column < table.cols(); column += 20) {
      text += std::to_string(std::llround(table(row, column) / unit)) + ' ';
    }
    text += '\n';
  }
  return text;
}

// The same bytes from every build: release, debug, under the sanitizers, and of every version until somebody
// changes a law or the integrator on purpose and writes the new sum here, with the reason in the change log.
TEST(Repeatability, ARunIsTheOneThatWasPinned) {
  const model::Model model = several_effects();
  const run::CommandedRun done = simulate(model, both_motors(model, 0.5), options_at(1e-6));
  ASSERT_GT(done.outputs.cols(), 400);
  const std::string digits = nine_digits(done.states) + nine_digits(done.outputs);
  EXPECT_EQ(sha256_of(digits), "0d6d20cd3fbcbc84c65fcf71b70931b84d2b6b66140c01309cb253dfc5d724e4")
      << "channels begin with " << digits.substr(0, 200);
}

using Solver = validation::Estimate (*)(validation::PredictorPool&,
                                        const std::vector<validation::FreeParameter>&, const Eigen::VectorXd&,
                                        const std::vector<Eigen::VectorXd>&,
                                        const validation::EstimateOptions&);

validation::Estimate estimate_with(Solver solver, int threads) {
  const model::Model model = with_effect(leg_bench(), "coulomb", "mLA", {0.01, 0.05});
  const model::Model truth = with_effect(leg_bench(), "coulomb", "mLA", {0.05, 0.05});
  validation::Trial train = validation::twin(truth, both_motors(truth, 1.5), {});
  validation::Trial held_out = validation::twin(truth, both_motors(truth, 1.0), {});
  train.role = validation::Role::train;
  held_out.role = validation::Role::held_out;
  validation::Data data({train, held_out}, {});
  data.threads = threads;
  validation::PredictorPool pool(model, data);
  const int last = static_cast<int>(model.effects.size()) - 1;
  std::vector<validation::FreeParameter> free(2);
  free[0].id = {last, 0};
  free[1].id = {0, 0};
  for (validation::FreeParameter& parameter : free) {
    parameter.upper = 1.0;
    parameter.typical = 0.01;
  }
  validation::EstimateOptions options;
  options.iterations = 5;
  return solver(pool, free, Eigen::Vector2d(0.01, 4.316e-3), {}, options);
}

void expect_same(Solver solver) {
  const validation::Estimate one = estimate_with(solver, 1);
  const validation::Estimate two = estimate_with(solver, 2);
  EXPECT_NEAR(one.theta[0], 0.05, 5e-3);
  EXPECT_TRUE(one.theta == two.theta) << one.theta.transpose() << " and " << two.theta.transpose();
  EXPECT_EQ(one.scores.train, two.scores.train);
  EXPECT_EQ(one.scores.held_out, two.scores.held_out);
  EXPECT_NEAR(one.scores.held_out, 1.0, 0.2);
  ASSERT_EQ(one.x0.size(), two.x0.size());
  for (std::size_t w = 0; w < one.x0.size(); ++w) {
    EXPECT_TRUE(one.x0[w] == two.x0[w]);
  }
}

TEST(Repeatability, EstimateDoesNotDependOnTheNumberOfThreads) { expect_same(validation::estimate); }
TEST(Repeatability, GaussNewtonDoesNotDependOnTheNumberOfThreads) { expect_same(validation::gauss_newton); }

}  // namespace
}  // namespace plumbline::limits
