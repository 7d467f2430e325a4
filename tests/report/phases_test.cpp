// Phases share out all samples of a trial, by rules that a person can check.
#include "validation/identify/compare/phases.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <set>

namespace plumbline::validation {
namespace {

Trial sine_trial() {
  Trial trial;
  trial.period = 1e-3;
  trial.time = Eigen::VectorXd::LinSpaced(3000, 0.0, 2.999);
  Measured channel;
  channel.sensor = "q";
  channel.values = (6.283185307179586 * trial.time.array()).sin();
  trial.measured.push_back(channel);
  return trial;
}

std::size_t place_of(const PhaseTable& table, const std::string& name) {
  for (std::size_t p = 0; p < table.phases.size(); ++p) {
    if (table.phases[p].name == name) {
      return p;
    }
  }
  ADD_FAILURE() << "no phase " << name;
  return 0;
}

TEST(Phases, EachGroupHoldsEverySampleOnce) {
  Trial trial = sine_trial();
  trial.events = {0.5, 1.25};
  const PhaseTable table = phases_of(trial, trial.measured[0]);
  std::map<std::string, std::multiset<Eigen::Index>> seen;
  for (std::size_t p = 0; p < table.phases.size(); ++p) {
    seen[table.phases[p].group].insert(table.members[p].begin(), table.members[p].end());
  }
  EXPECT_EQ(seen.size(), 4U);
  for (const auto& [group, samples] : seen) {
    EXPECT_EQ(samples.size(), 3000U) << group;
    EXPECT_EQ(std::set<Eigen::Index>(samples.begin(), samples.end()).size(), 3000U) << group;
  }
}

TEST(Phases, AStanceBetweenFlightsHasTenths) {
  Trial trial = sine_trial();
  SwitchRecord foot{"foot", "", Eigen::VectorXd::Zero(3000)};
  foot.values.segment(500, 1000).setOnes();   // a whole stance
  foot.values.segment(2000, 1000).setOnes();  // one that the recording cuts off
  trial.switches.push_back(foot);
  trial.contact_events = contact_events(trial);
  const PhaseTable table = phases_of(trial, trial.measured[0]);
  for (const auto& [name, first] : {std::pair("0-10 %", 500), std::pair("50-60 %", 1000)}) {
    const std::vector<Eigen::Index>& members = table.members[place_of(table, name)];
    ASSERT_EQ(members.size(), 100U) << name;
    EXPECT_EQ(members.front(), first);
    EXPECT_EQ(members.back(), first + 99);
  }
  EXPECT_EQ(table.members[place_of(table, "else")].size(), 2000U);
}

TEST(Phases, ASineGoesForwardAndBackwardAndTurns) {
  const Trial trial = sine_trial();
  const PhaseTable table = phases_of(trial, trial.measured[0]);
  const auto share = [&](const std::string& name) {
    return static_cast<double>(table.members[place_of(table, name)].size()) / 3000.0;
  };
  // |cos| < 0.1 / sqrt(2): 2/pi * asin(0.0707) of the time
  EXPECT_NEAR(share("turning"), 0.0450, 0.002);
  EXPECT_NEAR(share("forward"), share("backward"), 0.002);
  EXPECT_NEAR(share("slow"), 1.0 / 3.0, 0.01);
  EXPECT_NEAR(share("fast"), 1.0 / 3.0, 0.01);
  for (const Eigen::Index k : table.members[place_of(table, "forward")]) {
    EXPECT_GT(std::cos(6.283185307179586 * trial.time[k]), 0.0);
  }
}

TEST(Phases, EventsCutTheTrialWhereTheyAre) {
  Trial trial = sine_trial();
  trial.events = {0.5, 1.25};
  const PhaseTable table = phases_of(trial, trial.measured[0]);
  EXPECT_EQ(table.members[place_of(table, "start")].size(), 500U);
  EXPECT_EQ(table.members[place_of(table, "after 1")].size(), 750U);
  EXPECT_EQ(table.members[place_of(table, "after 2")].size(), 1750U);
}

TEST(Phases, ManyEventsShareTheLastColumn) {
  Trial trial = sine_trial();
  for (int e = 0; e < 20; ++e) {
    trial.events.push_back(0.1 + 0.1 * e);
  }
  const PhaseTable table = phases_of(trial, trial.measured[0]);
  EXPECT_EQ(table.members[place_of(table, "after 7")].size(), 100U);
  EXPECT_EQ(table.members[place_of(table, "later")].size(), 3000U - 800U);
}

TEST(Phases, ContactIsWhichSwitchesAreClosed) {
  Trial trial = sine_trial();
  SwitchRecord left{"left", "left", Eigen::VectorXd::Zero(3000)};
  SwitchRecord right = left;
  right.name = "right";
  left.values.segment(1000, 600).setOnes();
  right.values.segment(1500, 500).setOnes();
  trial.switches = {left, right};
  const PhaseTable table = phases_of(trial, trial.measured[0]);
  EXPECT_EQ(table.members[place_of(table, "flight")].size(), 2000U);
  EXPECT_EQ(table.members[place_of(table, "left")].size(), 500U);
  EXPECT_EQ(table.members[place_of(table, "left + right")].size(), 100U);
  EXPECT_EQ(table.members[place_of(table, "right")].size(), 400U);
}

TEST(Phases, AChannelAtRestIsTurning) {
  Trial trial = sine_trial();
  trial.measured[0].values.setConstant(0.3);
  const PhaseTable table = phases_of(trial, trial.measured[0]);
  EXPECT_EQ(table.members[place_of(table, "turning")].size(), 3000U);
  EXPECT_EQ(table.members[place_of(table, "slow")].size(), 3000U);
}

}  // namespace
}  // namespace plumbline::validation
