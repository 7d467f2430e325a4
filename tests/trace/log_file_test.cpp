// Logs in every dialect that laboratories write, and how each is refused.
#include "simulator/trace/log_file.h"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "simulator/trace/error.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

class Log : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder = fs::path(testing::TempDir()) / (std::string("plumbline_log_") + test->name());
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name, std::ios::binary) << text;
    return (folder / name).string();
  }
  LogFile read(const std::string& text, const std::string& name = "log.csv") const {
    return read_log(write(name, text));
  }
  std::string refusal(const std::string& text, const std::string& name = "log.csv") const {
    try {
      read(text, name);
    } catch (const InputError& error) {
      return error.what();
    }
    ADD_FAILURE() << "not refused: " << text;
    return "";
  }

  fs::path folder;
};

void expect_column(const LogFile& log, const std::string& name, const std::string& unit,
                   const std::vector<double>& values) {
  const Column* column = log.table.find(name);
  ASSERT_NE(column, nullptr) << name;
  EXPECT_EQ(column->unit, unit) << name;
  ASSERT_EQ(column->values.size(), static_cast<Eigen::Index>(values.size())) << name;
  for (std::size_t k = 0; k < values.size(); ++k) {
    EXPECT_DOUBLE_EQ(column->values[static_cast<Eigen::Index>(k)], values[k]) << name << ' ' << k;
  }
}

void expect_t_and_q(const LogFile& log, const std::string& t = "", const std::string& q = "") {
  expect_column(log, "t", t, {0.0, 0.5, 1.0});
  expect_column(log, "q", q, {1.5, -2.0, 3e-3});
  EXPECT_TRUE(log.bad.empty());
}

TEST_F(Log, Separators) {
  expect_t_and_q(read("t,q\n0,1.5\n0.5,-2\n1,3e-3\n"));
  expect_t_and_q(read("t;q\n0;1.5\n0.5;-2\n1;3e-3\n"));
  expect_t_and_q(read("t\tq\n0\t1.5\n0.5\t-2\n1\t3e-3\n"));
  expect_t_and_q(read("t q\n0 1.5\n0.5  -2\n 1   3e-3\n", "log.txt"));
  expect_t_and_q(read("t, q\r\n0, 1.5\r\n0.5, -2\r\n1, 3e-3\r\n"));
  expect_t_and_q(read("\xEF\xBB\xBF\"t\",\"q\"\n0,1.5\n0.5,-2\n1,3e-3"));
}

TEST_F(Log, DecimalCommas) {
  expect_t_and_q(read("t;q\n0;1,5\n0,5;-2\n1;3e-3\n"));
  expect_t_and_q(read("t\tq\n0,0\t1,5\n0,5\t-2,0\n1,0\t3,0e-3\n"));
  expect_t_and_q(read("t q\n0,0 1,5\n0,5 -2,0\n1,0 3,0e-3\n", "log.dat"));
}

TEST_F(Log, UnitsInTheHeaderOrBelowIt) {
  expect_t_and_q(read("t [s],q [rad]\n0,1.5\n0.5,-2\n1,3e-3\n"), "s", "rad");
  expect_t_and_q(read("t (s);q (deg)\n0;1.5\n0.5;-2\n1;3e-3\n"), "s", "deg");
  expect_t_and_q(read("t,q\ns,rad\n0,1.5\n0.5,-2\n1,3e-3\n"), "s", "rad");
  expect_t_and_q(read("t,q\n[s],[-]\n0,1.5\n0.5,-2\n1,3e-3\n"), "s", "1");
}

TEST_F(Log, BracketsThatAreNoUnit) {
  const LogFile log = read("q[0],tau(1)\n1,2\n3,4\n");
  expect_column(log, "q[0]", "", {1, 3});
  expect_column(log, "tau(1)", "", {2, 4});
}

TEST_F(Log, CommentsAndEmptyLines) {
  expect_t_and_q(read("# made by a logger\n\n% at night\nt,q\n0,1.5\n\n0.5,-2\n# paused\n1,3e-3\n\n"));
  expect_t_and_q(read("# t q\n0 1.5\n0.5 -2\n1 3e-3\n", "log.txt"));
  expect_t_and_q(read("// t [s], q [rad]\n0,1.5\n0.5,-2\n1,3e-3\n"), "s", "rad");
}

TEST_F(Log, WithoutAHeader) {
  const LogFile log = read("0,1.5\n0.5,-2\n1,3e-3\n");
  expect_column(log, "column_1", "", {0, 0.5, 1});
  ASSERT_EQ(log.remarks.size(), 1U);
  expect_t_and_q(read_log(write("log.weird", "0,1.5\n0.5,-2\n1,3e-3\n"), {{"t", "q"}, {}}));
  expect_column(read("1.5\n2\n3\n"), "column_1", "", {1.5, 2, 3});
}

TEST_F(Log, RowsThatEndWithASeparator) { expect_t_and_q(read("t,q,\n0,1.5,\n0.5,-2,\n1,3e-3,\n")); }

TEST_F(Log, ALastLineThatWasCutOff) {
  const LogFile log = read("t,q\n0,1.5\n0.5,-2\n1,3e-3\n1.");
  expect_t_and_q(log);
  ASSERT_EQ(log.remarks.size(), 1U);
  EXPECT_NE(log.remarks[0].find("(5) was cut off"), std::string::npos) << log.remarks[0];
}

TEST_F(Log, CellsWithoutANumber) {
  const LogFile log = read("t,q,mode\n0,1.5,idle\n0.5,,run\n1,NaN,run\n");
  EXPECT_TRUE(std::isnan(log.table.find("q")->values[1]));
  EXPECT_EQ(log.bad.at("q").line, 3);
  EXPECT_EQ(log.bad.at("q").row, 2);
  EXPECT_TRUE(log.bad.at("q").missing);
  EXPECT_EQ(log.bad.at("mode").text, "idle");
  EXPECT_FALSE(log.bad.at("mode").missing);
  const LogFile both = read("t,q\n0,nan\n1,inf\n");
  EXPECT_EQ(both.bad.at("q").text, "inf") << "what is more than missing comes first";
}

// date -u -d '2024-02-29 12:34:56' +%s
TEST_F(Log, InstantsBecomeSeconds) {
  EXPECT_DOUBLE_EQ(timestamp_seconds("2024-02-29T12:34:56Z"), 1709210096.0);
  EXPECT_DOUBLE_EQ(timestamp_seconds("2024-02-29 14:34:56.25+02:00"), 1709210096.25);
  EXPECT_DOUBLE_EQ(timestamp_seconds("1970-01-01T00:00:00"), 0.0);
  EXPECT_DOUBLE_EQ(timestamp_seconds("2000-03-01T00:00:00"), 951868800.0);
  for (const char* none :
       {"", "12:34:56", "2024-13-01T00:00:00", "2024-02-29", "2024-02-29T12:34:56 Z", "1.5"}) {
    EXPECT_TRUE(std::isnan(timestamp_seconds(none))) << none;
  }
  expect_column(read("when,q\n2024-02-29 12:34:56.5,1\n2024-02-29 12:34:57.0,2\n"), "when", "",
                {1709210096.5, 1709210097.0});
}

TEST_F(Log, TextThatIsRefused) {
  EXPECT_NE(refusal("").find("log.csv:1: found an empty file"), std::string::npos);
  EXPECT_NE(refusal("# only a comment\n").find("an empty file"), std::string::npos);
  EXPECT_NE(refusal("t,q\n").find("no rows"), std::string::npos);
  EXPECT_NE(refusal("t,q,t\n1,2,3\n2,3,4\n").find("log.csv:1: t: found this column name twice"),
            std::string::npos);
  EXPECT_NE(refusal("t,q\n1,2\n1,2,3\n4,5\n").find("log.csv:3: found 3 fields, expected 2 as in the header"),
            std::string::npos);
  EXPECT_NE(refusal("t,q\n1,2\n", "log.xlsx").find("found extension .xlsx, expected .csv"),
            std::string::npos);
  EXPECT_NE(refusal(std::string("t,q\n1,\0\n", 8)).find("bytes that are no text"), std::string::npos);
}

TEST_F(Log, JsonLines) {
  const LogFile log = read(R"({"t": 0, "q": [1, 2], "imu": {"gyro": 0.5}, "on": true, "mode": "idle"}

{"t": 0.5, "q": [3, 4], "imu": {"gyro": null}, "on": false}
{"t": 1)",
                           "log.jsonl");
  expect_column(log, "t", "", {0, 0.5});
  expect_column(log, "q.2", "", {2, 4});
  expect_column(log, "on", "", {1, 0});
  EXPECT_TRUE(std::isnan(log.table.find("imu.gyro")->values[1]));
  EXPECT_EQ(log.bad.at("imu.gyro").line, 3);
  EXPECT_TRUE(log.bad.at("imu.gyro").missing);
  EXPECT_FALSE(log.bad.at("mode").missing);
}

TEST_F(Log, OtherJson) {
  expect_t_and_q(read(R"([{"t": 0, "q": 1.5}, {"t": 0.5, "q": -2}, {"t": 1, "q": 3e-3}])", "log.json"));
  expect_t_and_q(read(R"({"name": "x", "t": [0, 0.5, 1], "q": [1.5, -2, 3e-3]})", "log.json"));
  EXPECT_NE(
      refusal("{\"t\": 1}\nno\n{\"t\": 2}\n", "log.jsonl").find("log.jsonl:2: found text that is no JSON"),
      std::string::npos);
  EXPECT_NE(refusal("", "log.jsonl").find("no records"), std::string::npos);
}

/// Writes a dataset of doubles.
void put(hid_t file, const char* path, const std::vector<hsize_t>& size, const std::vector<double>& values) {
  const hid_t space = H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr);
  const hid_t links = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(links, 1);
  const hid_t set = H5Dcreate2(file, path, H5T_NATIVE_DOUBLE, space, links, H5P_DEFAULT, H5P_DEFAULT);
  ASSERT_GE(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  H5Dclose(set);
  H5Pclose(links);
  H5Sclose(space);
}

TEST_F(Log, Hdf5ByPath) {
  const std::string path = (folder / "log.h5").string();
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  put(file, "/joint/time", {3}, {0, 0.5, 1});
  put(file, "/joint/q", {3, 2}, {1, 2, 3, 4, 5, std::nan("")});
  put(file, "/slow/time", {2}, {0, 1});
  put(file, "/gain", {1}, {7});
  H5Fclose(file);
  const LogFile log = read_log(path);
  expect_column(log, "joint/time", "", {0, 0.5, 1});
  expect_column(log, "joint/q_1", "", {1, 3, 5});
  EXPECT_EQ(log.bad.at("joint/q_2").row, 3);
  EXPECT_EQ(log.table.find("slow/time"), nullptr);
  ASSERT_EQ(log.remarks.size(), 1U);
  EXPECT_NE(log.remarks[0].find("/slow/time has 2 rows"), std::string::npos);
  expect_column(read_log(path, {{}, {"slow/time"}}), "slow/time", "", {0, 1});
  try {
    read_log(path, {{}, {"slow/time", "joint/q_1"}});
    ADD_FAILURE() << "two lengths";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("columns of a trial have one length"), std::string::npos);
  }
}

TEST_F(Log, Hdf5ThatIsDamaged) {
  EXPECT_NE(refusal("\x89HDF\r\n\x1a\nand no more", "log.bin").find("no whole HDF5 file"), std::string::npos);
}

}  // namespace
}  // namespace plumbline
