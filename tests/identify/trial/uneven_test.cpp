// Logs whose samples are not even, have holes, or lack what a trial needs.
#include <cmath>
#include <random>

#include "tests/identify/trial/fixture.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::validation {
namespace {

constexpr double kTwoPi = 6.283185307179586;

/// An angle of 30 sin(2 pi t) degrees under a command that is 1 until 0.5 s and -1 after, at given times.
std::string log_at(const std::vector<double>& times, double origin = 0.0) {
  std::ostringstream csv;
  csv.precision(17);
  csv << "t [s],u [N m],v [mV],angle [deg],place [mm],reference [mm]\n";
  for (const double t : times) {
    csv << origin + t << ',' << (t < 0.5 - 1e-9 ? 1 : -1) << ",0," << 30.0 * std::sin(kTwoPi * t) << ",0,0\n";
  }
  return csv.str();
}

std::vector<double> even_times(double period, int count) {
  std::vector<double> times;
  for (int k = 0; k < count; ++k) {
    times.push_back(period * k);
  }
  return times;
}

/// Steps of 3 to 7 ms, as a servo's bus gives them.
std::vector<double> jittering_times(double end) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> step(3e-3, 7e-3);
  std::vector<double> times{0.0};
  while (times.back() < end) {
    times.push_back(times.back() + step(random));
  }
  return times;
}

class Uneven : public ScratchFolder {
 protected:
  Trial read(const std::string& csv, const std::string& what = "unit: s}",
             const std::string& by = "unit: s}") {
    write_file(folder / "data.csv", csv);
    write_file(folder / "trial.yaml", replaced(good_trial(), what, by));
    return read_trial(folder.string(), robot);
  }
  /// Largest distance of the angle from the sine that it was.
  static double error(const Trial& trial) {
    double most = 0.0;
    for (const Stretch& stretch : stretches_of(trial)) {
      for (Eigen::Index k = stretch.first; k < stretch.end; ++k) {
        const double truth = 30.0 * std::sin(kTwoPi * trial.time[k]) * kTwoPi / 360.0;
        most = std::max(most, std::abs(trial.measured[0].values[k] - truth));
      }
    }
    return most;
  }
};

TEST_F(Uneven, SamplesThatJitterAreResampledAtTheirMedianStep) {
  const Trial trial = read(log_at(jittering_times(1.0)));
  EXPECT_NEAR(trial.period, 5e-3, 0.3e-3);
  for (Eigen::Index k = 1; k < trial.samples(); ++k) {
    ASSERT_NEAR(trial.time[k] - trial.time[k - 1], trial.period, 1e-12);
  }
  // A straight line over h misses a curve by h^2/8 times its curvature: 7 ms, 30 deg (2 pi)^2 /s^2.
  EXPECT_LT(error(trial), 7e-3 * 7e-3 / 8 * 30 * kTwoPi / 360 * kTwoPi * kTwoPi * 1.01);
  ASSERT_EQ(trial.remarks.size(), 1U);
  EXPECT_NE(trial.remarks[0].find("resampled every"), std::string::npos) << trial.remarks[0];
  EXPECT_TRUE(trial.stretches.empty());
}

TEST_F(Uneven, ACommandKeepsItsImpulse) {
  const Trial trial =
      read(log_at(jittering_times(1.0)), "unit: s}", "unit: s, resample: {value: 4, unit: ms}}");
  EXPECT_DOUBLE_EQ(trial.period, 4e-3);
  // Held from row to row, 1 until the first row at or behind 0.5 s, then -1.
  const std::vector<double> times = jittering_times(1.0);
  const double turns = *std::lower_bound(times.begin(), times.end(), 0.5);
  const double end = trial.time[trial.samples() - 1] + trial.period;
  EXPECT_NEAR(trial.commands[0].values.sum() * trial.period, turns - (end - turns), 1e-9);
  const auto whole = [](double u) { return std::abs(std::abs(u) - 1.0) < 1e-12; };
  EXPECT_GE(std::count_if(trial.commands[0].values.begin(), trial.commands[0].values.end(), whole),
            trial.samples() - 1);
}

TEST_F(Uneven, DroppedSamplesAreBridgedAndLongGapsAreNot) {
  std::vector<double> times = even_times(0.01, 101);
  times.erase(times.begin() + 50, times.begin() + 70);  // 0.5 ... 0.69 s
  times.erase(times.begin() + 20);                      // 0.2 s
  const Trial trial = read(log_at(times));
  EXPECT_NEAR(trial.period, 0.01, 1e-12);
  ASSERT_EQ(trial.samples(), 101);
  ASSERT_EQ(trial.stretches.size(), 2U);
  EXPECT_EQ(trial.stretches[0].first, 0);
  EXPECT_EQ(trial.stretches[0].end, 50);  // the sample at 0.49 s is the last
  EXPECT_EQ(trial.stretches[1].first, 70);
  EXPECT_EQ(trial.stretches[1].end, 101);
  EXPECT_NEAR(trial.measured[0].values[30], 30 * std::sin(kTwoPi * 0.3) * kTwoPi / 360, 1e-12);
  EXPECT_LT(error(trial), 1e-3);
  EXPECT_EQ(read(log_at(times), "unit: s}", "unit: s, longest_gap: {value: 0.3, unit: s}}").stretches.size(),
            0U);
}

TEST_F(Uneven, StampsThatJitterWhereSamplesDoNot) {
  std::vector<double> times = even_times(0.01, 101);
  std::string csv = log_at(times);
  csv = replaced(csv, "\n0.14", "\n0.147");
  const Trial trial = read(csv, "unit: s}", "unit: s, resample: even}");
  EXPECT_EQ(trial.samples(), 101);
  EXPECT_NEAR(trial.measured[0].values[14], 30 * std::sin(kTwoPi * 0.14) * kTwoPi / 360, 1e-12);
}

TEST_F(Uneven, AbsoluteTimesCountFromTheFirstRow) {
  std::vector<double> nanoseconds = even_times(0.01, 101);
  const Trial trial = read(log_at(nanoseconds, 1.7e9));
  EXPECT_EQ(trial.time[0], 0.0);
  EXPECT_NEAR(trial.time[100], 1.0, 1e-6);
  ASSERT_FALSE(trial.remarks.empty());
  EXPECT_NE(trial.remarks[0].find("absolute"), std::string::npos);
}

TEST_F(Uneven, ARowThatComesTwiceInAHundredIsLeftOut) {
  std::vector<double> times = even_times(0.01, 301);
  times.insert(times.begin() + 100, times[99]);
  const Trial trial = read(log_at(times));
  EXPECT_EQ(trial.samples(), 301);
  EXPECT_LT(error(trial), 1e-12);
  ASSERT_EQ(trial.remarks.size(), 1U);
  EXPECT_NE(trial.remarks[0].find("1 rows whose time is not above"), std::string::npos) << trial.remarks[0];
}

TEST_F(Uneven, RowsWhoseTimeCannotBeAreLeftOutWhereThatIsAllowed) {
  std::vector<double> times = even_times(0.01, 101);
  for (const int row : {90, 60, 30, 12}) {
    times.insert(times.begin() + row, times[static_cast<std::size_t>(row) - 1]);
  }
  times.insert(times.begin() + 50, 2.7e154);
  times.push_back(1e9);
  EXPECT_THROW(read(log_at(times)), InputError);
  const Trial trial = read(log_at(times), "unit: s}", "unit: s}\nrows: {bad: leave_out}");
  EXPECT_EQ(trial.samples(), 101);
  EXPECT_LT(error(trial), 1e-12);
  ASSERT_EQ(trial.remarks.size(), 1U);
  EXPECT_EQ(trial.remarks[0].find("Left out: 6 rows"), 0U) << trial.remarks[0];
  EXPECT_THROW(read(log_at(times), "unit: s}", "unit: s}\nrows: {bad: ignore}"), InputError);
}

TEST_F(Uneven, SectionsAndWhatIsLeftOutMakeStretches) {
  const std::string sections =
      "section: [{from: {value: 0.1, unit: s}, to: {value: 0.5, unit: s}}, {from: {value: 0.6, unit: s}, to: "
      "{value: 1, unit: s}}]\nleave_out: [{from: {value: 0.7, unit: s}, to: {value: 0.75, unit: "
      "s}}]\ncommands:\n";
  const Trial trial = read(log_at(even_times(0.01, 101)), "commands:\n", sections);
  EXPECT_NEAR(trial.time[0], 0.1, 1e-12);
  EXPECT_EQ(trial.first_row, 10);
  ASSERT_EQ(trial.samples(), 90);  // 0.1 ... 0.99 s
  ASSERT_EQ(trial.stretches.size(), 3U);
  const auto time = [&](Eigen::Index k) { return trial.time[k]; };
  EXPECT_NEAR(time(trial.stretches[0].end - 1), 0.49, 1e-12);
  EXPECT_NEAR(time(trial.stretches[1].first), 0.6, 1e-12);
  EXPECT_NEAR(time(trial.stretches[1].end - 1), 0.69, 1e-12);
  EXPECT_NEAR(time(trial.stretches[2].first), 0.76, 1e-12);
  EXPECT_EQ(trial.stretches[2].end, trial.samples());
}

/// Takes the angle out of a row of a log.
void lose_angle(std::string& csv, int row) {
  std::size_t begin = 0;
  for (int line = 0; line <= row; ++line) {
    begin = csv.find('\n', begin) + 1;
  }
  for (int comma = 0; comma < 3; ++comma) {
    begin = csv.find(',', begin) + 1;
  }
  csv.replace(begin, csv.find(',', begin) - begin, "nan");
}

TEST_F(Uneven, CellsMayMissWhereTheTrialDoesNotLook) {
  std::string csv = log_at(even_times(0.01, 101));
  lose_angle(csv, 5);
  lose_angle(csv, 40);
  lose_angle(csv, 90);
  const std::string section =
      "section: {from: {value: 0.1, unit: s}, to: {value: 0.8, unit: s}}\ncommands:\n";
  const std::string message = input_error([&] { read(csv, "commands:\n", section); });
  EXPECT_NE(message.find("angle: found an empty field in row 41"), std::string::npos) << message;
  const Trial left =
      read(csv, "commands:\n",
           "leave_out: [{from: {value: 0.395, unit: s}, to: {value: 0.405, unit: s}}]\n" + section);
  EXPECT_EQ(left.stretches.size(), 2U);
  EXPECT_NEAR(left.time[0], 0.1, 1e-9);
  EXPECT_NEAR(left.time[left.samples() - 1], 0.79, 1e-9);  // the last sample before its end
  EXPECT_LT(error(left), 1e-3);
}

TEST_F(Uneven, MissingCellsAreFilledOnlyWhereTheTrialSaysSo) {
  std::string csv = log_at(even_times(0.01, 101));
  const auto lose = [&](int row) { lose_angle(csv, row); };
  lose(31);
  const std::string message = input_error([&] { read(csv); });
  EXPECT_NE(message.find("angle: found \"nan\""), std::string::npos) << message;
  EXPECT_NE(message.find("missing: fill"), std::string::npos) << message;
  const Trial one = read(csv, "commands:\n", "missing: fill\ncommands:\n");
  EXPECT_TRUE(one.stretches.empty());
  EXPECT_LT(error(one), 1e-3);
  for (int k = 61; k < 75; ++k) {
    lose(k);
  }
  const Trial many = read(csv, "commands:\n", "missing: fill\ncommands:\n");
  ASSERT_EQ(many.stretches.size(), 2U);
  EXPECT_EQ(many.stretches[0].end, 61);
  EXPECT_EQ(many.stretches[1].first, 75);
  EXPECT_LT(error(many), 1e-3);
}

TEST_F(Uneven, AnAngleThatWrapsIsUnwrapped) {
  std::ostringstream csv;
  csv << "t [s],u [N m],v [mV],angle [deg],place [mm],reference [mm]\n";
  for (int k = 0; k < 60; ++k) {
    csv << 0.01 * k << ",0,0," << std::fmod(25.0 * k, 360.0) << ',' << std::fmod(3.0 * k, 10.0) << ",0\n";
  }
  std::string yaml =
      replaced(good_trial(), "angle, unit: deg}", "angle, unit: deg, unwrap: true, scale: -1}");
  yaml = replaced(yaml, "{column: place}",
                  "{column: place, unwrap: {value: 1, unit: cm}, offset: {value: 1, unit: m}}");
  write_file(folder / "data.csv", csv.str());
  write_file(folder / "trial.yaml", yaml);
  const Trial trial = read_trial(folder.string(), robot);
  EXPECT_NEAR(trial.measured[0].values[59], -25.0 * 59 * kTwoPi / 360, 1e-9);
  EXPECT_NEAR(trial.measured[1].values[59], 1.0 + 3e-3 * 59, 1e-9);
}

/// The law with its own numbers, by hand.
TEST_F(Uneven, ACommandThatWasNotRecordedFollowsFromItsLaw) {
  std::string yaml = good_trial();
  yaml = replaced(yaml, "  drive: {column: v}\n", "");
  yaml = replaced(yaml, "cascade_pd", "pd");
  yaml = replaced(yaml, "{value: 160, unit: 1/s, source: test}", "{value: 2, unit: V/mm, source: test}");
  yaml = replaced(yaml, "    velocity_over: 2\n", "");
  write_file(folder / "data.csv", good_csv());
  write_file(folder / "trial.yaml", yaml);
  const Trial trial = read_trial(folder.string(), robot);
  ASSERT_EQ(trial.commands.size(), 2U);
  EXPECT_EQ(trial.commands[1].motor, "drive");
  EXPECT_NE(trial.commands[1].law.find("pd"), std::string::npos);
  // place 2k mm every 10 ms, reference 3k mm: 2 V/mm k mm - 0.25 V s/mm 200 mm/s = 2k - 50 V, cut at 10 V.
  EXPECT_NEAR(trial.commands[1].values[25], 0.0, 1e-9);
  EXPECT_NEAR(trial.commands[1].values[22], -6.0, 1e-9);
  EXPECT_NEAR(trial.commands[1].values[3], -10.0, 1e-9);
  EXPECT_NEAR(trial.commands[1].values[0], 0.0, 1e-9);  // no difference yet
  EXPECT_TRUE(trial.controllers.empty());

  write_file(folder / "trial.yaml",
             replaced(yaml, "reference: {column: reference}",
                      "reference: {column: reference}\n    velocity: {column: u, unit: mm/s}"));
  const std::string message = input_error([&] { read_trial(folder.string(), robot); });
  EXPECT_NE(message.find("\"N m\""), std::string::npos) << message;
}

TEST_F(Uneven, TheCommandOfAKnownCascadeIsComputedWhereNoneWasRecorded) {
  write_file(folder / "data.csv", good_csv());
  write_file(folder / "trial.yaml", replaced(good_trial(), "  drive: {column: v}\n", ""));
  const Trial trial = read_trial(folder.string(), robot);
  ASSERT_EQ(trial.commands.size(), 2U);
  ASSERT_EQ(trial.controllers.size(), 1U);
  // 250 V s/m (160/s k mm - 0.2 m/s), cut at 10 V.
  EXPECT_NEAR(trial.commands[1].values[5], 10.0, 1e-9);
  EXPECT_NEAR(trial.commands[1].values[1], 10.0, 1e-9);
}

TEST_F(Uneven, ClockShiftIsCarried) {
  const Trial trial =
      read(good_csv(), "commands:\n", "clock_shift_uncertainty: {value: 4, unit: ms}\ncommands:\n");
  EXPECT_NEAR(trial.clock_shift_uncertainty, 4e-3, 1e-15);
}

}  // namespace
}  // namespace plumbline::validation
