// What the program makes of a log that nobody has described.
#include "validation/identify/trial/log_look.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "tests/identify/trial/fixture.h"
#include "validation/identify/trial/trial.h"
#include "validation/identify/trial/trial_from_log.h"

namespace plumbline::validation {
namespace {

using testing::HasSubstr;

/// 4 s of a swing at about 200 Hz, stamps in ms that jitter, two samples lost, one cell empty; the rate in
/// deg/s.
std::string swing_csv(const std::string& header) {
  std::ostringstream csv;
  csv << header << '\n';
  double t = 0.0;
  for (int k = 0; k < 800; ++k) {
    t += 5.0 + 0.4 * std::sin(1.7 * k) + (k == 300 ? 60.0 : 0.0);
    const double s = 1e-3 * t;
    const double q = 0.001 * std::round(1000.0 * std::sin(3.0 * s));
    csv << t << ',' << q << ',' << 57.29578 * 3.0 * std::cos(3.0 * s) << ',' << 2.0 * std::sin(5.0 * s) << ','
        << 1.1 * q << ',' << (k % 100 < 50 ? 1 : 0) << ',' << (k == 7 ? "" : "run") << '\n';
  }
  return csv.str();
}

class LookAtLog : public ScratchFolder {
 protected:
  LogLook look(const std::string& text, const std::string& name = "swing.csv") {
    write_file(folder / name, text);
    return look_at(read_log((folder / name).string()));
  }
};

/// A sine of 1 Hz at 100 Hz in steps of `step`, with normal noise and two shocks of 0.3.
std::string noisy_csv(double sigma, double step) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, sigma);
  std::ostringstream csv;
  csv.precision(17);
  csv << "t,q\n";
  for (int k = 0; k < 3000; ++k) {
    const double shock = k == 1000 || k == 2000 ? 0.3 : 0.0;
    const double q = 0.7 * std::sin(2.0 * M_PI * 0.01 * k) + noise(random) + shock;
    csv << 0.01 * k << ',' << (step > 0.0 ? step * std::round(q / step) : q) << '\n';
  }
  return csv.str();
}

TEST_F(LookAtLog, ScatterIsTheNoiseAndNotTheMotion) {
  EXPECT_NEAR(look(noisy_csv(2e-4, 0.0)).columns[1].scatter, 2e-4, 0.15 * 2e-4);
  EXPECT_NEAR(look(noisy_csv(1e-9, 1e-3)).columns[1].scatter, 1e-3 / std::sqrt(12.0), 0.25e-3)
      << "quantisation alone";
  EXPECT_LT(look(noisy_csv(1e-12, 0.0)).columns[1].scatter, 1e-10) << "a smooth motion has none";
}

TEST_F(LookAtLog, RolesUnitsAndSampling) {
  const LogLook swing = look(swing_csv("time,q_knee,motor_speed,tau,q_des,foot,mode"));
  ASSERT_EQ(swing.time, 0);
  EXPECT_EQ(swing.columns[0].unit, "ms");
  EXPECT_NEAR(swing.median_step, 5e-3, 0.3e-3);
  EXPECT_NEAR(swing.duration, 4.05, 0.1);
  EXPECT_EQ(swing.gaps, 1);
  EXPECT_EQ(swing.columns[1].role, ColumnRole::position);
  EXPECT_EQ(swing.columns[1].unit, "rad");
  EXPECT_TRUE(swing.columns[1].unit_is_guess);
  EXPECT_NEAR(swing.columns[1].step, 1e-3, 1e-9);
  EXPECT_EQ(swing.columns[2].role, ColumnRole::rate);
  EXPECT_EQ(swing.columns[2].unit, "deg/s") << "57.3 times the difference of q_knee";
  EXPECT_THAT(swing.columns[2].why, HasSubstr("difference of q_knee"));
  EXPECT_EQ(swing.columns[3].role, ColumnRole::command);
  EXPECT_EQ(swing.columns[3].unit, "N m");
  EXPECT_EQ(swing.columns[4].role, ColumnRole::reference);
  EXPECT_EQ(swing.columns[5].role, ColumnRole::contact);
  EXPECT_EQ(swing.columns[6].role, ColumnRole::other);
  EXPECT_EQ(swing.columns[6].text, "run");
}

TEST_F(LookAtLog, TimesOfEverySize) {
  const auto unit_of = [&](double start, double step, const std::string& name) {
    std::ostringstream csv;
    csv.precision(17);
    csv << name << ",q\n";
    for (int k = 0; k < 30; ++k) {
      csv << start + step * k << ',' << k % 3 << '\n';
    }
    return look(csv.str()).columns[0].unit;
  };
  EXPECT_EQ(unit_of(0, 0.001, "t"), "s");
  EXPECT_EQ(unit_of(1.7e9, 0.01, "timestamp"), "s");
  EXPECT_EQ(unit_of(1.7e12, 10, "timestamp"), "ms");
  EXPECT_EQ(unit_of(1.7e15, 10000, "timestamp"), "us");
  EXPECT_EQ(unit_of(1.7e18, 1e7, "timestamp"), "ns");
  EXPECT_EQ(unit_of(0, 1e6, "stamp"), "ns");
  EXPECT_EQ(unit_of(0, 1000, "t"), "us");
  EXPECT_EQ(unit_of(0, 4, "t"), "ms");
  EXPECT_EQ(unit_of(0, 4, "time_us"), "us");
  EXPECT_EQ(unit_of(5, 0.01, "anything"), "s") << "the first column, and it rises";
}

TEST_F(LookAtLog, UnitsOfTheFileCount) {
  const LogLook log = look("t [s],a [N m],b [rad/s],c [deg],e [count]\n0,1,2,3,4\n1,2,3,4,5\n2,3,1,1,7\n");
  EXPECT_EQ(log.columns[1].role, ColumnRole::command);
  EXPECT_EQ(log.columns[2].role, ColumnRole::rate);
  EXPECT_FALSE(log.columns[2].unit_is_guess);
}

TEST_F(LookAtLog, ATrialThatOnlyNeedsALook) {
  std::ostringstream csv;
  csv << "t [s];leg torque [N m];drive voltage [V];leg angle [deg];place [mm];note\n";
  for (int k = 0; k < 60; ++k) {
    csv << 0.01 * k << ';' << 0.1 * k << ';' << k % 7 << ';' << 10 * std::sin(0.1 * k) << ';' << 2 * k
        << ";x\n";
  }
  write_file(folder / "log.csv", csv.str());
  new_trial_from_log((folder / "new").string(), (folder / "log.csv").string(), &robot);
  const Trial trial = read_trial((folder / "new").string(), robot);
  EXPECT_EQ(trial.samples(), 60);
  ASSERT_EQ(trial.commands.size(), 2U);
  EXPECT_EQ(trial.commands[0].motor, "mLeg");
  EXPECT_EQ(trial.commands[0].column, "leg torque");
  EXPECT_EQ(trial.commands[1].column, "drive voltage");
  ASSERT_EQ(trial.measured.size(), 2U);
  EXPECT_EQ(trial.measured[0].column, "leg angle");
  EXPECT_EQ(trial.measured[1].column, "place");
  EXPECT_EQ(std::filesystem::path(trial.data_file).filename(), "log.csv");
  EXPECT_THAT(file_text(folder / "new" / "trial.yaml"), HasSubstr("60 rows, 6 columns"));
}

TEST_F(LookAtLog, WithoutACommandButWithAReference) {
  write_file(folder / "log.csv", "t,q,goal\n0,1,2\n1,2,2.5\n2,1.5,2.25\n");
  new_trial_from_log((folder / "new").string(), (folder / "log.csv").string(), nullptr);
  const std::string text = file_text(folder / "new" / "trial.yaml");
  EXPECT_THAT(text, HasSubstr("kind: pd"));
  EXPECT_THAT(text, HasSubstr("reference: {column: goal"));
  EXPECT_THAT(text, HasSubstr("q: {column: q, unit: rad}   # unit guessed"));
}

TEST_F(LookAtLog, BadInputs) {
  EXPECT_THAT(input_error([&] {
                new_trial_from_log((folder / "new").string(), (folder / "no.csv").string(), nullptr);
              }),
              HasSubstr("nothing at this path"));
  EXPECT_FALSE(std::filesystem::exists(folder / "new"));
  write_file(folder / "log.csv", "t,q\n0,1\n");
  EXPECT_THAT(
      input_error([&] { new_trial_from_log(folder.string(), (folder / "log.csv").string(), nullptr); }),
      HasSubstr("not empty"));
}

}  // namespace
}  // namespace plumbline::validation
