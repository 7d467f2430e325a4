// `plumbline simulate` of a scenario, and where the integrator gives up.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "simulator/trace/table.h"
#include "tests/cli/program.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::test {
namespace {

nlohmann::json read_json(const std::string& file) {
  std::ifstream in(file);
  return nlohmann::json::parse(in);
}

// No step meets 1e-13 where a pulley falls into its stop: the run ends there, says why, and what was
// simulated until then is on the disk.
TEST(SimulateScenario, TheTraceIsKeptWhereTheIntegratorGivesUp) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run({"simulate", "--scenario", PLUMBLINE_ROOT "/robots/mabel/scenarios/hopping.yaml", "--seconds", "3",
           "--tolerance", "1e-13", "--out", folder.path("trace.csv")},
          folder.path("."));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::HasSubstr("rosenbrock failed after t = "));
  EXPECT_THAT(outcome.out, testing::HasSubstr("Largest local error: "));
  EXPECT_THAT(outcome.out, testing::HasSubstr("Stiffest: "));
  EXPECT_GT(read_table(folder.path("trace.csv")).rows(), 10);
}

// A robot under its controller: trace, record and summary, with the controller's identity.
TEST(SimulateScenario, RunsAControllerAndAccountsForTheEnergy) {
  const std::string scenario = PLUMBLINE_ROOT "/robots/mabel/scenarios/hopping_boom.yaml";
  const TemporaryFolder folder;
  const Outcome simulated = run({"simulate", "--scenario", scenario, "--seconds", "0.8", "--energy",
                                 "--start", "clearance=0.06", "--out", folder.path("trace.csv"), "--record",
                                 folder.path("trial"), "--json", folder.path("simulate.json")},
                                folder.path("."));
  ASSERT_EQ(simulated.status, 0) << simulated.err;
  const nlohmann::json json = read_json(folder.path("simulate.json"));
  EXPECT_FALSE(json["fell"]);
  EXPECT_EQ(json["controller"]["name"], "mabel_hopping");
  EXPECT_EQ(json["controller"]["sha256"].get<std::string>().size(), 64U);
  EXPECT_GT(json["energy"]["exchanged"], 50.0);
  EXPECT_LT(std::abs(json["energy"]["error"].get<double>()),
            1e-3 * json["energy"]["exchanged"].get<double>());
  EXPECT_NEAR(json["duration"], 0.8, 1e-9);
  EXPECT_THAT(simulated.out, testing::HasSubstr("energy balance"));
  EXPECT_NE(read_table(folder.path("trace.csv")).find("u_mLA_left"), nullptr);
  EXPECT_NE(read_table(folder.path("trial/data.csv")).find("contact_left_switch"), nullptr);
}

}  // namespace
}  // namespace plumbline::test
