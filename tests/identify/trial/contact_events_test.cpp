// Contact switches in a trial: read, refused, turned into touchdown and lift-off.
#include "tests/identify/trial/fixture.h"
#include "validation/identify/trial/trial.h"
#include "validation/identify/trial/write_trial.h"

namespace plumbline::validation {
namespace {

Trial switched(const std::vector<Eigen::Index>& changes, Eigen::Index samples) {
  Trial trial;
  trial.period = 1e-3;
  trial.time = Eigen::VectorXd::LinSpaced(samples, 0.0, 1e-3 * static_cast<double>(samples - 1));
  SwitchRecord record{"sole", "c", Eigen::VectorXd::Zero(samples)};
  for (const Eigen::Index k : changes) {
    record.values.tail(samples - k) = Eigen::VectorXd::Ones(samples - k) - record.values.tail(samples - k);
  }
  trial.switches = {record};
  return trial;
}

TEST(ContactEvents, LieHalfASampleBeforeTheFirstSampleThatShowsThem) {
  const std::vector<ContactEvent> events = contact_events(switched({30, 80}, 200));
  ASSERT_EQ(events.size(), 2U);
  EXPECT_TRUE(events[0].touchdown);
  EXPECT_FALSE(events[1].touchdown);
  EXPECT_NEAR(events[0].time, 0.0295, 1e-12);
  EXPECT_NEAR(events[1].time, 0.0795, 1e-12);
  EXPECT_EQ(events[1].sample, 80);
}

TEST(ContactEvents, BouncesAfterATouchdownAreNone) {
  const std::vector<ContactEvent> events = contact_events(switched({30, 45, 60, 90}, 200));
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].sample, 30);
  EXPECT_EQ(events[1].sample, 90);
}

TEST(ContactEvents, AShortKnockInFlightIsNone) {
  EXPECT_TRUE(contact_events(switched({100, 110}, 200)).empty());
}

TEST(ContactEvents, ALateSwitchHasItsLatenessTakenOff) {
  Trial trial = switched({30, 80}, 200);
  trial.switches[0].closes_late = 5e-3;
  trial.switches[0].opens_late = 12e-3;
  const std::vector<ContactEvent> events = contact_events(trial);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_NEAR(events[0].time, 0.0245, 1e-12);
  EXPECT_EQ(events[0].sample, 25);
  EXPECT_NEAR(events[1].time, 0.0675, 1e-12);
  EXPECT_EQ(events[1].sample, 68);
  trial.switches[0].lateness_uncertainty = 2e-3;
  EXPECT_NEAR(timing_floor(trial, 0), std::sqrt(1e-6 / 12 + 4e-6), 1e-12);
}

TEST(ContactEvents, HowLongASwitchBouncesIsItsOwn) {
  Trial trial = switched({30, 45, 60, 90}, 200);
  trial.switches[0].bounce = 5e-3;
  EXPECT_EQ(contact_events(trial).size(), 4U);
}

TEST(ContactEvents, ATwinsSwitchIsAsLateAsTheModelSays) {
  model::ContactSwitch contact{"sole", 0, ""};
  contact.closes_late = 5e-3;
  contact.opens_late = 12e-3;
  const Trial truth = switched({30, 80}, 200);
  Trial recorded = truth;
  recorded.switches = {record_of(contact, "c", read_late(contact, truth.switches[0].values, truth.period))};
  EXPECT_EQ(recorded.switches[0].values[34], 0.0);
  EXPECT_EQ(recorded.switches[0].values[35], 1.0);
  EXPECT_EQ(recorded.switches[0].values[91], 1.0);
  EXPECT_EQ(recorded.switches[0].values[92], 0.0);
  const std::vector<ContactEvent> events = contact_events(recorded);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_NEAR(events[0].time, contact_events(truth)[0].time, 1e-12);
  EXPECT_NEAR(events[1].time, contact_events(truth)[1].time, 1e-12);
}

TEST(ContactEvents, TheirFloorIsThatOfTheSampling) {
  EXPECT_NEAR(timing_floor(switched({}, 30)), 1e-3 / std::sqrt(12.0), 1e-15);
}

class SwitchedTrial : public ScratchFolder {
 protected:
  void SetUp() override {
    ScratchFolder::SetUp();
    hopper = robot;
    hopper.feet = {{"toe", 0, Eigen::Vector3d::Zero(), "", 0.0, ""}};
    hopper.switches = {{"sole", 0, ""}};
  }
  Trial read(const std::string& measured, double closed) const {
    std::ostringstream csv;
    csv << "t [s],u [N m],v [V],angle [rad],contact [1]\n";
    for (int k = 0; k < 30; ++k) {
      csv << 0.01 * k << ",0," << k << ',' << k << ',' << (k >= 12 ? closed : 0.0) << '\n';
    }
    write_file(folder / "data.csv", csv.str());
    write_file(folder / "trial.yaml",
               "plumbline: trial/1\ntitle: t\nmodel: m.yaml\nrole: train\ndata: data.csv\n"
               "time: {column: t}\ncommands:\n  mLeg: {column: u}\nmeasured:\n" +
                   measured);
    return read_trial(folder.string(), hopper);
  }
  model::Model hopper;
};

TEST_F(SwitchedTrial, IsReadAndWrittenAgain) {
  const std::string measured = "  angle: {column: angle}\n  sole: {column: contact}\n";
  const Trial trial = read(measured, 1.0);
  ASSERT_EQ(trial.measured.size(), 1U);
  ASSERT_EQ(trial.switches.size(), 1U);
  ASSERT_EQ(trial.contact_events.size(), 1U);
  EXPECT_NEAR(trial.contact_events[0].time, 0.115, 1e-12);
  write_trial(trial, hopper, (folder / "again").string());
  const Trial again = read_trial((folder / "again").string(), hopper);
  ASSERT_EQ(again.switches.size(), 1U);
  EXPECT_EQ(again.switches[0].values, trial.switches[0].values);
}

TEST_F(SwitchedTrial, HoldsNothingButZeroAndOne) {
  const std::string measured = "  angle: {column: angle}\n  sole: {column: contact}\n";
  const std::string message = input_error([&] { read(measured, 0.5); });
  EXPECT_NE(message.find("0.5 in row 13"), std::string::npos) << message;
}

TEST_F(SwitchedTrial, NeedsAPositionBesideTheSwitch) {
  const std::string message = input_error([&] { read("  sole: {column: contact}\n", 1.0); });
  EXPECT_NE(message.find("contact switches only"), std::string::npos) << message;
}

}  // namespace
}  // namespace plumbline::validation
