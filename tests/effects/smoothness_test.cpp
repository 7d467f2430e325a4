// Between the zeros of its switching functions a force is smooth: its slope does not jump.
//
// Along a line in position or velocity the change of slope between neighbouring intervals is bounded by
// (interval * largest curvature) for a smooth force, so it falls tenfold on a tenfold finer grid; at an
// undeclared kink it stays, at an undeclared jump it grows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/effects/sampling.h"

namespace plumbline::effects {
namespace {

struct Line {
  Motion from;
  double position_span = 0.0;
  double velocity_span = 0.0;

  Motion at(double share) const {
    Motion m = from;
    m.position += share * position_span;
    m.velocity += share * velocity_span;
    return m;
  }
};

std::vector<double> switch_values(const ForceLaw& law, const Motion& m, const Values& p) {
  std::vector<double> g;
  law.switches(m, p.data(), g);
  return g;
}

bool same_signs(const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] * b[i] <= 0.0) return false;
  }
  return true;
}

/// Largest change of slope between neighbouring intervals, away (1 % of the line) from switches.
double largest_slope_change(const ForceLaw& law, const Line& line, const std::vector<double>& states,
                            const Values& p, int intervals) {
  constexpr double kMargin = 0.01;
  const double h = 1.0 / intervals;
  const auto force = [&](double share) { return law.force(line.at(share), states.data(), p.data()); };
  double largest = 0.0;
  for (int i = 1; i < intervals; ++i) {
    const double share = i * h;
    const auto before = switch_values(law, line.at(share - kMargin), p);
    const auto here = switch_values(law, line.at(share), p);
    const auto after = switch_values(law, line.at(share + kMargin), p);
    if (!same_signs(before, here) || !same_signs(here, after)) continue;
    const double change = (force(share + h) - 2 * force(share) + force(share - h)) / h;
    largest = std::max(largest, std::abs(change));
  }
  return largest;
}

double largest_force(const ForceLaw& law, const Line& line, const std::vector<double>& states,
                     const Values& p) {
  double largest = 0.0;
  for (int i = 0; i <= 20; ++i) {
    largest = std::max(largest, std::abs(law.force(line.at(i / 20.0), states.data(), p.data())));
  }
  return largest;
}

class ForceAlongLines : public testing::TestWithParam<std::shared_ptr<const ForceLaw>> {};

INSTANTIATE_TEST_SUITE_P(Smooth, ForceAlongLines, testing::ValuesIn(force_laws()),
                         [](const auto& each) { return each.param->declaration().name; });

TEST_P(ForceAlongLines, IsSmoothBetweenItsSwitches) {
  const ForceLaw& law = *GetParam();
  const Scales scales = test_scales();
  Sampler sampler;
  for (int i = 0; i < 10; ++i) {
    const Values p = sampler.parameters(law);
    const auto states = sampler.states(law, p);
    // Off centre, so that no grid point sits on a kink by accident.
    const Line along_position{
        {scales.center - 1.013 * scales.position, sampler.sign() * 0.7 * scales.velocity, 0.4},
        2.0 * scales.position,
        0.0};
    const Line along_velocity{
        {sampler.motion().position, -1.013 * scales.velocity, 0.4}, 0.0, 2.0 * scales.velocity};
    for (const Line& line : {along_position, along_velocity}) {
      const double coarse = largest_slope_change(law, line, states, p, 4000);
      const double fine = largest_slope_change(law, line, states, p, 40000);
      // Each slope is rounded by a few epsilon * force * intervals: 4e4 * 1e-15.
      const double roundoff = 1e-10 * (1.0 + largest_force(law, line, states, p));
      EXPECT_LT(fine, 0.3 * coarse + roundoff);
    }
  }
}

TEST_P(ForceAlongLines, HasAFixedNumberOfSwitches) {
  const ForceLaw& law = *GetParam();
  Sampler sampler;
  const std::size_t count = switch_values(law, sampler.motion(), sampler.parameters(law)).size();
  for (int i = 0; i < 200; ++i) {
    std::vector<double> g{7.0};  // appended to what is there
    const Values p = sampler.parameters(law);
    law.switches(sampler.motion(), p.data(), g);
    ASSERT_EQ(g.size(), count + 1);
    EXPECT_EQ(g.front(), 7.0);
  }
}

}  // namespace
}  // namespace plumbline::effects
