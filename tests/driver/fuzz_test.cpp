// A bounded number of random inputs; fuzz_driver reads as many as it is told.
#include <gtest/gtest.h>

#include "tests/driver/fuzz_targets.h"

namespace plumbline::driver {
namespace {

TEST(DriverFuzz, ReadsAnything) {
  FuzzTargets targets(43, FUZZED_CONTROLLER, PLUMBLINE_ROOT "/robots/mabel/certify/hopping.cert");
  EXPECT_NO_THROW(targets.run(20000));
  EXPECT_GT(targets.created(), 200U);
}

}  // namespace
}  // namespace plumbline::driver
