#include "controllers/mabel_hopping/hopping_phases.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/controllers/hopping_example.h"

namespace plumbline::controllers {
namespace {

// Feeds samples; names the phases as Figure S3 does.
class Script {
 public:
  explicit Script(const HoppingConfig& config = hopping_example()) : phases_(config) {}
  std::string next(bool left, bool right, double hip_velocity = -1.0) {
    return to_string(phases_.update(left, right, hip_velocity));
  }
  // The phase after `samples` equal samples.
  std::string run(int samples, bool left, bool right, double hip_velocity = -1.0) {
    for (int k = 0; k < samples; ++k) phases_.update(left, right, hip_velocity);
    return to_string(phases_.phase());
  }
  void to_kickoff() {
    next(true, true);
    next(true, true, 0.0);
    ASSERT_EQ(phases_.phase(), HoppingPhase::kickoff);
  }
  const HoppingPhases& phases() const { return phases_; }

 private:
  HoppingPhases phases_;
};

TEST(HoppingPhases, OneHopWithTheLeftFootFirst) {
  Script s;
  EXPECT_EQ(s.run(500, false, false), "I");
  EXPECT_EQ(s.next(true, false), "I");  // S6 wants both
  EXPECT_EQ(s.next(false, true), "I");
  EXPECT_EQ(s.next(true, true), "II");
  EXPECT_EQ(s.next(true, true, -0.5), "II");
  EXPECT_EQ(s.next(true, true, -0.0226), "II");
  EXPECT_EQ(s.next(true, true, -0.0224), "III");  // S8
  EXPECT_EQ(s.next(true, true, 0.8), "III");
  EXPECT_EQ(s.next(false, true, 0.8), "IVa");  // S10
  EXPECT_EQ(s.next(false, true, 0.8), "IVa");
  EXPECT_EQ(s.next(false, false, 0.8), "V");  // S14
  EXPECT_EQ(s.phases().samples_in_phase(), 0);
  EXPECT_EQ(s.run(49, false, false), "V");
  EXPECT_EQ(s.next(false, false), "I");  // S17: 50 ms after the transition to V
  EXPECT_EQ(s.next(true, true), "II");
  EXPECT_EQ(s.phases().landings(), 2);
}

TEST(HoppingPhases, RightFootFirst) {
  Script s;
  s.to_kickoff();
  EXPECT_EQ(s.next(true, false, 0.8), "IVb");  // S11
  EXPECT_EQ(s.next(false, false, 0.8), "V");   // S16
  EXPECT_EQ(s.run(50, true, true, 0.8), "I");  // contact is not looked at in V
  EXPECT_EQ(s.next(true, true, -0.8), "II");
}

TEST(HoppingPhases, BothFeetAtOnce) {
  Script s;
  s.to_kickoff();
  EXPECT_EQ(s.next(false, false, 0.8), "V");  // S12
}

TEST(HoppingPhases, ABandThatWasJumpedOverCounts) {
  Script s;
  EXPECT_EQ(s.next(true, true, -0.4), "II");
  EXPECT_EQ(s.next(true, true, -0.4), "II");
  EXPECT_EQ(s.next(true, true, 0.4), "III");
}

TEST(HoppingPhases, TouchdownLastsItsShortestTime) {
  HoppingConfig config = hopping_example();
  config.supplements.touchdown_time_min = 0.020;
  Script s(config);
  EXPECT_EQ(s.next(true, true), "II");
  EXPECT_EQ(s.run(19, true, true, 0.5), "II");
  EXPECT_EQ(s.next(true, true, 0.5), "III");
}

TEST(HoppingPhases, SwitchesAreDebouncedBothWays) {
  HoppingConfig config = hopping_example();
  config.supplements.contact_samples = 3;
  Script s(config);
  EXPECT_EQ(s.run(2, true, true), "I");
  EXPECT_EQ(s.next(true, false), "I");  // the right switch chatters and starts anew
  EXPECT_EQ(s.run(2, true, true), "I");
  EXPECT_EQ(s.next(true, true), "II");
  EXPECT_EQ(s.next(true, true, 0.0), "III");
  EXPECT_EQ(s.run(2, false, true, 0.0), "III");
  EXPECT_EQ(s.next(true, true, 0.0), "III");
  EXPECT_EQ(s.run(2, false, true, 0.0), "III");
  EXPECT_EQ(s.next(false, true, 0.0), "IVa");
}

TEST(HoppingPhases, ABounceGoesBackToFlightAndIsNoLanding) {
  HoppingConfig config = hopping_example();
  config.supplements.bounce_time = 0.005;
  Script s(config);
  EXPECT_EQ(s.next(true, true), "II");
  EXPECT_EQ(s.run(5, false, true), "II");
  EXPECT_EQ(s.next(true, true), "II");  // down again in time
  EXPECT_EQ(s.run(5, false, false), "II");
  EXPECT_EQ(s.next(true, false), "I");
  EXPECT_EQ(s.next(true, true), "II");
  EXPECT_EQ(s.phases().landings(), 1);
}

TEST(HoppingPhases, NoKickoffFromTheAir) {
  HoppingConfig config = hopping_example();
  config.supplements.bounce_time = 0.005;
  Script s(config);
  s.next(true, true);
  EXPECT_EQ(s.next(false, false, 0.5), "II");
  EXPECT_EQ(s.next(false, true, 0.5), "III");  // one foot is enough for S8
  EXPECT_EQ(s.next(false, true, 0.5), "IVa");
}

TEST(HoppingPhases, KickoffWithoutLiftOffIsTriedAgain) {
  HoppingConfig config = hopping_example();
  Script forever(config);
  forever.to_kickoff();
  EXPECT_EQ(forever.run(10000, true, true, 0.0), "III");  // without a limit, as in the paper

  config.supplements.kickoff_time_max = 0.100;
  Script s(config);
  s.to_kickoff();
  EXPECT_EQ(s.run(99, true, true, 0.0), "III");
  EXPECT_EQ(s.next(true, true, 0.0), "II");
  EXPECT_EQ(s.next(true, true, -0.3), "II");
  EXPECT_EQ(s.next(true, true, 0.0), "III");
  EXPECT_EQ(s.phases().landings(), 1);
}

TEST(HoppingPhases, ASecondFootThatStaysDownLetsTheFirstLand) {
  HoppingConfig config = hopping_example();
  config.supplements.liftoff_time_max = 0.030;
  for (const bool left : {true, false}) {
    Script s(config);
    s.to_kickoff();
    EXPECT_EQ(s.next(!left, left), left ? "IVa" : "IVb");
    EXPECT_EQ(s.run(10, true, true), left ? "IVa" : "IVb");  // touching again changes nothing
    EXPECT_EQ(s.run(19, !left, left), left ? "IVa" : "IVb");
    EXPECT_EQ(s.next(!left, left), "I");
    EXPECT_EQ(s.next(true, true), "II");
    EXPECT_EQ(s.phases().landings(), 1);
  }
}

}  // namespace
}  // namespace plumbline::controllers
