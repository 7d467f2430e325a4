// The ASLIP beside the curves of its paper (robots/thumper/curves: TAC Figures 5 and 6, pages 11 and 12).
#include "validation/studies/aslip/aslip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "simulator/trace/table.h"
#include "validation/studies/aslip/aslip_file.h"

namespace plumbline::validation {
namespace {

const std::string kFolder = PLUMBLINE_ROOT "/robots/thumper/";

struct Orbit {
  AslipFile file = read_aslip(kFolder + "aslip.yaml");
  AslipOrbit orbit = find_aslip_orbit(file.model, file.readings, file.gains);
  AslipRun run = run_aslip(file.model, orbit.control, orbit.liftoff, 1);
};

const Orbit& orbit() {
  static const Orbit one;
  return one;
}

using Member = double (*)(const AslipSample&);

double at(const AslipRun& run, double time, Member member) {
  const auto after = std::find_if(run.samples.begin() + 1, run.samples.end(),
                                  [&](const AslipSample& sample) { return sample.time >= time; });
  if (after == run.samples.end()) {
    return member(run.samples.back());
  }
  const AslipSample &a = *(after - 1), &b = *after;
  const double share = b.time > a.time ? (time - a.time) / (b.time - a.time) : 1.0;
  return member(a) + share * (member(b) - member(a));
}

/// Root mean square of the difference at the curve's own points.
double rms(const AslipRun& run, const std::string& curve, double from, double to, double scale,
           Member member) {
  const Table table = read_csv(kFolder + "curves/" + curve);
  double sum = 0.0;
  int count = 0;
  for (Eigen::Index i = 0; i < table.rows(); ++i) {
    const double time = table.columns[0].values[i];
    if (time > from && time < to) {
      sum += std::pow(at(run, time, member) - scale * table.columns[1].values[i], 2);
      ++count;
    }
  }
  EXPECT_GT(count, 50) << curve;
  return std::sqrt(sum / count);
}

double leg_force(const AslipSample& s) { return s.leg_force; }
double hip_torque(const AslipSample& s) { return s.hip_torque; }
double actuator_force(const AslipSample& s) { return s.actuator_force; }
double pitch(const AslipSample& s) { return s.state.pitch; }

TEST(Aslip, OrbitIsPeriodic) {
  const AslipState &start = orbit().orbit.liftoff, &end = orbit().run.samples.back().state;
  EXPECT_NEAR(end.y, start.y, 1e-9);
  EXPECT_NEAR(end.pitch, start.pitch, 1e-12);
  EXPECT_NEAR(end.x_rate, start.x_rate, 1e-9);
  EXPECT_NEAR(end.y_rate, start.y_rate, 1e-9);
}

// Nothing here was used to find the orbit. The curve's times are read to 0.1 ms; its forces, which change by
// 15 N/ms, to 1.5 N.
TEST(Aslip, StanceIsThePapers) {
  const AslipRun& run = orbit().run;
  EXPECT_NEAR(run.samples.back().time - run.touchdowns.at(0), 0.2016, 2e-4);
  double force = 0.0, slowest = 9.0;
  for (const AslipSample& sample : run.samples) {
    force = std::max(force, sample.leg_force);
    slowest = std::min(slowest, sample.state.x_rate);
  }
  EXPECT_NEAR(force, 952.3, 1.0);
  EXPECT_NEAR(slowest, 1.847, 5e-4);
  const double end = run.samples.back().time;
  EXPECT_LT(rms(run, "aslip_leg_force.csv", 0.2706, end - 5e-4, 1.0, leg_force), 1.5);
  EXPECT_LT(rms(run, "aslip_hip_torque.csv", 0.2706, end - 5e-4, 1.0, hip_torque), 0.03);
}

// The spring takes all of the force but 5 N; what is left hangs on 0.1 mm of leg (0.76 N) at either end.
TEST(Aslip, ActuatorForceIsThePapers) {
  const AslipRun& run = orbit().run;
  EXPECT_LT(rms(run, "aslip_actuator_force.csv", 0.2706, run.samples.back().time - 5e-4, 1.0, actuator_force),
            0.5);
}

TEST(Aslip, PathIsThePapers) {
  const Table table = read_csv(kFolder + "curves/aslip_path.csv");
  double sum = 0.0;
  for (Eigen::Index i = 0; i < table.rows(); ++i) {
    const double x = table.columns[0].values[i];
    const auto& samples = orbit().run.samples;
    const auto after = std::find_if(samples.begin() + 1, samples.end() - 1,
                                    [&](const AslipSample& sample) { return sample.state.x >= x; });
    const AslipState &a = (after - 1)->state, &b = after->state;
    const double y = b.x > a.x ? a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y) : b.y;
    sum += std::pow(y - table.columns[1].values[i], 2);
  }
  EXPECT_LT(std::sqrt(sum / static_cast<double>(table.rows())), 2e-4);
}

// Figure 6: 6 degrees less of pitch at the second lift-off, about the hip. Pitch and the speed of each flight
// are the paper's.
TEST(Aslip, RecoversFromThePapersPush) {
  AslipPush push;
  push.liftoff = 1;
  push.pitch = -5.998 * M_PI / 180.0;
  const AslipRun run = run_aslip(orbit().file.model, orbit().orbit.control, orbit().orbit.liftoff, 10, push);
  ASSERT_FALSE(run.fell);
  double highest = 0.0;
  for (const AslipSample& sample : run.samples) {
    highest = std::max(highest, sample.state.pitch * 180.0 / M_PI);
  }
  EXPECT_NEAR(highest, 92.10, 0.15);
  EXPECT_LT(rms(run, "aslip_recovery_pitch.csv", 0.48, 4.6, M_PI / 180.0, pitch), 0.4 * M_PI / 180.0);
  // Figure 6(c): the speeds of the flights behind the push, and Figure 6(a), (c): how long they last.
  const auto speed_at = [&](double time) {
    double speed = 0.0;
    for (const AslipSample& sample : run.samples) {
      speed = sample.time <= time ? sample.state.x_rate : speed;
    }
    return speed;
  };
  const double published[] = {1.97499, 2.01256, 2.01886, 2.01703, 2.01124, 2.0076, 2.00412, 2.00263};
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_NEAR(speed_at(run.liftoffs[k + 2]), published[k], 4e-3) << "flight " << k + 2;
  }
  EXPECT_NEAR(run.touchdowns[1] - run.liftoffs[1], 0.2689, 1e-3);
  EXPECT_NEAR(run.touchdowns[2] - run.liftoffs[2], 0.2257, 4e-3);
}

}  // namespace
}  // namespace plumbline::validation
