// Springs, stretch and play against the motions that textbooks give for them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "tests/effects/rk4.h"
#include "tests/effects/sampling.h"

namespace plumbline::effects {
namespace {

constexpr double kPi = 3.14159265358979323846;

std::shared_ptr<const ForceLaw> law_named(const std::string& name) {
  return std::dynamic_pointer_cast<const ForceLaw>(Catalogue::all().find(name));
}

/// A mass on the law: {position, velocity} after some time.
State swing(const ForceLaw& law, const Values& p, double mass, const State& x, double duration, int steps) {
  return rk4(
      [&](const State& y) {
        return State{y[1], law.force({y[0], y[1], 0}, nullptr, p.data()) / mass};
      },
      x, duration, steps);
}

double value(const Law& law, const Values& p, const std::string& name) {
  return p[static_cast<std::size_t>(law.parameter_index(name))];
}

// Underdamped oscillator (Thomson, Theory of Vibration, chapter 2): after one damped period
// 2 pi/(w sqrt(1 - zeta^2)) the displacement has shrunk by exp(-2 pi zeta/sqrt(1 - zeta^2)).
TEST(CableStretch, StartsRingAtTheirFrequenciesAndDecayOrCreep) {
  const auto law = law_named("cable_stretch");
  const Scales scales = test_scales();
  std::vector<Values> starts;
  std::size_t creeping = 0;
  for (const Values& p : law->starts(scales)) {
    const double ratio =
        value(*law, p, "damping") / (2.0 * std::sqrt(value(*law, p, "stiffness") * scales.inertia));
    if (ratio < 1.0) {
      starts.push_back(p);
    } else {
      EXPECT_NEAR(ratio, 2.0, 1e-12);
      ++creeping;
    }
  }
  const std::vector<double> frequencies{6, 18, 50, 150, 450};
  EXPECT_EQ(creeping, 3U);
  ASSERT_EQ(starts.size(), frequencies.size());
  const double zeta = 0.3, root = std::sqrt(1 - zeta * zeta);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const double w = 2 * kPi * frequencies[i];
    const State end =
        swing(*law, starts[i], scales.inertia, {0.01, -zeta * w * 0.01}, 2 * kPi / (w * root), 4000);
    EXPECT_NEAR(end[0], 0.01 * std::exp(-2 * kPi * zeta / root), 1e-9);
  }
}

// Park et al. 2011, Table VIII (mLA left): K_C = 3.5 N m/rad, Kd_C = 0.0889 N m s/rad; the force restores.
TEST(CableStretch, GivesTheTorqueOfTableEight) {
  const auto law = law_named("cable_stretch");
  const Values p = values_of(*law, {{"stiffness", 3.5}, {"damping", 0.0889}});
  EXPECT_NEAR(law->force({0.2, 0.0, 0}, nullptr, p.data()), -0.7, 1e-12);
  EXPECT_NEAR(law->force({0.0, 10.0, 0}, nullptr, p.data()), -0.889, 1e-12);
}

TEST(CableStretch, IsNullOnlyWhenInfinitelyStiff) {
  const auto law = law_named("cable_stretch");
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(law->is_null(values_of(*law, {{"stiffness", infinity}, {"damping", 2.0}}).data()));
  EXPECT_FALSE(law->is_null(values_of(*law, {{"stiffness", 1e12}}).data()));
}

// A mass between two springs with play: crosses the gap in gap/v0, stays half an own period pi/w on each
// side.
TEST(Backlash, BouncesWithItsClosedFormPeriod) {
  const auto law = law_named("backlash");
  const double gap = 0.2, stiffness = 50.0, mass = 0.5, speed = 1.0;
  const Values p = values_of(*law, {{"gap", gap}, {"stiffness", stiffness}, {"damping", 0.0}});
  const double period = 2 * gap / speed + 2 * kPi / std::sqrt(stiffness / mass);
  const State end = swing(*law, p, mass, {0.0, speed}, period, 40000);
  EXPECT_NEAR(end[0], 0.0, 1e-6);
  EXPECT_NEAR(end[1], speed, 1e-6);
}

TEST(Backlash, IsFreeInTheGapAndNeverPulls) {
  const auto law = law_named("backlash");
  const Values p = values_of(*law, {{"gap", 0.2}, {"stiffness", 50.0}, {"damping", 2.0}});
  EXPECT_EQ(law->force({0.099, 5.0, 0}, nullptr, p.data()), 0.0);
  EXPECT_EQ(law->force({-0.099, 5.0, 0}, nullptr, p.data()), 0.0);
  EXPECT_NEAR(law->force({0.11, 0.0, 0}, nullptr, p.data()), -0.5, 1e-12);
  EXPECT_NEAR(law->force({-0.11, 0.0, 0}, nullptr, p.data()), 0.5, 1e-12);
  EXPECT_NEAR(law->force({0.11, 1.0, 0}, nullptr, p.data()), -2.5, 1e-12);
  EXPECT_EQ(law->force({0.11, -1.0, 0}, nullptr, p.data()), 0.0);  // parts faster than it relaxes
}

TEST(Backlash, StartsInStiffContact) {
  const auto law = law_named("backlash");
  const Scales scales = test_scales();
  std::set<long> rates;
  for (const auto& start : law->starts(scales)) {
    const double w = std::sqrt(value(*law, start, "stiffness") / scales.inertia);
    const double rate = w / (2 * kPi);
    EXPECT_NEAR(rate, std::round(rate), 1e-9);
    rates.insert(std::lround(rate));
    EXPECT_NEAR(value(*law, start, "damping") / (2 * scales.inertia * w), 0.3, 1e-12);
    EXPECT_GT(value(*law, start, "gap"), 0.0);
    EXPECT_LT(value(*law, start, "gap"), scales.position);
  }
  EXPECT_EQ(rates, (std::set<long>{60, 420})) << "Hz";
}

TEST(Spring, SwingsWithThePeriodOfItsStiffness) {
  const auto law = law_named("spring");
  const Values p = values_of(*law, {{"stiffness", 8.0}, {"rest", 0.3}});
  const State end = swing(*law, p, 2.0, {0.5, 0.0}, 2 * kPi / std::sqrt(8.0 / 2.0), 4000);
  EXPECT_NEAR(end[0], 0.5, 1e-9);
  EXPECT_NEAR(end[1], 0.0, 1e-9);
}

// Purely cubic oscillator (Kovacic and Brennan 2011): period = Gamma(1/4)^2/sqrt(pi) sqrt(m/k3)/A = 7.41630
// ...
TEST(Hardening, SwingsWithThePeriodOfTheCubicOscillator) {
  const auto law = law_named("hardening");
  const double k3 = 5.0, mass = 2.0, amplitude = 0.4;
  const Values p = values_of(*law, {{"cubic_stiffness", k3}, {"rest", 0.1}});
  const double period = std::pow(std::tgamma(0.25), 2) / std::sqrt(kPi) * std::sqrt(mass / k3) / amplitude;
  const State end = swing(*law, p, mass, {0.1 + amplitude, 0.0}, period, 20000);
  EXPECT_NEAR(end[0], 0.1 + amplitude, 1e-9);
  EXPECT_NEAR(end[1], 0.0, 1e-8);
}

// Constant deceleration: stops after m v^2/(2 F).
TEST(Preload, StopsAMassAfterItsKineticEnergy) {
  const auto law = law_named("preload");
  const Values p = values_of(*law, {{"preload", 3.0}});
  const State end = swing(*law, p, 2.0, {0.0, 1.5}, 2.0 * 1.5 / 3.0, 100);
  EXPECT_NEAR(end[0], 2.0 * 1.5 * 1.5 / (2 * 3.0), 1e-12);
  EXPECT_NEAR(end[1], 0.0, 1e-12);
}

TEST(UnilateralSpring, ActsOnItsSideOnly) {
  const auto law = law_named("unilateral_spring");
  for (const double side : {1.0, -1.0}) {
    const Values p = values_of(
        *law,
        {{"stiffness", 100.0}, {"preload", 3.0}, {"rest", 0.5}, {"side", side}, {"smoothing_length", 1e-4}});
    EXPECT_EQ(law->force({0.5 - side * 0.1, 1.0, 0}, nullptr, p.data()), 0.0);
    EXPECT_NEAR(law->force({0.5 + side * 0.1, 1.0, 0}, nullptr, p.data()), -side * 13.0, 1e-9);
    // Work of compression: k d^2/2 + F0 d, less what the smoothing of the preload leaves out (F0 l ln 2).
    EXPECT_NEAR(law->stored_energy({0.5 + side * 0.1, 0, 0}, nullptr, p.data()),
                0.5 * 100 * 0.01 + 3 * 0.1 - 3 * 1e-4 * 0.6931471805599453, 1e-9);
    EXPECT_NEAR(law->force({0.5 + side * 1e-12, 0, 0}, nullptr, p.data()), 0.0, 1e-6);  // no jump
  }
}

TEST(UnilateralSpring, StartsOnBothSidesAroundTheCentre) {
  const auto law = law_named("unilateral_spring");
  Scales scales = test_scales();
  scales.center = 0.3;
  double above = 0.0, below = 0.0;
  for (const Values& start : law->starts(scales)) {
    const double side = start[3];
    const double share = (start[2] - scales.center) / scales.position;
    EXPECT_LE(std::abs(share), 0.9);  // inside the motion
    (side > 0.0 ? above : below) += 1.0 + share;
  }
  EXPECT_GE(above, 3.0);
  EXPECT_DOUBLE_EQ(above, below);
}

// Half a swing on either spring (Shaw and Holmes 1983): period = pi (sqrt(m/k1) + sqrt(m/k2)).
TEST(AsymmetricSpring, SwingsHalfAPeriodOfEitherStiffness) {
  const auto law = law_named("asymmetric_spring");
  const double above = 18.0, below = 9.0, mass = 2.0;
  const Values p = values_of(*law, {{"stiffness_above", above}, {"stiffness_below", below}, {"rest", 0.3}});
  const double period = kPi * (std::sqrt(mass / above) + std::sqrt(mass / below));
  const State end = swing(*law, p, mass, {0.3, 1.0}, period, 40000);
  EXPECT_NEAR(end[0], 0.3, 1e-6);
  EXPECT_NEAR(end[1], 1.0, 1e-6);
}

/// Link's position and velocity, the resonator's stretch and speed, after some time.
State rattle(const ForceLaw& law, const Values& p, double inertia, const State& x, double duration) {
  return rk4(
      [&](const State& y) {
        const Motion m{y[0], y[1], 0};
        State rate{y[1], law.force(m, &y[2], p.data()) / inertia, 0.0, 0.0};
        law.state_rate(m, &y[2], p.data(), &rate[2]);
        return rate;
      },
      x, duration, 40000);
}

// Two free bodies on a spring swing against each other with w sqrt(1 + m/M) about their common centre, which
// stays (Den Hartog, section 2.3).
TEST(Resonator, SwingsAgainstAFreeLinkWithTheReducedMass) {
  const auto law = law_named("resonator");
  const double inertia = 0.3, link = 1.2, frequency = 4.0;
  const Values p = values_of(*law, {{"inertia", inertia}, {"frequency", frequency}, {"damping_ratio", 0.0}});
  const double half = 0.5 / (frequency * std::sqrt(1.0 + inertia / link));
  const State turned = rattle(*law, p, link, {0.0, 0.0, 0.01, 0.0}, half);
  EXPECT_NEAR(turned[2], -0.01, 1e-9);
  EXPECT_NEAR(turned[0], 0.02 * inertia / (inertia + link), 1e-9);
}

// On a link that is moved as X sin(W t) the force's amplitude is m W^2 X times the transmissibility (Den
// Hartog, equation 2.35).
TEST(Resonator, TransmitsWhatTheTextbookSays) {
  const auto law = law_named("resonator");
  const double inertia = 0.3, frequency = 4.0, ratio = 0.1, X = 0.05;
  const Values p =
      values_of(*law, {{"inertia", inertia}, {"frequency", frequency}, {"damping_ratio", ratio}});
  const double w = 2 * kPi * frequency;
  for (const double share : {0.3, 1.0, 2.5}) {
    const double W = share * w;
    double largest = 0.0;
    State x{0.0, 0.0, 0.0};  // stretch, speed, time
    const Rate rate = [&](const State& y) {
      State r(3, 1.0);
      law->state_rate({X * std::sin(W * y[2]), X * W * std::cos(W * y[2]), 0}, y.data(), p.data(), r.data());
      return r;
    };
    constexpr double kSettled = 4.0;  // s: exp(-10) is left of how it began
    x = rk4(rate, x, kSettled, 20000);
    for (int i = 0; i < 400; ++i) {
      x = rk4(rate, x, 2 * kPi / W / 400, 4);
      const Motion m{X * std::sin(W * x[2]), X * W * std::cos(W * x[2]), 0};
      largest = std::max(largest, std::abs(law->force(m, x.data(), p.data())));
    }
    const double damped = 4 * ratio * ratio * share * share;
    const double expected =
        inertia * W * W * X * std::sqrt((1 + damped) / (std::pow(1 - share * share, 2) + damped));
    EXPECT_NEAR(largest, expected, 1e-3 * expected);
  }
}

// Holtz and Springob 1996: repeats every 2 pi/N, no mean, amplitude sqrt(A_s^2 + A_c^2).
TEST(Cogging, RepeatsWithEveryCycleAndHasNoMean) {
  const auto law = law_named("cogging");
  const Values p = values_of(*law, {{"sine", 0.3}, {"cosine", -0.4}, {"cycles", 14.0}});
  double largest = 0.0, mean = 0.0;
  constexpr int kSteps = 14000;
  for (int i = 0; i < kSteps; ++i) {
    const double x = 2 * kPi * i / kSteps;
    const double force = law->force({x, 1.0, 0}, nullptr, p.data());
    EXPECT_NEAR(force, law->force({x + 2 * kPi / 14, 1.0, 0}, nullptr, p.data()), 1e-12);
    largest = std::max(largest, std::abs(force));
    mean += force / kSteps;
  }
  EXPECT_NEAR(largest, 0.5, 1e-5);
  EXPECT_NEAR(mean, 0.0, 1e-12);
}

// A neighbouring count is another torque: what is not looked for is not found.
TEST(Cogging, IsLookedForAtEveryCountOfSmallMotors) {
  const auto law = law_named("cogging");
  const auto cycles = static_cast<std::size_t>(law->parameter_index("cycles"));
  std::set<double> counts;
  for (const Values& start : law->starts({})) {
    counts.insert(start[cycles]);
  }
  for (int count = 2; count <= 48; ++count) {
    EXPECT_EQ(counts.count(count), 1U) << count;
  }
}

}  // namespace
}  // namespace plumbline::effects
