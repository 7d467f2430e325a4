// The windows of a trial with contact as the page draws them.
#include "validation/report/traces.h"

#include <gtest/gtest.h>

#include "tests/identify/predict/hopper.h"

namespace plumbline::validation {
namespace {

// The data have windows in stance first; a page that took the first for the trial's beginning would lose the
// rest, and a heat map would lead to the wrong window.
TEST(WindowsInTime, ComeOneAfterTheOther) {
  const model::Model model = test::hopper();
  const Data data({test::hopper_trial(model, "bounce"), test::hopper_trial(model, "drop")}, {});
  for (std::size_t trial = 0; trial < 2; ++trial) {
    const std::vector<Span> spans = spans_of(data, trial);
    const std::vector<std::size_t> order = windows_in_time(data, trial);
    ASSERT_GT(spans.size(), 4U);
    ASSERT_EQ(order.size(), spans.size());
    EXPECT_LT(spans.front().first, 100);
    for (std::size_t w = 0; w < spans.size(); ++w) {
      EXPECT_EQ(data.windows[order[w]].trial, static_cast<int>(trial));
      EXPECT_EQ(data.windows[order[w]].first, spans[w].first);
      if (w > 0) {
        EXPECT_GE(spans[w].first, spans[w - 1].first + spans[w - 1].count);
      }
    }
  }
}

}  // namespace
}  // namespace plumbline::validation
