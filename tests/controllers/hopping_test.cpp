#include "controllers/mabel_hopping/hopping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "tests/controllers/hopping_example.h"

namespace plumbline::controllers {
namespace {

// A sample at a time; the hip sinks, rests or rises by counts of the boom's pitch (1 count: 0.392 m/s).
class Rig {
 public:
  explicit Rig(const HoppingConfig& config = hopping_example()) : controller(config) {}
  HoppingTorques next(bool left, bool right, int pitch_step = -3) {
    sample.left_contact = left;
    sample.right_contact = right;
    sample.boom_pitch += pitch_step;
    return controller.command(sample);
  }
  HoppingTorques run(int samples, bool left, bool right, int pitch_step = -3) {
    HoppingTorques torques;
    for (int k = 0; k < samples; ++k) torques = next(left, right, pitch_step);
    return torques;
  }
  std::string phase() const { return to_string(controller.phase()); }
  // From I through III and V to the next touchdown.
  void hop(std::int64_t tower_step) {
    run(3, false, false);
    next(true, true);
    next(true, true, 0);
    next(false, false, 3);
    run(50, false, false, 0);
    sample.tower += tower_step;
    next(true, true);
    ASSERT_EQ(phase(), "II");
  }

  Hopping controller;
  HoppingSample sample;
};

void expect_reference(const Hopping& controller, double LA_left, double mLS_left, double LA_right,
                      double mLS_right) {
  const HoppingVector& reference = controller.reference();
  EXPECT_NEAR(reference.LA_left, LA_left, 1e-12);
  EXPECT_NEAR(reference.mLS_left, mLS_left, 1e-12);
  EXPECT_NEAR(reference.LA_right, LA_right, 1e-12);
  EXPECT_NEAR(reference.mLS_right, mLS_right, 1e-12);
}

// One hop of Figure S3 with the encoders moving all the while. Numbers of the paper, worked out by hand:
//   leg shape 31.42 * 0.209 = 6.56678; extended left 31.42 * (0.209 - 0.087) = 3.83324, right
//   31.42 * (0.209 - 0.227) = -0.56556; retracted 31.42 * (0.209 + 0.087) = 9.30032
//   in flight -0.262 - 0.140 = -0.402 and 0.262 - 0.140 = 0.122
// on the ground, with torso angle T and right leg angle R: right T + R - 0.140, left 0.524 less.
TEST(Hopping, ReferencesOfEveryPhase) {
  Rig rig;
  rig.run(2, false, false);
  expect_reference(rig.controller, -0.402, 6.56678, 0.122, 6.56678);  // S5

  rig.sample.torso = 100;
  rig.sample.right.thigh = 2000;
  rig.sample.right.knee = -150;
  const auto T = [&] { return static_cast<double>(rig.sample.torso) * turn / 6144; };
  const auto R = [&] {
    return static_cast<double>(rig.sample.right.thigh) * turn / 40550.4 +
           0.5 * static_cast<double>(rig.sample.right.knee) * turn / 2048;
  };
  rig.next(true, true);
  EXPECT_EQ(rig.phase(), "II");
  expect_reference(rig.controller, T() + R() - 0.664, 6.56678, T() + R() - 0.140, 6.56678);  // S7
  rig.sample.torso = 140;
  rig.next(true, true);
  expect_reference(rig.controller, T() + R() - 0.664, 6.56678, T() + R() - 0.140, 6.56678);

  rig.sample.right.knee = -170;
  rig.next(true, true, 0);
  EXPECT_EQ(rig.phase(), "III");
  expect_reference(rig.controller, T() + R() - 0.664, 3.83324, T() + R() - 0.140, -0.56556);  // S9

  rig.sample.torso = 90;
  rig.sample.right.thigh = 2100;
  rig.next(false, true, 3);
  EXPECT_EQ(rig.phase(), "IVa");
  const double held = T() + R() - 0.140;                                    // h_III^ref at t_III*
  expect_reference(rig.controller, held - 0.524, 9.30032, held, -0.56556);  // S13
  rig.sample.torso = 20;
  rig.sample.right.thigh = 2500;
  rig.next(false, true, 3);
  expect_reference(rig.controller, held - 0.524, 9.30032, held, -0.56556);

  rig.next(false, false, 3);
  EXPECT_EQ(rig.phase(), "V");
  expect_reference(rig.controller, held - 0.524, 9.30032, held, 9.30032);  // S17
  rig.sample.torso = 0;
  rig.run(49, false, false, 1);
  EXPECT_EQ(rig.phase(), "V");
  EXPECT_NEAR(rig.controller.time_in_phase(), 0.049, 1e-12);
  expect_reference(rig.controller, held - 0.524, 9.30032, held, 9.30032);
  rig.next(false, false);
  EXPECT_EQ(rig.phase(), "I");
  expect_reference(rig.controller, -0.402, 6.56678, 0.122, 6.56678);
}

TEST(Hopping, ReferencesWithTheRightFootFirstAndWithBothAtOnce) {
  for (const bool both : {false, true}) {
    Rig rig;
    rig.sample.torso = 140;
    rig.run(2, true, true);
    rig.next(true, true, 0);
    rig.sample.torso = 90;
    rig.next(!both, false, 3);
    const double held = 90 * turn / 6144 - 0.140;
    EXPECT_EQ(rig.phase(), both ? "V" : "IVb");
    expect_reference(rig.controller, held - 0.524, both ? 9.30032 : 3.83324, held, 9.30032);  // S15, S17
  }
}

TEST(Hopping, LegsKeepTheirOwnParameters) {
  HoppingConfig config = hopping_example();
  config.parameters.gamma_LS_to_mLS = 10.0;
  config.parameters.h_LS_left = 0.2;
  config.parameters.h_LS_right = 0.3;
  config.parameters.delta_LS_plus_left = 0.01;
  config.parameters.delta_LS_plus_right = 0.02;
  Rig rig(config);
  rig.next(true, true);
  EXPECT_NEAR(rig.controller.reference().mLS_left, 2.0, 1e-12);
  EXPECT_NEAR(rig.controller.reference().mLS_right, 3.0, 1e-12);
  rig.next(true, true, 0);
  rig.next(false, false, 0);
  EXPECT_NEAR(rig.controller.reference().mLS_left, 2.1, 1e-12);
  EXPECT_NEAR(rig.controller.reference().mLS_right, 3.2, 1e-12);
}

// Counts that stand still: u = K_p (h^ref - h), the leg angles' part divided by -23.53.
TEST(Hopping, PositionPartOfS4) {
  Rig rig;
  rig.sample.left = {0, 2000, -2500, -100};  // q_mLS 6.13592; q_LA -0.387369 - 0.153398 = -0.540767
  rig.sample.right = {0, 2200, 1000, -120};  // q_mLS 6.74952; q_LA  0.154948 - 0.184078 = -0.029130
  const HoppingTorques u = rig.run(3, false, false);
  EXPECT_NEAR(rig.controller.controlled().LA_left, -0.540767, 1e-6);
  EXPECT_NEAR(rig.controller.controlled().LA_right, -0.029130, 1e-6);
  EXPECT_NEAR(u.mLA_left, 400.0 * (-0.402 + 0.540767) / -23.53, 1e-4);
  EXPECT_NEAR(u.mLS_left, 2.0 * (6.56678 - 6.135923), 1e-4);
  EXPECT_NEAR(u.mLA_right, 500.0 * (0.122 + 0.029130) / -23.53, 1e-4);
  EXPECT_NEAR(u.mLS_right, 3.0 * (6.56678 - 6.749515), 1e-4);
  EXPECT_LT(u.mLA_left, 0.0);  // the leg has to swing forward, so its motor turns backward
}

// Every encoder on a ramp of whole counts: what it adds to the torques at rest is -K_d dh/dt.
TEST(Hopping, VelocityPartOfS4) {
  HoppingConfig config = hopping_example();
  config.leg_angle_filter = {9, 2, 0.0};
  config.leg_shape_filter = {5, 1, 0.0};
  config.torque_limit_mLA = config.torque_limit_mLS = 1e6;
  Rig moving(config);
  for (int k = 0; k < 30; ++k) {
    moving.sample.left = {0, 2 * k, 4 * k, -3 * k};
    moving.sample.right = {0, -5 * k, -6 * k, 2 * k};
    if (k < 29) moving.next(false, false);
  }
  const HoppingTorques u = moving.next(false, false);
  Rig still(config);
  still.sample = moving.sample;
  const HoppingTorques at_rest = still.next(false, false);
  const double thigh = turn / 40550.4 / 1e-3;  // rad/s for one count each sample
  const double coarse = turn / 2048 / 1e-3;
  EXPECT_NEAR(u.mLA_left - at_rest.mLA_left, -10.0 * (4 * thigh - 1.5 * coarse) / -23.53, 1e-9);
  EXPECT_NEAR(u.mLS_left - at_rest.mLS_left, -0.05 * 2 * coarse, 1e-9);
  EXPECT_NEAR(u.mLA_right - at_rest.mLA_right, -20.0 * (-6 * thigh + coarse) / -23.53, 1e-9);
  EXPECT_NEAR(u.mLS_right - at_rest.mLS_right, -0.10 * -5 * coarse, 1e-9);
}

TEST(Hopping, LegAngleFromTheMotor) {
  HoppingConfig config = hopping_example();
  config.leg_angle_rate = LegAngleSource::motor;
  Rig rate_only(config);
  config.leg_angle = LegAngleSource::motor;
  Rig both(config);
  for (Rig* rig : {&rate_only, &both}) {
    rig->sample.left.thigh = 1000;
    rig->next(false, false);
    rig->sample.left.mLA = -2048;  // one turn back: the leg swings 1/23.53 turns forward
    rig->next(false, false);
    EXPECT_NEAR(rig->controller.rates().LA_left, turn / 23.53 / 1e-3, 1e-9);
  }
  EXPECT_NEAR(rate_only.controller.controlled().LA_left, 1000 * turn / 40550.4, 1e-12);
  EXPECT_NEAR(both.controller.controlled().LA_left, turn / 23.53, 1e-12);
}

TEST(Hopping, TorquesStayWithinTheirLimits) {
  Rig rig;
  rig.sample.left = {0, 40000, 20000, 0};
  rig.sample.right = {0, -40000, -20000, 0};
  HoppingTorques u = rig.next(false, false);
  EXPECT_EQ(u.mLA_left, 10.0);
  EXPECT_EQ(u.mLS_left, -20.0);
  EXPECT_EQ(u.mLA_right, -10.0);
  EXPECT_EQ(u.mLS_right, 20.0);
  rig.sample.left.thigh = rig.sample.right.thigh = INT64_MAX / 2;
  u = rig.next(true, true);
  EXPECT_LE(std::abs(u.mLA_left), 10.0);
  EXPECT_LE(std::abs(u.mLA_right), 10.0);
}

// S8 on counts: one count each sample is 0.392 m/s at the hip.
TEST(Hopping, HipVelocityComesFromTheBoom) {
  Rig rig;
  rig.run(3, true, true, -1);
  EXPECT_NEAR(rig.controller.hip_velocity(), -2.25 * turn / 36044.8 / 1e-3, 1e-5);  // cos(pitch) is nearly 1
  EXPECT_EQ(rig.phase(), "II");
  rig.next(true, true, 2);  // from -0.39 to +0.78 m/s: the band was never seen
  EXPECT_EQ(rig.phase(), "III");
}

// The paper's law in words: less backward travel than wanted leans the torso further backward (positive),
// more leans it less. K_T = 0.5; wanted -0.120 rad.
TEST(Hopping, EventBasedUpdate) {
  Rig rig;
  const auto counts = [](double radians) { return std::llround(radians * 295948 / turn); };
  const double count = turn / 295948;
  rig.sample.tower = counts(1.0);  // wherever the tower stands at the first landing
  rig.run(2, false, false);
  rig.next(true, true);
  EXPECT_EQ(rig.controller.h_T_d(), 0.140);
  EXPECT_EQ(rig.controller.hops(), 0);
  rig.next(true, true, 0);
  rig.next(false, false, 3);
  rig.run(50, false, false, 0);
  rig.sample.tower += counts(-0.080);
  rig.next(false, false);
  EXPECT_EQ(rig.controller.h_T_d(), 0.140);  // only at the touchdown
  rig.next(true, true);
  EXPECT_EQ(rig.controller.hops(), 1);
  EXPECT_NEAR(rig.controller.h_T_d(), 0.140 + 0.5 * 0.040, 0.5 * count);
  EXPECT_NEAR(rig.controller.reference().LA_right, -0.160, 0.5 * count);  // S7 uses it at once
  rig.next(true, true, 0);
  rig.next(false, false, 3);
  rig.run(50, false, false, 0);
  EXPECT_NEAR(rig.controller.reference().LA_right, 0.262 - 0.160, 0.5 * count);  // S5 too
  rig.sample.tower += counts(-0.150);
  rig.next(true, true);
  EXPECT_NEAR(rig.controller.h_T_d(), 0.140 - 0.5 * 0.030, 0.5 * count);  // from h_T0, not from the last
  EXPECT_EQ(rig.controller.hops(), 2);
}

TEST(Hopping, UpdateIsLimitedAndCanBeOff) {
  HoppingConfig config = hopping_example();
  for (const bool on : {true, false}) {
    config.parameters.event_update = on;
    for (const int sign : {1, -1}) {
      Rig rig(config);
      rig.hop(sign * 40000);
      EXPECT_EQ(rig.controller.hops(), 1);
      EXPECT_DOUBLE_EQ(rig.controller.h_T_d(), on ? 0.140 + sign * 0.05 : 0.140);
    }
  }
}

TEST(Hopping, ABounceIsNoHop) {
  Rig rig;
  rig.hop(-4000);
  const double wanted = rig.controller.h_T_d();
  EXPECT_NE(wanted, 0.140);
  rig.next(true, false);
  EXPECT_EQ(rig.phase(), "I");
  rig.sample.tower += 100;
  rig.next(true, true);
  EXPECT_EQ(rig.phase(), "II");
  EXPECT_EQ(rig.controller.h_T_d(), wanted);
  EXPECT_EQ(rig.controller.hops(), 1);
}

// The whole chain of signs: a torso of inertia J on two legs that stand fixed, 30 degrees apart. The joint
// torque on a leg is gamma times the motor's, its reaction turns the torso, and q_LA = leg - q_T. With equal
// gains S7 makes J q_T'' = -2 Kp (q_T - h_T^d) - 2 Kd q_T': any textbook's oscillator, here critically
// damped, q_T - h_T^d = a (1 + w t) exp(-w t), w = Kd / J. The tolerance is the sample's delay, of order
// w T = 1e-3 of the start.
TEST(Hopping, RightsTheTorsoOnStandingLegs) {
  HoppingConfig config = hopping_example();
  const double J = 2.0;
  const double kd = 20.0;
  config.left = config.right = {kd * kd / (2 * J), kd, 0.0, 0.0};
  config.period = 1e-4;
  config.torque_limit_mLA = 1e3;
  config.resolution.thigh = config.resolution.torso = 1e-9;
  config.supplements.touchdown_time_min = 10.0;
  Hopping controller(config);
  const double w = kd / J;
  const double start = -0.2;
  double q_T = 0.140 + start;
  double rate = 0.0;
  HoppingSample sample;
  sample.left_contact = sample.right_contact = true;
  for (int k = 0; k < 10000; ++k) {
    sample.torso = std::llround(q_T / 1e-9);
    sample.left.thigh = std::llround((-0.262 - q_T) / 1e-9);
    sample.right.thigh = std::llround((0.262 - q_T) / 1e-9);
    const HoppingTorques u = controller.command(sample);
    const double t = k * config.period;
    ASSERT_NEAR(q_T - 0.140, start * (1 + w * t) * std::exp(-w * t), 1e-3);
    const double acceleration = -(-23.53) * (u.mLA_left + u.mLA_right) / J;
    q_T += rate * config.period + 0.5 * acceleration * config.period * config.period;
    rate += acceleration * config.period;
  }
  EXPECT_NEAR(q_T, 0.140, 1e-3);
}

TEST(Hopping, ResetForgetsEveryVelocity) {
  Rig rig;
  rig.run(3, false, false, -50);
  rig.sample.left.mLS = rig.sample.right.knee = 900;
  rig.controller.reset();
  rig.next(false, false);
  EXPECT_EQ(rig.controller.hip_velocity(), 0.0);
  EXPECT_EQ(rig.controller.rates().mLS_left, 0.0);
  EXPECT_EQ(rig.controller.rates().LA_right, 0.0);
}

// Random counts and switches, long enough for every phase.
std::vector<HoppingTorques> wild_run(Hopping& controller) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> step(-6, 6);
  std::uniform_int_distribution<int> often(0, 9);
  std::vector<HoppingTorques> torques;
  HoppingSample sample;
  for (int k = 0; k < 5000; ++k) {
    for (LegCounts* leg : {&sample.left, &sample.right}) {
      leg->mLA += step(random);
      leg->mLS += step(random);
      leg->thigh += step(random);
      leg->knee += step(random);
    }
    sample.torso += step(random);
    sample.tower += step(random);
    sample.boom_pitch += step(random);
    if (often(random) == 0) sample.left_contact = !sample.left_contact;
    if (often(random) == 0) sample.right_contact = !sample.right_contact;
    torques.push_back(controller.command(sample));
  }
  return torques;
}

TEST(Hopping, RepeatsItselfBitForBit) {
  HoppingConfig config = hopping_example();
  config.leg_angle_filter = {9, 2, 0.002};
  Hopping first(config);
  Hopping second(config);
  const std::vector<HoppingTorques> a = wild_run(first);
  const std::vector<HoppingTorques> b = wild_run(second);
  EXPECT_GT(first.hops(), 5);
  ASSERT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]), 0);
  first.reset();
  EXPECT_EQ(first.hops(), 0);
  const std::vector<HoppingTorques> c = wild_run(first);
  EXPECT_EQ(std::memcmp(a.data(), c.data(), a.size() * sizeof a[0]), 0);
}

TEST(HoppingPower, AStopsSwitchTurnsItOffUntilReset) {
  HoppingConfig config = hopping_example();
  config.workspace.leg_shape_to = 0.5;
  config.workspace.leg_angle_from = -1.0;
  Rig rig(config);
  rig.run(3, false, false);
  EXPECT_NE(rig.controller.command(rig.sample).mLS_left, 0.0);
  rig.sample.right.knee = -330;  // leg shape 165 counts of 2 pi/2048: 0.506 rad
  const HoppingTorques off = rig.controller.command(rig.sample);
  EXPECT_EQ(rig.controller.power_off(), StopSwitch::leg_shape_right);
  EXPECT_STREQ(to_string(rig.controller.power_off()), "leg shape, right");
  EXPECT_EQ(off.mLA_left, 0.0);
  EXPECT_EQ(off.mLS_left, 0.0);
  EXPECT_EQ(off.mLA_right, 0.0);
  EXPECT_EQ(off.mLS_right, 0.0);
  rig.sample.right.knee = 0;  // back inside: the power stays off
  EXPECT_EQ(rig.controller.command(rig.sample).mLS_left, 0.0);
  rig.controller.reset();
  EXPECT_EQ(rig.controller.power_off(), StopSwitch::none);
  EXPECT_NE(rig.controller.command(rig.sample).mLS_left, 0.0);
  rig.sample.left.thigh = -6500;  // -1.007 rad
  rig.controller.command(rig.sample);
  EXPECT_EQ(rig.controller.power_off(), StopSwitch::leg_angle_left);
}

TEST(HoppingPower, WithoutAWorkspaceThereIsNoSwitch) {
  Rig rig;
  rig.sample.left.thigh = 100000;
  rig.sample.right.knee = -100000;
  rig.run(3, false, false);
  EXPECT_EQ(rig.controller.power_off(), StopSwitch::none);
}

// As if a landing lay behind it: the very next one updates, from the tower and the angle given.
TEST(HoppingResume, GoesOnInFlight) {
  const HoppingConfig config = hopping_example();
  Rig rig(config);
  rig.controller.resume(0.2, 1000);
  EXPECT_EQ(rig.phase(), "I");
  EXPECT_EQ(rig.controller.h_T_d(), 0.2);
  rig.sample.tower = 1000 - 4000;
  rig.run(3, false, false);
  rig.next(true, true);
  ASSERT_EQ(rig.phase(), "II");
  const double travelled = -4000 * turn / 295948;
  EXPECT_NEAR(rig.controller.h_T_d(), 0.140 + 0.5 * (travelled + 0.120), 1e-12);
}

}  // namespace
}  // namespace plumbline::controllers
