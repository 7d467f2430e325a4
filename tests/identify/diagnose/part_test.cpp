// Which windows stand for all where a candidate is costly to try.
#include "validation/identify/diagnose/part.h"

#include <gmock/gmock.h>

#include "tests/identify/diagnose/bench.h"

namespace plumbline::validation {
namespace {

using testing::ElementsAre;

struct WindowsOfErrors : testing::Test {
  /// As many windows of the bench's first trial, to train on, and of its last, held out; the windows' squared
  /// errors in a reading of each channel.
  void SetUp() override {
    const Data all = bench_twins({});
    const std::vector<int> train = all.windows_of(Role::train);
    const std::vector<int> held_out = all.windows_of(Role::held_out);
    data.windows.clear();
    for (const int w : {train[0], train[1], train[2], train[3], train[4], held_out[0], held_out[1]}) {
      data.windows.push_back(all.windows[static_cast<std::size_t>(w)]);
    }
  }
  void have_errors(const std::vector<double>& squares) {
    stage.estimate.predicted.square.clear();
    for (std::size_t w = 0; w < squares.size(); ++w) {
      const auto channels = static_cast<Eigen::Index>(
          data.trials[static_cast<std::size_t>(data.windows[w].trial)].measured.size());
      stage.estimate.predicted.square.push_back(
          Eigen::VectorXd::Constant(channels, squares[w] * static_cast<double>(data.windows[w].count)));
    }
  }
  Data data = bench_twins({});
  Stage stage;
};

TEST_F(WindowsOfErrors, OneOfFourShowsWhatIsMissingAndIsNotTheWorst) {
  have_errors({1.0, 900.0, 40.0, 1.0, 30.0, 1.0, 20.0});
  // Of 0 to 3 the second; 4 is left over; 5 and 6 are held out, of two the worse counts.
  EXPECT_THAT(telling(stage, 4, data.all_windows(), data), ElementsAre(2, 4, 6));
}

TEST_F(WindowsOfErrors, OfSomeOnlyThese) {
  have_errors({1.0, 900.0, 40.0, 1.0, 30.0, 1.0, 20.0});
  EXPECT_THAT(telling(stage, 2, {0, 2, 3, 4, 5}, data), ElementsAre(2, 4, 5));
}

TEST_F(WindowsOfErrors, FewWindowsAreAllTried) {
  have_errors({2.0, 4.0, 6.0, 8.0, 10.0, 1.0, 3.0});
  EXPECT_EQ(enough_to_tell(stage, data), data.all_windows());
}

}  // namespace
}  // namespace plumbline::validation
