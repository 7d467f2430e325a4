#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "simulator/trace/error.h"
#include "simulator/trace/table.h"
#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline {
namespace {

using test::refusal;
using test::TemporaryFolder;

TEST(CsvTest, ReadsNamesUnitsAndNumbers) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.csv", "t [s],q mLA [rad] , u [N m]\n0,1e-3,-2\n0.5, +4.25 ,.5\n");
  const Table table = read_csv(path);
  ASSERT_EQ(table.columns.size(), 3U);
  EXPECT_EQ(table.rows(), 2);
  EXPECT_EQ(table.file, path);
  EXPECT_EQ(table.columns[1].name, "q mLA");
  EXPECT_EQ(table.columns[1].unit, "rad");
  EXPECT_EQ(table.columns[2].unit, "N m");
  EXPECT_EQ(table.find("u")->values, Eigen::Vector2d(-2, 0.5));
  EXPECT_EQ(table.find("q mLA")->values, Eigen::Vector2d(1e-3, 4.25));
  EXPECT_EQ(table.find("nope"), nullptr);
}

TEST(CsvTest, TakesOtherLineEndsQuotesAByteOrderMarkAndNoLastLineFeed) {
  const TemporaryFolder folder;
  for (const std::string text :
       {"t [s],x [m]\r\n1,2\r\n3,4\r\n", "t [s],x [m]\r1,2\r3,4", "\xEF\xBB\xBFt [s],x [m]\n1,2\n3,4",
        "\"t [s]\",\"x [m]\"\n\"1\",2\n3,4\n\n\n"}) {
    const Table table = read_csv(folder.write("a.csv", text));
    ASSERT_EQ(table.rows(), 2) << text;
    EXPECT_EQ(table.find("t")->values, Eigen::Vector2d(1, 3)) << text;
    EXPECT_EQ(table.find("x")->values, Eigen::Vector2d(2, 4)) << text;
  }
}

struct Bad {
  std::string text, where, found, expected;
};

TEST(CsvTest, RefusesBadFilesWithLineColumnFoundAndExpected) {
  const std::vector<Bad> table{
      {"", ":1: ", "found an empty file", "expected a header"},
      {"t [s],x [m]\n", ":2: ", "found no rows", "at least one row"},
      {"t [s],x [m]", ":2: ", "found no rows", "at least one row"},
      {"t [s],x\n1,2\n", ":1: x: ", "found \"x\"", "`name [unit]`"},
      {"t [s],[m]\n1,2\n", ":1: column 2: ", "found \"[m]\"", "`name [unit]`"},
      {"t [s],\n1,2\n", ":1: column 2: ", "found \"\"", "`name [unit]`"},
      {"t [s],x []\n1,2\n", ":1: x: ", "found unit \"\"", "a unit such as"},
      {"t [s],x [banana]\n1,2\n", ":1: x: ", "found unit \"banana\"", "a unit such as"},
      {"t [s],x [m] y\n1,2\n", ":1: x: ", "found \"x [m] y\"", "`name [unit]`"},
      {"t [s],x [m],t [s]\n1,2,3\n", ":1: t: ", "found this column name twice", "once"},
      {"t [s],x [m]\n1,2\n3\n", ":3: ", "found 1 fields", "expected 2"},
      {"t [s],x [m]\n1,2\n3,4,5\n", ":3: ", "found 3 fields", "expected 2"},
      {"t [s],x [m]\n1,2\n3,four\n", ":3: x: ", "found \"four\"", "a finite number"},
      {"t [s],x [m]\r\n1,2\r\n3,four\r\n", ":3: x: ", "found \"four\"", "a finite number"},
      {"t [s],x [m]\n1,2\n3,nan\n", ":3: x: ", "found \"nan\"", "a finite number"},
      {"t [s],x [m]\n1,2\n-inf,3\n", ":3: t: ", "found \"-inf\"", "a finite number"},
      {"t [s],x [m]\n1,1e999\n", ":2: x: ", "found \"1e999\"", "a finite number"},
      {"t [s],x [m]\n1,\n", ":2: x: ", "found an empty field", "a finite number"},
      {"t [s],x [m]\n1,2 3\n", ":2: x: ", "found \"2 3\"", "a finite number"},
      {"t [s],x [m]\n1,0x10\n", ":2: x: ", "found \"0x10\"", "a finite number"},
      {"t [s],x [m]\n1,2\n\n3,4\n", ":3: ", "found an empty line", "numbers"},
      {"\nt [s],x [m]\n1,2\n", ":1: ", "found an empty line", "a header"},
      {"t [s],x [m]\n1,\"2\n", ":2: ", "found an open quotation mark", "numbers"},
      {"t [s],x [m]\n1,2\n3,4\"5\n", ":3: ", "found a quotation mark", "numbers"},
      {"t;x\n1;2\n", ":1: t;x: ", "found \"t;x\"", "`name [unit]`"},
  };
  const TemporaryFolder folder;
  for (const Bad& bad : table) {
    const std::string path = folder.write("bad.csv", bad.text);
    const std::string message = refusal([&] { read_csv(path); });
    EXPECT_EQ(message.rfind(path + bad.where + bad.found, 0), 0U) << bad.text << "\n" << message;
    EXPECT_NE(message.find(", expected "), std::string::npos) << message;
    EXPECT_NE(message.find(bad.expected), std::string::npos) << message;
  }
}

TEST(CsvTest, RefusesWhatIsNoFile) {
  const TemporaryFolder folder;
  EXPECT_NE(refusal([&] { read_csv(folder.path("none.csv")); }).find("none.csv: found nothing"),
            std::string::npos);
  EXPECT_NE(refusal([&] { read_csv(folder.path(".")); }).find("no regular file"), std::string::npos);
  EXPECT_NE(refusal([] { read_csv("/dev/zero"); }).find("no regular file"), std::string::npos);
}

TEST(CsvTest, SeventeenDigitsReadBackTheSameDoubles) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> mantissa(-1.0, 1.0);
  std::uniform_int_distribution<int> exponent(-300, 300);
  Table table;
  Eigen::VectorXd values(1000);
  for (double& value : values) {
    value = std::ldexp(mantissa(random), exponent(random));
  }
  values[0] = std::numeric_limits<double>::max();
  values[1] = std::numeric_limits<double>::denorm_min();
  values[2] = -0.0;
  table.columns = {{"a", "N m", values}, {"b", "1", -values}};
  const TemporaryFolder folder;
  write_csv(table, folder.path("a.csv"), 17);
  const Table back = read_csv(folder.path("a.csv"));
  ASSERT_EQ(back.columns.size(), 2U);
  EXPECT_EQ(back.columns[0].unit, "N m");
  EXPECT_EQ(back.columns[0].values, values);
  EXPECT_EQ(back.columns[1].values, -values);
  table.columns = {{"a", "N m", values.tail(900)}};
  write_csv(table, folder.path("a.csv"));  // 10 digits
  EXPECT_TRUE(read_csv(folder.path("a.csv")).columns[0].values.isApprox(values.tail(900), 1e-9));
}

TEST(CsvTest, RefusesTablesThatCouldNotBeReadBack) {
  const TemporaryFolder folder;
  Table table;
  table.columns = {{"a", "", Eigen::VectorXd::Zero(2)}};
  EXPECT_THROW(write_csv(table, folder.path("a.csv")), std::invalid_argument);
  table.columns = {{"a", "m", Eigen::VectorXd::Zero(2)}, {"b", "m", Eigen::VectorXd::Zero(3)}};
  EXPECT_THROW(write_csv(table, folder.path("a.csv")), std::invalid_argument);
  table.columns = {{"a,b", "m", Eigen::VectorXd::Zero(2)}};
  EXPECT_THROW(write_csv(table, folder.path("a.csv")), std::invalid_argument);
  EXPECT_EQ(folder.file_count(), 0U);
}

TEST(WriteTextTest, ReplacesTheWholeFileOrNothing) {
  const TemporaryFolder folder;
  folder.write("a.txt", "old");
  write_text_atomically(folder.path("a.txt"), "new");
  EXPECT_EQ(folder.read("a.txt"), "new");
  EXPECT_EQ(folder.file_count(), 1U);
  EXPECT_NE(refusal([&] { write_text_atomically(folder.path("none/a.txt"), "x"); }).find("no folder"),
            std::string::npos);
  EXPECT_NE(refusal([&] { write_text_atomically(folder.path("."), "x"); }).find("a folder"),
            std::string::npos);
}

TEST(WriteTextTest, FollowsASymbolicLinkAndWritesToPipes) {
  const TemporaryFolder folder;
  folder.write("real.txt", "old");
  std::filesystem::create_symlink("real.txt", folder.path("link.txt"));
  write_text_atomically(folder.path("link.txt"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path("link.txt")));
  EXPECT_EQ(folder.read("real.txt"), "new");
  write_text_atomically("/dev/null", "gone");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(WriteTextTest, KeepsTheOldFileWhenTheDiskIsFull) {
  EXPECT_NE(refusal([] { write_text_atomically("/dev/full", "text"); }).find("/dev/full: found"),
            std::string::npos);
}

}  // namespace
}  // namespace plumbline
