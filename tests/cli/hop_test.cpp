// `plumbline hop` where the integrator gives up.
#include <gmock/gmock.h>

#include "simulator/trace/table.h"
#include "tests/cli/program.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::test {
namespace {

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

}  // namespace
}  // namespace plumbline::test
