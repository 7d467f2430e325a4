// Mass matrix and bias of the project's tree against Simbody's operators, for every robot that ships, and a
// robot that walks under its controller on both.
#include "simulator/model/engine.h"

#include <gtest/gtest.h>

#include <random>

#include "simulator/model/known_effects.h"
#include "simulator/model/mechanism.h"
#include "simulator/model/robot_file.h"
#include "simulator/run/run_scenario.h"
#include "tests/robots/shipped.h"

namespace plumbline::model {
namespace {

class Engines : public testing::TestWithParam<std::string> {
 protected:
  ~Engines() override { set_engine(Engine::tree); }
};

TEST_P(Engines, GiveTheSameMassMatrixAndBias) {
  Mechanism mechanism(read_model(GetParam(), known_effects()).skeleton);
  const Eigen::Index n = mechanism.size();
  if (n == 0) {
    return;  // a motor on a bench: no joint moves
  }
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> spread(-1.0, 1.0);
  const auto draw = [&] {
    return Eigen::VectorXd::NullaryExpr(n, [&](Eigen::Index) { return spread(random); }).eval();
  };
  for (int round = 0; round < 20; ++round) {
    const Eigen::VectorXd q = draw();
    const Eigen::VectorXd v = 5.0 * draw();
    Eigen::MatrixXd M(n, n), M_simbody(n, n);
    Eigen::VectorXd h(n), h_simbody(n);
    set_engine(Engine::tree);
    mechanism.evaluate(q, v, M, h);
    set_engine(Engine::simbody);
    mechanism.evaluate(q, v, M_simbody, h_simbody);
    EXPECT_LT((M - M_simbody).cwiseAbs().maxCoeff(), 1e-11 * M.cwiseAbs().maxCoeff());
    EXPECT_LT((h - h_simbody).cwiseAbs().maxCoeff(), 1e-11 * (1.0 + h.cwiseAbs().maxCoeff()));
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, Engines, testing::ValuesIn(shipped_robots()), robot_label);

// Half a second of walking, through a touchdown: the same to the integrator's error.
TEST(EnginesWalk, TheSame) {
  const run::LoadedScenario loaded =
      run::read_scenario(PLUMBLINE_ROOT "/robots/mabel/scenarios/walking.yaml", {});
  const auto end_of = [&](Engine engine) {
    set_engine(engine);
    run::LoadedScenario half = loaded;
    half.scenario.longest = 0.5;
    run::RunOptions options;
    options.trace = true;
    const run::RunRecord run = run::run_scenario(half.model, half.scenario, &*half.controller, options);
    set_engine(Engine::tree);
    return run.trace;
  };
  const Table tree = end_of(Engine::tree);
  const Table simbody = end_of(Engine::simbody);
  ASSERT_EQ(tree.rows(), simbody.rows());
  for (const char* name : {"q_hip_x", "q_torso", "q_thigh_left", "q_bsp_left"}) {
    ASSERT_NE(tree.find(name), nullptr) << name;
    EXPECT_LT((tree.find(name)->values - simbody.find(name)->values).cwiseAbs().maxCoeff(), 1e-5) << name;
  }
}

}  // namespace
}  // namespace plumbline::model
