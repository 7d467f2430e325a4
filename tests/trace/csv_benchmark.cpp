// Reading a recording beside converting its numbers and nothing else.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

#include "simulator/trace/file_text.h"
#include "simulator/trace/table.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline {
namespace {

constexpr Eigen::Index kRows = 24841;  // as many as the public EMPS recording has
constexpr int kColumns = 8;

double least_of_five(const std::function<void()>& work) {
  double best = 1e9;
  for (int i = 0; i < 5; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return best;
}

/// All numbers of the text by the C library; how many there were.
int convert(const std::string& text) {
  int count = 0;
  const char* at = text.c_str() + text.find('\n') + 1;
  for (char* end = nullptr; *at != '\0'; at = *end == '\0' ? end : end + 1, ++count) {
    EXPECT_LE(std::strtod(at, &end), 1.0);
  }
  return count;
}

TEST(CsvBenchmark, AFileIsReadInTheTimeThatItsNumbersTake) {
  Table table;
  for (int i = 0; i < kColumns; ++i) {
    table.columns.push_back({"c" + std::to_string(i), "rad", Eigen::VectorXd::Random(kRows)});
  }
  const test::TemporaryFolder folder;
  const std::string file = folder.path("long.csv");
  write_csv(table, file);
  const double ours = least_of_five([&] { ASSERT_EQ(read_csv(file).rows(), kRows); });
  const double bare = least_of_five([&] { ASSERT_EQ(convert(read_text(file)), kRows * kColumns); });
  std::printf("read_csv: %.1f ms, the numbers alone by strtod: %.1f ms, ratio %.2f\n", 1e3 * ours, 1e3 * bare,
              ours / bare);
  EXPECT_LT(ours / bare, 3.0);
}

}  // namespace
}  // namespace plumbline
