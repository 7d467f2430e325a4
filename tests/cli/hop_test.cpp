// `plumbline hop` where the integrator gives up, and `plumbline simulate` with a controller.
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
TEST(Hop, TheTraceIsKeptWhereTheIntegratorGivesUp) {
  const std::string robot = PLUMBLINE_ROOT "/robots/mabel/";
  const TemporaryFolder folder;
  const Outcome outcome = run({"hop", robot + "mabel_planar.yaml", robot + "hopping.yaml", "--hops", "5",
                               "--tolerance", "1e-13", "--out", folder.path("trace.csv")},
                              folder.path("."));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::HasSubstr("rosenbrock failed after t = "));
  EXPECT_THAT(outcome.out, testing::HasSubstr("Largest local error: "));
  EXPECT_THAT(outcome.out, testing::HasSubstr("Stiffest: "));
  EXPECT_GT(read_table(folder.path("trace.csv")).rows(), 10);
}

// The same robot from the same start; that the energy is accounted for, too, changes the steps a little.
TEST(SimulateHopping, HopsUnderAControllerAndAccountsForTheEnergy) {
  const std::string robot = PLUMBLINE_ROOT "/robots/mabel/";
  const TemporaryFolder folder;
  const Outcome simulated =
      run({"simulate", "--model", robot + "mabel.yaml", "--controller", robot + "hopping_boom.yaml", "--hops",
           "3", "--out", folder.path("trace.csv"), "--json", folder.path("simulate.json")},
          folder.path("."));
  ASSERT_EQ(simulated.status, 0) << simulated.err;
  const Outcome hopped = run({"hop", robot + "mabel.yaml", robot + "hopping_boom.yaml", "--hops", "3",
                              "--json", folder.path("hop.json")},
                             folder.path("."));
  ASSERT_EQ(hopped.status, 0) << hopped.err;
  const nlohmann::json one = read_json(folder.path("simulate.json"));
  const nlohmann::json other = read_json(folder.path("hop.json"));
  ASSERT_EQ(one["hops"].size(), 3U);
  EXPECT_NEAR(one["hops"][0]["travel"], other["hops"][0]["travel"], 5e-3);
  EXPECT_NEAR(one["hops"][0]["period"], other["hops"][0]["period"], 5e-3);
  EXPECT_FALSE(one["fell"]);
  EXPECT_GT(one["energy"]["exchanged"], 100.0);
  EXPECT_LT(std::abs(one["energy"]["relative_error"].get<double>()), 1e-3);
  EXPECT_GT(one["duration"], 1.0);
  EXPECT_THAT(simulated.out, testing::HasSubstr("energy balance"));
  EXPECT_NE(read_table(folder.path("trace.csv")).find("u_mLA_left"), nullptr);
}

}  // namespace
}  // namespace plumbline::test
