// MABEL's published gait on its design model: what is found against what was printed.
#include <gtest/gtest.h>

#include "simulator/trace/error.h"
#include "tests/studies/walking/published_gait.h"

namespace plumbline::validation {
namespace {

/// Linear between rows.
double at(const Column& t, const Column& values, double when) {
  const double* const after = std::upper_bound(t.values.data(), t.values.data() + t.values.size(), when);
  const Eigen::Index i = std::clamp<Eigen::Index>(after - t.values.data(), 1, t.values.size() - 1);
  const double span = t.values[i] - t.values[i - 1];
  const double w = span > 0.0 ? (when - t.values[i - 1]) / span : 1.0;
  return (1.0 - w) * values.values[i - 1] + w * values.values[i];
}

// Both feet stand where the curves end: the new stance leg's theta is the curves' beginning by geometry
// alone.
TEST(RigidGait, LandsWithBothFeetDownAndMovesOn) {
  const RigidGait& gait = found().gait;
  RigidWalker& walker = found().walker;
  const Eigen::Vector3d before = start_of(gait);
  const Eigen::VectorXd x = walker.after_touchdown(before, 1.0);
  EXPECT_NEAR(walker.theta(x), gait.gait.theta_begin, 0.002);
  // The old stance leg's spring is slack.
  EXPECT_NEAR(walker.plant().position_of(gait.swing.spring, x.data()), 0.0, 1e-12);
  EXPECT_GT(walker.plant().velocity_of(gait.stance.spring, x.data()), 1.0);
  const double scaled =
      walker.plant().velocity_of(gait.stance.spring, walker.after_touchdown(before, 0.97).data());
  EXPECT_NEAR(scaled, walker.plant().velocity_of(gait.stance.spring, x.data()) / 0.97, 1e-9);
}

// Published: Sreenath et al. (2011), section III-E and Figure 5. The step's time is what the torso's place
// was set by (design_walking.yaml); its length, speed and phases were not used.
TEST(RigidGait, FindsThePublishedStep) {
  ASSERT_TRUE(found().point.found) << found().point.failure;
  const RigidStep& step = found().point.step;
  const std::map<std::string, double>& published = found().gait.published;
  EXPECT_NEAR(step.time, published.at("step_time"), 0.002);
  EXPECT_NEAR(step.length, published.at("step_length"), 0.001);
  EXPECT_NEAR(step.length / step.time, published.at("speed"), 0.005);
  EXPECT_NEAR(step.phase_ends[0], 0.0331, 0.002);
  EXPECT_NEAR(step.phase_ends[1], 0.1114, 0.010);
  EXPECT_NEAR(step.phase_ends[2], 0.5387, 0.003);
  EXPECT_GT(step.least_normal, 0.0);
  EXPECT_LT(step.largest_friction, 0.6);  // the bound of the paper's optimisation
  EXPECT_GT(step.impact_loss, 0.0);
}

// It repeats: the step that follows begins where this one did.
TEST(RigidGait, TheFoundStepRepeats) {
  ASSERT_TRUE(found().point.found);
  RigidWalker& walker = found().walker;
  const RigidStep again = walker.step(found().point.step.next, found().options);
  ASSERT_TRUE(again.walked) << again.failure;
  const Eigen::Vector3d off = walker.before_touchdown(again.end) - found().point.at;
  EXPECT_LT(off.cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_NEAR(again.time, found().point.step.time, 1e-4);
}

// Figures 5 to 8. Without the springs' damping B_Spring is off by degrees and no step repeats.
TEST(RigidGait, FollowsThePublishedCurves) {
  ASSERT_TRUE(found().point.found);
  RigidGaitOptions options = found().options;
  options.trace = true;
  const RigidStep step = found().walker.step(found().walker.after_touchdown(found().point.at, 1.0), options);
  const Table published = read_csv(found().gait.curves);
  const Column& when = *published.find("t");
  // rms: deg, cm and N m; a range of each is 30 to 400 deg, 15 deg, 3 cm, 3 to 6 N m.
  const std::map<std::string, double> bounds{
      {"angle_stance", 0.3},      {"angle_swing", 0.3},    {"shape_motor_stance", 1.5},
      {"shape_motor_swing", 8.0}, {"trunk", 0.06},         {"spring_stance", 0.6},
      {"swing_height", 0.15},     {"u_angle_stance", 0.3}, {"u_angle_swing", 0.3},
      {"u_shape_stance", 0.3},    {"u_shape_swing", 0.3}};
  for (const auto& [name, bound] : bounds) {
    const Column& column = *published.find(name);
    const double factor = column.unit == "deg" ? 180.0 / M_PI : column.unit == "cm" ? 100.0 : 1.0;
    double sum = 0.0;
    int counted = 0;
    for (Eigen::Index i = 0; i < published.rows() && when.values[i] <= step.time; ++i) {
      const double ours = factor * at(*step.trace.find("t"), *step.trace.find(name), when.values[i]);
      sum += std::pow(ours - column.values[i], 2);
      ++counted;
    }
    ASSERT_GT(counted, 40);
    EXPECT_LT(std::sqrt(sum / counted), bound) << name;
  }
}

TEST(RigidGait, SaysWhyARobotDoesNotWalk) {
  RigidGaitOptions options;
  options.tolerance = 1e-6;
  const RigidStep step = found().walker.step(found().walker.after_touchdown({0.3, 0.06, 0.0}, 1.0), options);
  EXPECT_FALSE(step.walked);
  EXPECT_NE(step.failure.find("theta is not monotonic"), std::string::npos) << step.failure;
}

TEST(RigidGait, RefusesAFileThatIsNone) {
  EXPECT_THROW(read_rigid_gait(PLUMBLINE_ROOT "/robots/mabel/design.yaml"), InputError);
}

}  // namespace
}  // namespace plumbline::validation
