// Windows of a hopping trial: through stance from flight to flight, and in flight.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "tests/identify/predict/hopper.h"
#include "tests/trace/refusal.h"
#include "validation/identify/predict/estimate.h"

namespace plumbline::validation {
namespace {

class HopperWindows : public testing::Test {
 protected:
  static bool in_contact(const Trial& trial, Eigen::Index k) { return trial.switches[0].values[k] > 0.0; }

  const model::Model model_ = test::hopper();
  const Trial trial_ = test::hopper_trial(model_, "bounce");
  const std::vector<Window> windows_ = cut_windows({trial_}, {});
};

TEST_F(HopperWindows, CoverTheTrialOnce) {
  std::vector<int> times(static_cast<std::size_t>(trial_.samples()), 0);
  for (const Window& window : windows_) {
    for (Eigen::Index k = window.first; k < window.first + window.count; ++k) {
      ++times[static_cast<std::size_t>(k)];
    }
  }
  EXPECT_EQ(*std::max_element(times.begin(), times.end()), 1);
  EXPECT_LT(std::count(times.begin(), times.end(), 0), 8);
}

TEST_F(HopperWindows, HoldEveryContactEventInsideAndBeginInTheFlightBeforeIt) {
  std::vector<int> events;
  for (const Window& window : windows_) {
    events.insert(events.end(), window.events.begin(), window.events.end());
    const bool touches = std::any_of(window.events.begin(), window.events.end(), [&](int e) {
      return trial_.contact_events[static_cast<std::size_t>(e)].touchdown;
    });
    EXPECT_TRUE(!touches || !in_contact(trial_, window.first)) << window.first;
  }
  std::sort(events.begin(), events.end());
  ASSERT_GT(events.size(), 10U);
  EXPECT_EQ(events.size(), trial_.contact_events.size());
  EXPECT_EQ(std::unique(events.begin(), events.end()), events.end());
}

TEST_F(HopperWindows, ComeInTheOrderStanceFlight) {
  const auto grounded = [&](const Window& window) {
    return trial_.switches[0].values.segment(window.first, window.count).maxCoeff() > 0.0;
  };
  EXPECT_TRUE(std::is_partitioned(windows_.begin(), windows_.end(), grounded));
  EXPECT_TRUE(grounded(windows_.front()));
  EXPECT_FALSE(grounded(windows_.back()));
}

TEST_F(HopperWindows, InSegmentsCoverTheSameSamplesInTurn) {
  constexpr double kLength = 0.06;
  const auto samples = static_cast<Eigen::Index>(std::lround(kLength / trial_.period));
  for (const Window& window : windows_) {
    const std::vector<Window> segments = segments_of(window, trial_, kLength);
    Eigen::Index next = window.first;
    std::size_t events = 0;
    for (const Window& segment : segments) {
      EXPECT_EQ(segment.first, next);
      EXPECT_EQ(segment.continues, segment.first > window.first);
      EXPECT_LE(2 * segment.count, 3 * samples);
      EXPECT_GE(segment.count, 8);
      next += segment.count;
      events += segment.events.size();
    }
    EXPECT_EQ(next, window.first + window.count);
    EXPECT_EQ(events, window.events.size());
  }
}

TEST_F(HopperWindows, InShorterSegmentsLieWithinTheLongerOnes) {
  const Window& window = windows_.front();
  for (const Window& longer : segments_of(window, trial_, 0.1)) {
    const std::vector<Window> shorter = segments_of(window, trial_, 0.05);
    EXPECT_TRUE(std::any_of(shorter.begin(), shorter.end(),
                            [&](const Window& one) { return one.first == longer.first; }));
  }
}

// The first one alone where no sensor shows in which state the others would begin.
TEST_F(HopperWindows, OfATrialWithAStartHaveOneSegment) {
  Trial started = trial_;
  started.start.resize(1);
  const std::vector<Window> segments = segments_of(windows_.front(), started, 0.05);
  ASSERT_EQ(segments.size(), 1U);
  EXPECT_EQ(segments.front().first, windows_.front().first);
  EXPECT_LT(segments.front().count, windows_.front().count);
}

TEST_F(HopperWindows, WithoutASwitchAreCutAsBefore) {
  Trial plain = trial_;
  plain.switches.clear();
  plain.contact_events.clear();
  const std::vector<Window> windows = cut_windows({plain}, {});
  ASSERT_EQ(windows.size(), 8U);
  for (const Window& window : windows) {
    EXPECT_EQ(window.count, 500);
  }
}

TEST_F(HopperWindows, OfALengthThatTheTrialDoesNotHaveAreRefused) {
  const auto asked_for = [&](double seconds) {
    PredictOptions options;
    options.window = seconds;
    return plumbline::test::refusal([&] { cut_windows({trial_}, options); });
  };
  EXPECT_THAT(asked_for(1e-9), testing::HasSubstr("windows of 0 samples, expected windows of 8 or more"));
  EXPECT_THAT(asked_for(1e30), testing::HasSubstr("expected at least one window of 1e+33 samples"));
}

}  // namespace
}  // namespace plumbline::validation
