#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <matio.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
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

/// Writes variables with matio itself, as a recording program would.
class MatWriter {
 public:
  MatWriter(const std::string& path, mat_ft version)
      : file_(Mat_CreateVer(path.c_str(), nullptr, version), Mat_Close) {}

  void numbers(const char* name, std::vector<double> data, std::size_t rows, std::size_t columns) {
    std::array<std::size_t, 2> size{rows, columns};
    add(Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size.data(), data.data(), 0));
  }
  void integers(const char* name, std::vector<std::int16_t> data) {
    std::array<std::size_t, 2> size{data.size(), 1};
    add(Mat_VarCreate(name, MAT_C_INT16, MAT_T_INT16, 2, size.data(), data.data(), 0));
  }
  void text(const char* name, std::string data) {
    std::array<std::size_t, 2> size{1, data.size()};
    add(Mat_VarCreate(name, MAT_C_CHAR, MAT_T_UTF8, 2, size.data(), data.data(), 0));
  }
  void complex(const char* name, std::vector<double> re, std::vector<double> im) {
    std::array<std::size_t, 2> size{re.size(), 1};
    mat_complex_split_t data{re.data(), im.data()};
    add(Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size.data(), &data, MAT_F_COMPLEX));
  }
  void structure(const char* name) {
    std::array<std::size_t, 2> one{1, 1};
    const char* field = "inside";
    matvar_t* variable = Mat_VarCreateStruct(name, 2, one.data(), &field, 1);
    double value = 3;
    Mat_VarSetStructFieldByName(variable, field, 0,
                                Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, one.data(), &value, 0));
    add(variable);
  }
  void cell(const char* name) {
    std::array<std::size_t, 2> size{1, 1};
    double value = 3;
    std::array<matvar_t*, 2> cells{
        Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size.data(), &value, 0), nullptr};
    add(Mat_VarCreate(name, MAT_C_CELL, MAT_T_CELL, 2, size.data(), static_cast<void*>(cells.data()), 0));
  }

 private:
  void add(matvar_t* variable) {
    ASSERT_NE(variable, nullptr);
    ASSERT_EQ(Mat_VarWrite(file_.get(), variable, MAT_COMPRESSION_ZLIB), 0);
    Mat_VarFree(variable);
  }
  std::unique_ptr<mat_t, int (*)(mat_t*)> file_;
};

class MatVersionTest : public testing::TestWithParam<mat_ft> {};
INSTANTIATE_TEST_SUITE_P(Versions, MatVersionTest, testing::Values(MAT_FT_MAT5, MAT_FT_MAT73),
                         [](const auto& tested) { return tested.param == MAT_FT_MAT5 ? "v5" : "v73"; });

TEST_P(MatVersionTest, TakesVectorsAndMatricesAndSkipsTheRest) {
  const TemporaryFolder folder;
  const std::string path = folder.path("a.mat");
  {
    MatWriter file(path, GetParam());
    file.text("note", "a text of some length");
    file.numbers("t", {0, 1, 2}, 3, 1);
    file.numbers("row", {5, 6, 7}, 1, 3);
    file.numbers("q", {1, 2, 3, 4, 5, 6}, 3, 2);  // column by column
    file.numbers("gtau", {35.15}, 1, 1);
    file.numbers("short", {1, 2}, 2, 1);
    file.integers("n", {-1, 0, 300});
    file.structure("info");
    file.cell("list");
    file.complex("z", {1, 2, 3}, {4, 5, 6});
  }
  const Table table = read_table(path);
  std::vector<std::string> names;
  for (const Column& column : table.columns) {
    names.push_back(column.name);
    EXPECT_EQ(column.unit, "");
  }
  EXPECT_THAT(names, testing::UnorderedElementsAre("t", "row", "q_1", "q_2", "n"));
  EXPECT_EQ(table.rows(), 3);
  EXPECT_EQ(table.find("row")->values, Eigen::Vector3d(5, 6, 7));
  EXPECT_EQ(table.find("q_1")->values, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(table.find("q_2")->values, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(table.find("n")->values, Eigen::Vector3d(-1, 0, 300));
}

TEST_P(MatVersionTest, KeepsNanUntilItIsAskedFor) {
  const TemporaryFolder folder;
  const std::string path = folder.path("a.mat");
  {
    MatWriter file(path, GetParam());
    file.numbers("t", {0, 1, 2}, 3, 1);
    file.numbers("x", {0, std::nan(""), 2}, 3, 1);
    file.numbers("y", {0, 1, -std::numeric_limits<double>::infinity()}, 3, 1);
  }
  const Table table = read_mat(path);
  EXPECT_NO_THROW(require_finite(table, "t"));
  EXPECT_EQ(refusal([&] { require_finite(table, "x"); }),
            path + ": x: found NaN in row 2, expected finite numbers");
  EXPECT_EQ(refusal([&] { require_finite(table, "y"); }),
            path + ": y: found infinity in row 3, expected finite numbers");
  EXPECT_NE(refusal([&] { require_finite(table, "T1"); }).find("did you mean t?"), std::string::npos);
}

TEST_P(MatVersionTest, RefusesFilesWithoutVectorsAndCutFiles) {
  const TemporaryFolder folder;
  const std::string path = folder.path("a.mat");
  {
    MatWriter file(path, GetParam());
    file.numbers("gtau", {35.15}, 1, 1);
    file.text("note", "text");
  }
  EXPECT_EQ(refusal([&] { read_mat(path); }),
            path + ": found no vector of numbers, expected at least one real vector or matrix");
  {
    MatWriter file(path, GetParam());
    file.numbers("t", std::vector<double>(1000, 0.5), 1000, 1);
  }
  const std::string whole = folder.read("a.mat");
  for (const std::size_t size : {std::size_t{0}, std::size_t{50}, std::size_t{130}, whole.size() / 2}) {
    const std::string cut = folder.write("cut.mat", whole.substr(0, size));
    testing::internal::CaptureStderr();
    EXPECT_EQ(refusal([&] { read_mat(cut); }).rfind(cut + ": ", 0), 0U);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  }
}

TEST(MatTest, RefusesOtherFiles) {
  const TemporaryFolder folder;
  const std::string text = folder.write("a.mat", std::string(500, 'x'));
  EXPECT_EQ(refusal([&] { read_mat(text); }).rfind(text + ": found", 0), 0U);
  EXPECT_NE(refusal([&] { read_mat(folder.path("none.mat")); }).find("found nothing"), std::string::npos);
  EXPECT_NE(refusal([&] {
              read_table(folder.write("a.txt", ""));
            }).find("found extension .txt, expected .csv or .mat"),
            std::string::npos);
}

TEST(MatTest, WritesWhatItReads) {
  const TemporaryFolder folder;
  Table table;
  table.columns = {{"t", "s", Eigen::VectorXd::LinSpaced(5, 0, 1)},
                   {"q mLA", "rad", Eigen::VectorXd::Random(5)},
                   {"q-mLA", "rad", Eigen::VectorXd::Random(5)},
                   {"2nd", "N m", Eigen::VectorXd::Random(5)}};
  write_mat(table, folder.path("a.mat"));
  const Table back = read_mat(folder.path("a.mat"));
  ASSERT_EQ(back.columns.size(), 4U);
  EXPECT_EQ(back.columns[0].name, "t");
  EXPECT_EQ(back.columns[1].name, "q_mLA");
  EXPECT_EQ(back.columns[2].name, "q_mLA_2");
  EXPECT_EQ(back.columns[3].name, "x2nd");
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(back.columns[i].values, table.columns[i].values);
  }
  EXPECT_EQ(folder.file_count(), 1U);
  EXPECT_NE(refusal([&] { write_mat(table, folder.path("none/a.mat")); }).find("no folder"),
            std::string::npos);
}

}  // namespace
}  // namespace plumbline
