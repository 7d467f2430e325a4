#include "simulator/trace/units.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "simulator/trace/error.h"
#include "tests/trace/refusal.h"

namespace plumbline {
namespace {

// Factors from the definitions of the SI brochure (9th edition, 2019), not from the library.
TEST(UnitsTest, FactorsToSi) {
  const double pi = std::acos(-1.0);
  const std::vector<std::pair<std::string, double>> table{{"rad", 1.0},        {"deg", pi / 180.0},
                                                          {"count", 1.0},      {"1", 1.0},
                                                          {"%", 0.01},         {"N m s/rad", 1.0},
                                                          {"kg m^2", 1.0},     {"g cm^2", 1e-7},
                                                          {"V s/m", 1.0},      {"N m/A", 1.0},
                                                          {"mm", 1e-3},        {"ms", 1e-3},
                                                          {"kN/m", 1e3},       {"rpm", 2.0 * pi / 60.0},
                                                          {"deg/s", pi / 180}, {"N m s^2/rad^2", 1.0},
                                                          {"N m/rad^3", 1.0},  {"1/s", 1.0},
                                                          {"N.m", 1.0},        {"N*m", 1.0},
                                                          {"mN m/A", 1e-3},    {"m s^-2", 1.0},
                                                          {"0.5 m", 0.5},      {"um", 1e-6}};
  for (const auto& [unit, factor] : table) {
    EXPECT_NEAR(to_si_factor(unit), factor, 1e-12 * factor) << unit;
    EXPECT_TRUE(unit_is_known(unit)) << unit;
  }
}

TEST(UnitsTest, RefusesWhatIsNoUnitOrNotProportional) {
  for (const std::string unit :
       {"", " ", "\t", "Nm", "banana", "degC", "degF", "seconds since 1970-01-01", "lg(re 1 mW)", "N/m^1.5",
        "m1.5", "N m s^0.5", "1e400 m", "0 m", "m^300", "m\n", "(((((((((", "m\"", "-1 m"}) {
    EXPECT_FALSE(unit_is_known(unit)) << unit;
    EXPECT_FALSE(units_agree(unit, unit)) << unit;
    EXPECT_NE(test::refusal([&] { to_si_factor(unit); }).find("expected a unit"), std::string::npos) << unit;
  }
  EXPECT_FALSE(unit_is_known(std::string("m\0rad", 5)));
  EXPECT_FALSE(unit_is_known(std::string(100000, 'm')));
}

TEST(UnitsTest, AgreementIsOneDimensionWithAnglesAsNumbers) {
  for (const auto& [a, b] : std::vector<std::pair<std::string, std::string>>{
           {"deg", "rad"}, {"rad", "1"}, {"N m s/rad", "kg m^2/s"}, {"N m", "J"}, {"mm", "m"}, {"%", "1"}}) {
    EXPECT_TRUE(units_agree(a, b)) << a << " " << b;
  }
  for (const auto& [a, b] : std::vector<std::pair<std::string, std::string>>{
           {"rad", "m"}, {"N m", "N"}, {"kg", "kg m^2"}, {"s", "Hz"}, {"N s/m", "N m s/rad"}, {"A", "V"}}) {
    EXPECT_FALSE(units_agree(a, b)) << a << " " << b;
  }
}

TEST(UnitsTest, MayBeAskedFromSeveralThreads) {
  std::array<std::thread, 4> threads;
  for (std::thread& thread : threads) {
    thread = std::thread([] {
      for (int i = 0; i < 200; ++i) {
        ASSERT_DOUBLE_EQ(to_si_factor("kN m/A"), 1000.0);
        ASSERT_FALSE(unit_is_known("not a unit"));
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
}

TEST(UnitsTest, WritesNothingToStandardError) {
  testing::internal::CaptureStderr();
  unit_is_known("((");
  units_agree("furlongs per", "m");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace plumbline
