// What is wrong with an inertial unit is named, on twins of a geared pendulum that carries one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "simulator/model/robot_file.h"
#include "tests/identify/diagnose/bench.h"
#include "validation/identify/diagnose/inertial_places.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

model::Model with_unit() {
  return model::read_model("tests/robots/pendulum/inertial.yaml", effects::Catalogue::all());
}

Data twins_with(const std::vector<std::string>& hidden) {
  const model::Model bare = with_unit();
  model::Model robot = bare;
  for (const std::string& one : hidden) {
    robot.effects.push_back(parse_effect(one, bare, effects::Catalogue::all()));
  }
  std::vector<Trial> trials;
  for (const std::string name : {"chirp", "steps", "multisine"}) {
    const std::string file = "tests/robots/pendulum/experiments/" + name + ".yaml";
    trials.push_back(twin(robot, read_experiment(file, bare), {}));
    trials.back().name = trials.back().file = name;
  }
  return Data(std::move(trials), {});
}

effects::Catalogue few_laws() {
  return some_laws({"imu_bias", "imu_scale", "imu_misalignment", "gravity_tilt", "coulomb", "encoder_offset",
                    "torque_bias", "com_shift"});
}

Diagnosis diagnosed_with(const std::vector<std::string>& hidden) {
  return diagnose(with_unit(), few_laws(), twins_with(hidden).thinned(4), {}, silent);
}

TEST(InertialDiagnosis, NamesTheBiasOfAGyroscope) {
  const Diagnosis d = diagnosed_with({"imu_bias@gyro:x=0.05,y=-0.08,z=0.03"});
  ASSERT_EQ(d.accepted.size(), 1U);
  EXPECT_EQ(d.verdict, Verdict::missing);
  EXPECT_EQ(d.accepted[0].effect, "imu_bias");
  EXPECT_EQ(d.accepted[0].at, "gyro");
  ASSERT_EQ(d.accepted[0].parameters.size(), 3U);
  // A floor of 0.005 rad/s over some thousands of samples.
  EXPECT_NEAR(d.accepted[0].parameters[0].value, 0.05, 5e-4);
  EXPECT_NEAR(d.accepted[0].parameters[1].value, -0.08, 5e-4);
  EXPECT_NEAR(d.accepted[0].parameters[2].value, 0.03, 5e-4);
}

TEST(InertialDiagnosis, NamesTheAxesOfAnAccelerometer) {
  const Diagnosis d = diagnosed_with({"imu_misalignment@acc:x=0.03,y=0.04"});
  ASSERT_EQ(d.accepted.size(), 1U);
  EXPECT_EQ(d.accepted[0].effect, "imu_misalignment");
  EXPECT_EQ(d.accepted[0].at, "acc");
  EXPECT_LT(d.accepted[0].held_out_after, 1.05);
}

TEST(InertialDiagnosis, NothingIsInventedWhereNothingIsWrong) {
  const Diagnosis d = diagnosed_with({});
  EXPECT_EQ(d.verdict, Verdict::nothing_missing);
  EXPECT_THAT(d.accepted, IsEmpty());
}

std::vector<std::string> labels(const std::vector<Candidate>& candidates) {
  std::vector<std::string> all;
  for (const Candidate& one : candidates) {
    if (one.label().rfind("imu_", 0) == 0) {
      all.push_back(one.label());
    }
  }
  return all;
}

// Only where the robot has such a sensor, and only what it shows: an arm in a plane turns about y alone.
TEST(InertialDiagnosis, OffersWhatTheSensorsShow) {
  const Data data = twins_with({});
  PredictorPool pool(with_unit(), data);
  const std::vector<Candidate> candidates = list_candidates(pool, few_laws(), {}, {});
  EXPECT_EQ(labels(candidates).size(), 6U);
  for (const Candidate& one : candidates) {
    if (one.label() == "imu_scale@gyro") {
      EXPECT_THAT(one.without_effect, ElementsAre(0, 2));
    } else if (one.label() == "imu_misalignment@gyro") {
      EXPECT_THAT(one.without_effect, ElementsAre(1));
    } else if (one.label() == "imu_bias@acc") {
      EXPECT_THAT(one.without_effect, IsEmpty());
      EXPECT_GT(one.scales.position, 9.0);
    }
  }
  const Data without = pendulum_twins({});
  PredictorPool bare(pendulum_drive(), without);
  EXPECT_THAT(labels(list_candidates(bare, few_laws(), {}, {})), IsEmpty());
}

}  // namespace
}  // namespace plumbline::validation
