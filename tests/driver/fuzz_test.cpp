// A bounded number of random inputs; fuzz_driver reads as many as it is told.
#include <gtest/gtest.h>

#include "tests/driver/fuzz_targets.h"

namespace plumbline::driver {
namespace {

TEST(DriverFuzz, ReadsAnything) { EXPECT_NO_THROW(FuzzTargets(43, FUZZED_CONTROLLER).run(20000)); }

}  // namespace
}  // namespace plumbline::driver
