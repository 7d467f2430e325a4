// Thumper's running motion in continuous time: what physics asks of it, and the control's own promises.
#include "validation/studies/running/hybrid.h"

#include <gtest/gtest.h>

#include "validation/studies/running/return_map.h"
#include "validation/studies/running/running_file.h"

namespace plumbline::running_tests {
namespace {

using namespace monopod;
using validation::HybridRun;
using validation::HybridSample;

const Parameters& running() {
  static const Parameters p =
      validation::read_running(PLUMBLINE_ROOT "/robots/thumper/controllers/running.yaml");
  return p;
}

/// One stride from a touchdown that is a little off the nominal one.
std::vector<HybridSample> stride(double step, validation::StrideFacts& facts) {
  std::vector<HybridSample> samples;
  HybridRun run(Running(running().model, running().gait), step);
  run.record = &samples;
  Section start = running().gait.section;
  start[6] += 0.05;
  run.state = validation::state_at(running().model, start);
  EXPECT_TRUE(run.stand());
  EXPECT_TRUE(run.fly());
  facts = run.facts;
  return samples;
}

double spin(const HybridSample& sample) {
  // About the centre of mass: generalised momentum of a turn of everything, less that of the centre.
  const Dynamics d = dynamics(running().model, sample.state);
  const Vector6 momentum = d.mass * sample.state.v;
  const Vector2 arm = d.com - Vector2(sample.state.q.tail<2>());
  const Vector2 linear = total_mass(running().model) * sample.com_rate;
  return momentum[kTorso] - (arm[1] * linear[0] - arm[0] * linear[1]);
}

TEST(Hybrid, FliesAsABodyThatNothingTouches) {
  validation::StrideFacts facts;
  const auto samples = stride(2.5e-4, facts);
  const HybridSample* first = nullptr;
  int count = 0;
  for (const HybridSample& sample : samples) {
    if (sample.phase != Phase::flight) {
      continue;
    }
    first = first == nullptr ? &sample : first;
    const double t = sample.time - first->time;
    EXPECT_NEAR(sample.com[0], first->com[0] + first->com_rate[0] * t, 1e-9);
    EXPECT_NEAR(sample.com[1], first->com[1] + first->com_rate[1] * t - 0.5 * running().model.gravity * t * t,
                1e-9);
    EXPECT_NEAR(spin(sample), spin(*first), 1e-7);
    ++count;
  }
  EXPECT_GT(count, 300);
}

TEST(Hybrid, EndsOnTheConstraintsThatTheOuterLoopAsksFor) {
  Section start = running().gait.section;
  start[6] += 0.05;
  HybridRun run(Running(running().model, running().gait), 2.5e-4);
  run.state = validation::state_at(running().model, start);
  ASSERT_TRUE(run.stand());
  // At lift-off: torso where the outer loop wants it, at rest relative to its polynomial.
  EXPECT_NEAR(run.facts.torso_at_liftoff, run.control.beta()[0], 2e-3);
  EXPECT_NEAR(run.facts.motor_at_liftoff, run.control.beta()[1], 2e-2);
  ASSERT_TRUE(run.fly());
  const Dynamics d = dynamics(running().model, run.state);
  EXPECT_NEAR(d.com[0] - d.toe[0], run.control.beta()[2], 2e-3);
}

// The method is of fourth order where nothing has a kink; the polynomials' ends have one in the third
// derivative.
TEST(Hybrid, ConvergesWithTheStep) {
  Section start = running().gait.section;
  start[6] -= 0.05;
  const auto next = [&](double step) {
    return *validation::next_touchdown(running().model, running().gait, start, step);
  };
  const Section exact = next(6.25e-5);
  EXPECT_LT((next(2.5e-4) - exact).norm(), 1e-5);
  EXPECT_LT((next(2.5e-4) - exact).norm(), 0.1 * (next(1e-3) - exact).norm());
}

TEST(Hybrid, ComesBackToItsOrbit) {
  const auto& p = running();
  const auto at_rest = *validation::next_touchdown(p.model, p.gait, p.gait.section, 2.5e-4);
  EXPECT_LT((at_rest - p.gait.section).cwiseAbs().maxCoeff(), 1e-5);
  Section pushed = p.gait.section;
  pushed.head<3>().array() += 2.0 * M_PI / 180.0;
  pushed.segment<3>(3).array() += 10.0 * M_PI / 180.0;
  pushed[6] -= 0.1;
  pushed[7] += 0.1;
  const auto sections = validation::touchdowns(p.model, p.gait, pushed, 40, 5e-4);
  ASSERT_EQ(sections.size(), 40u);
  EXPECT_LT((sections.back() - p.gait.section).norm(), 1e-2);
}

}  // namespace
}  // namespace plumbline::running_tests
