// What lies between a winding and a link: ripple, inductance, strain wave gears and couplings, against closed
// forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "simulator/effects/supply_law.h"
#include "tests/effects/rk4.h"
#include "tests/effects/sampling.h"

namespace plumbline::effects {
namespace {

constexpr double kTurn = 2.0 * 3.14159265358979323846;

std::shared_ptr<const ForceLaw> force_named(const std::string& name) {
  return std::dynamic_pointer_cast<const ForceLaw>(Catalogue::all().find(name));
}

// Three phases whose back EMF has a fifth harmonic, under sinusoidal currents (Jahns and Soong, section II):
// the torque is the sum of three products, e times i.
TEST(TorqueRipple, IsWhatAFifthHarmonicOfTheBackEmfMakes) {
  const auto law = force_named("torque_ripple");
  const double pairs = 4.0, fifth = 0.04;
  const Values p = values_of(*law, {{"cosine", fifth}, {"cycles", 6.0 * pairs}});
  for (const double current : {-2.0, 0.5, 3.0}) {
    for (const double angle : {0.0, 0.07, 0.19, 1.3}) {
      double torque = 0.0;
      for (int phase = 0; phase < 3; ++phase) {
        const double electrical = pairs * angle - phase * kTurn / 3.0;
        torque +=
            current * std::cos(electrical) * (std::cos(electrical) + fifth * std::cos(5.0 * electrical));
      }
      const double mean = 1.5 * current;
      EXPECT_NEAR(mean + law->force({angle, 0.0, mean}, nullptr, p.data()), torque, 1e-12);
    }
  }
}

TEST(TorqueRipple, LooksForSlotsAndPolesOfSmallMotors) {
  const auto starts = force_named("torque_ripple")->starts(test_scales());
  // 2p, 6p and slots: 7 pole pairs and 12 slots, 4 and 9, 2 and 6, 1 and 3 (six times 7 is 42).
  for (const double cycles : {14.0, 42.0, 12.0, 8.0, 24.0, 9.0, 4.0, 6.0, 2.0}) {
    EXPECT_EQ(std::count_if(starts.begin(), starts.end(), [&](const Values& p) { return p[2] == cycles; }), 1)
        << cycles;
  }
}

// L di/dt + R i = U with the rotor held: i = U/R (1 - exp(-R t/L)).
TEST(Winding, RisesWithLOverRWhileTheRotorIsHeld) {
  const auto law = force_named("winding");
  const double inductance = 4e-4, resistance = 0.8, k = 0.05, voltage = 12.0;
  const Values p =
      values_of(*law, {{"time_constant", inductance / resistance}, {"slope", k * k / resistance}});
  const double load = k * voltage / resistance;
  const Rate rate = [&](const State& s) {
    State r(1);
    law->state_rate({0.3, 0.0, load}, s.data(), p.data(), r.data());
    return r;
  };
  for (const double time : {1e-4, 5e-4, 3e-3}) {
    const State s = rk4(rate, {0.0}, time, 2000);
    const double current = voltage / resistance * (1.0 - std::exp(-resistance * time / inductance));
    EXPECT_NEAR(load + law->force({0.3, 0.0, load}, s.data(), p.data()), k * current, 1e-10);
  }
}

// The armature-controlled motor (Fitzgerald, Kingsley and Umans, chapter 11): J v' = K i, L i' + R i + K v
// = U. Poles s1, s2 of L J s^2 + R J s + K^2: v = U/K (1 + (s2 exp(s1 t) - s1 exp(s2 t))/(s1 - s2)).
TEST(Winding, RunsUpAsTheTwoPolesOfAnArmatureControlledMotorSay) {
  const auto law = force_named("winding");
  const double inductance = 4e-3, resistance = 0.8, k = 0.05, voltage = 12.0, inertia = 2e-4;
  const Values p =
      values_of(*law, {{"time_constant", inductance / resistance}, {"slope", k * k / resistance}});
  const double load = k * voltage / resistance;
  const Rate rate = [&](const State& x) {  // x: speed, torque
    const Motion m{0.0, x[0], load};
    State r(2);
    r[0] = (load + law->force(m, &x[1], p.data())) / inertia;
    law->state_rate(m, &x[1], p.data(), &r[1]);
    return r;
  };
  const double half = 0.5 * resistance / inductance;
  const double root = std::sqrt(half * half - k * k / (inductance * inertia));
  const double s1 = -half + root, s2 = -half - root;
  for (const double time : {2e-3, 0.02, 0.1}) {
    const double speed =
        voltage / k * (1.0 + (s2 * std::exp(s1 * time) - s1 * std::exp(s2 * time)) / (s1 - s2));
    EXPECT_NEAR(rk4(rate, {0.0, 0.0}, time, 20000)[0], speed, 1e-7);
  }
}

/// Share of its voltage that a battery keeps: V = V0 - Ri sum(d i), i = (d V - K v)/R, solved for V by Cramer
/// of all the circuits together.
double voltage_share(double v0, double inner, double resistance, double k, const std::vector<double>& duties,
                     const std::vector<double>& speeds) {
  double conductance = 1.0 / inner, driven = v0 / inner;  // Kirchhoff at the battery's pole
  for (std::size_t i = 0; i < duties.size(); ++i) {
    conductance += duties[i] * duties[i] / resistance;
    driven += duties[i] * k * speeds[i] / resistance;
  }
  return driven / conductance / v0;
}

TEST(Battery, KeepsTheVoltageThatKirchhoffSays) {
  const auto law = std::dynamic_pointer_cast<const SupplyLaw>(Catalogue::all().find("battery"));
  ASSERT_TRUE(law);
  const double v0 = 24.0, inner = 0.15, resistance = 0.6, k = 0.05;
  const Values p = values_of(
      *law, {{"stall_sag", inner / (v0 * v0) * resistance / (k * k)}, {"speed_sag", inner / (v0 * v0)}});
  const std::vector<std::vector<double>> duties{{0.3, 0.9, -0.5}, {-1.0, 0.2, 0.0}, {0.4, 0.4, 0.4}};
  const std::vector<double> speeds{120.0, -80.0, 300.0};
  for (const auto& duty : duties) {
    std::vector<double> torques;
    for (const double d : duty) torques.push_back(k / resistance * d * v0);
    EXPECT_NEAR(law->share(torques.data(), speeds.data(), 3, p.data()),
                voltage_share(v0, inner, resistance, k, duty, speeds), 1e-13);
  }
}

// At rest against its stall: matched to its inner resistance a battery keeps half of its voltage.
TEST(Battery, KeepsHalfAtTheMatchedLoad) {
  const auto law = std::dynamic_pointer_cast<const SupplyLaw>(Catalogue::all().find("battery"));
  const double v0 = 12.0, r = 0.4, k = 0.02, stall = k / r * v0, still = 0.0;
  const Values p =
      values_of(*law, {{"stall_sag", r / (v0 * v0) * r / (k * k)}, {"speed_sag", r / (v0 * v0)}});
  EXPECT_NEAR(law->share(&stall, &still, 1, p.data()), 0.5, 1e-15);
  EXPECT_EQ(law->share(&stall, &still, 1, law->null_values().data()), 1.0);
}

// A maker's table is of the output: K1 up to the torque T1, K2 above. At the motor of ratio N the torque is
// the Nth part and the windup N times as much.
TEST(HarmonicDrive, WindsUpAsADataSheetSays) {
  const auto law = force_named("harmonic_drive");
  const double k1 = 8100.0, k2 = 10800.0, t1 = 14.0, n = 100.0;
  const Values p = values_of(
      *law, {{"stiffness_soft", k1 / (n * n)}, {"stiffness_stiff", k2 / (n * n)}, {"windup", n * t1 / k1}});
  for (const double torque : {3.0, 14.0, 40.0}) {
    const double angle = torque < t1 ? torque / k1 : t1 / k1 + (torque - t1) / k2;
    for (const double side : {-1.0, 1.0}) {
      EXPECT_NEAR(n * law->force({side * n * angle, 0.0, 0.0}, nullptr, p.data()), -side * torque, 1e-9);
    }
  }
}

// A mass shot from rest through the soft part into the stiff one: two arcs of sines, one behind the other.
TEST(HarmonicDrive, SwingsInTwoArcs) {
  const auto law = force_named("harmonic_drive");
  const double mass = 0.02, soft = 3.0, stiff = 8.0, windup = 0.1, v0 = 2.5;
  const Values p =
      values_of(*law, {{"stiffness_soft", soft}, {"stiffness_stiff", stiff}, {"windup", windup}});
  const double w1 = std::sqrt(soft / mass), w2 = std::sqrt(stiff / mass);
  const double first = std::asin(w1 * windup / v0) / w1;
  const double v1 = std::sqrt(v0 * v0 - w1 * w1 * windup * windup);
  const double centre = windup * (1.0 - soft / stiff);  // where the stiff spring alone would be at rest
  const double second = std::atan2(v1, w2 * (windup - centre)) / w2;
  const Rate rate = [&](const State& y) {
    return State{y[1], law->force({y[0], y[1], 0.0}, nullptr, p.data()) / mass};
  };
  const State turn = rk4(rate, {0.0, v0}, first + second, 200000);
  EXPECT_NEAR(turn[0], centre + std::hypot(windup - centre, v1 / w2), 1e-6);
  EXPECT_NEAR(turn[1], 0.0, 1e-5);  // the corner is met within a step
}

/// The windup of a coupling whose stretch goes by `way`.
double pulled(const ForceLaw& law, const Values& p, double windup, double way) {
  const double v = way > 0.0 ? 0.4 : -0.4;
  return rk4(
      [&](const State& s) {
        State r(1);
        law.state_rate({0.0, v, 0.0}, s.data(), p.data(), r.data());
        return r;
      },
      {windup}, way / v, 20000)[0];
}

// While it is pulled one way, d(windup)/dx = 1 - r^8: x is limit/stiffness times the integral of 1/(1 - r^8),
// the series of r^(8 m + 1)/(8 m + 1).
TEST(SlippingCoupling, BendsTowardsItsLimitAsTheSeriesSays) {
  const auto law = force_named("slipping_coupling");
  const double limit = 2.0, stiffness = 40.0;
  const Values p = values_of(*law, {{"limit", limit}, {"stiffness", stiffness}});
  for (const double r : {0.3, 0.8, 0.97}) {
    double x = 0.0;
    for (int m = 0; m < 300; ++m) x += std::pow(r, 8 * m + 1) / (8 * m + 1);
    EXPECT_NEAR(pulled(*law, p, 0.0, x * limit / stiffness), r * limit / stiffness, 1e-9);
    EXPECT_NEAR(pulled(*law, p, 0.0, -x * limit / stiffness), -r * limit / stiffness, 1e-9);
  }
}

// An elastic and perfectly plastic piece: capped, and a spring on its way back; what slipped stays.
TEST(SlippingCoupling, KeepsWhatItSlippedAndGoesBackAsASpring) {
  const auto law = force_named("slipping_coupling");
  const double limit = 2.0, stiffness = 40.0;
  const Values p = values_of(*law, {{"limit", limit}, {"stiffness", stiffness}});
  const double full = pulled(*law, p, 0.0, 1.0);
  EXPECT_NEAR(law->force({1.0, 0.0, 0.0}, &full, p.data()), -limit, 1e-6);
  const double way = 0.7 * limit / stiffness;
  EXPECT_NEAR(pulled(*law, p, full, -way), full - way, 1e-12);
  const double none = pulled(*law, p, full, -full);
  EXPECT_NEAR(law->force({1.0 - full, 0.0, 0.0}, &none, p.data()), 0.0, 1e-9);
}

// Slipping on at a constant speed: all that goes in is lost.
TEST(SlippingCoupling, LosesItsLimitTimesTheSlip) {
  const auto law = force_named("slipping_coupling");
  const Values p = values_of(*law, {{"limit", 2.0}, {"stiffness", 40.0}, {"damping", 0.3}});
  const double full = pulled(*law, p, 0.0, 2.0);
  EXPECT_NEAR(law->dissipated_power({9.0, 0.4, 0.0}, &full, p.data()), 2.0 * 0.4, 1e-6);
}

// A link (inertia J, m l of its weight) on a mounting (M in all, k, c): J q" + m l b" = u, M b" + m l q" + c
// b'
// + k b = 0, from Lagrange. The same q by a resonator of m^2 l^2/M at a link that is lighter by as much.
TEST(Resonator, IsAMountingThatYieldsAtALighterLink) {
  const auto law = force_named("resonator");
  const double J = 0.2, ml = 0.5, M = 4.0, k = 3000.0, c = 8.0;
  const double inertia = ml * ml / M, frequency = std::sqrt(k / M) / kTurn;
  const Values p = values_of(
      *law, {{"inertia", inertia}, {"frequency", frequency}, {"damping_ratio", 0.5 * c / std::sqrt(k * M)}});
  const auto torque = [](double time) { return 3.0 * std::sin(20.0 * time) + std::sin(37.0 * time); };
  const Rate yielding = [&](const State& x) {  // time, q, b, q', b'
    const double u = torque(x[0]), base = -c * x[4] - k * x[2];
    const double determinant = J * M - ml * ml;
    return State{1.0, x[3], x[4], (M * u - ml * base) / determinant, (J * base - ml * u) / determinant};
  };
  const Rate ridden = [&](const State& x) {  // time, q, q', stretch, speed
    const Motion m{x[1], x[2], 0.0};
    State r{1.0, x[2], (torque(x[0]) + law->force(m, &x[3], p.data())) / (J - inertia), 0.0, 0.0};
    law->state_rate(m, &x[3], p.data(), &r[3]);
    return r;
  };
  for (const double time : {0.1, 0.5, 1.0}) {
    const double q = rk4(yielding, {0.0, 0.0, 0.0, 0.0, 0.0}, time, 20000)[1];
    EXPECT_NEAR(rk4(ridden, {0.0, 0.0, 0.0, 0.0, 0.0}, time, 20000)[1], q, 1e-8);
    EXPECT_GT(std::abs(q), 1e-3);
  }
}

}  // namespace
}  // namespace plumbline::effects
