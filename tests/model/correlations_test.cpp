// How stated uncertainties hang together: read, written, and forgotten with what they belong to.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "simulator/model/robot_file.h"
#include "tests/model/robot_texts.h"
#include "tests/model/test_laws.h"
#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::model {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class CorrelationsTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("arm.sdf", test::kSkeleton);
    base_ = folder_.write("model.yaml", test::kModel);
  }

  /// A model with three values that were identified together.
  std::string write_identified(const Correlations& together) const {
    const std::string path = folder_.path("identified.yaml");
    write_overlay(path, base_,
                  {{"payload", "lower", {0.4}, false, {0.1}}, {"drag", "rail", {2.0}, false, {0.5}}},
                  {{"drag@mTip:damping", 0.3, 0.05, "N m s/rad", "fit"}}, "", catalogue_, together);
    return path;
  }
  Correlations three() const {
    Correlations together{{"payload@lower:mass", "drag@rail:damping", "drag@mTip:damping"}, {}};
    together.matrix.resize(3, 3);
    together.matrix << 1.0, 0.9, -0.2, 0.9, 1.0, 0.1, -0.2, 0.1, 1.0;
    return together;
  }
  Model read(const std::string& path) const { return read_model(path, catalogue_); }
  std::string refusal_of(const std::string& section) const {
    const std::string path =
        folder_.write("bad.yaml", "plumbline: model/1\nbase: " + write_identified({}) + "\n" + section);
    return test::refusal([&] { read(path); });
  }

  effects::Catalogue catalogue_ = test::test_catalogue();
  test::TemporaryFolder folder_;
  std::string base_;
};

TEST_F(CorrelationsTest, WhatIsWrittenReadsBackButForTheLastTenThousandth) {
  const Correlations read = this->read(write_identified(three())).correlations;
  EXPECT_EQ(read.of, three().of);
  EXPECT_TRUE(read.matrix.isApprox(three().matrix, 2e-4)) << read.matrix;
  EXPECT_EQ(read.matrix, read.matrix.transpose());
}

TEST_F(CorrelationsTest, ValuesThatAreOneAndTheSameCanStillBeWritten) {
  Correlations tied = three();
  tied.matrix(0, 1) = tied.matrix(1, 0) = 1.0;
  tied.matrix(0, 2) = tied.matrix(2, 0) = tied.matrix(1, 2) = tied.matrix(2, 1) = 0.3;
  EXPECT_NEAR(read(write_identified(tied)).correlations.matrix(0, 1), 1.0, 2e-4);
}

TEST_F(CorrelationsTest, WhatWasWrittenWithoutADeviationHasNone) {
  const std::string path = folder_.path("identified.yaml");
  write_overlay(path, base_, {{"payload", "lower", {0.4}, false, {0.1}}, {"drag", "rail", {2.0}}},
                {{"drag@mTip:damping", 0.3, 0.05, "N m s/rad", "fit"}}, "", catalogue_, three());
  const Correlations read = this->read(path).correlations;
  EXPECT_THAT(read.of, ElementsAre("payload@lower:mass", "drag@mTip:damping"));
  EXPECT_NEAR(read.matrix(0, 1), -0.2, 1e-4);
}

TEST_F(CorrelationsTest, AValueThatIsReplacedIsIndependentOfTheOthers) {
  const std::string path = folder_.path("later.yaml");
  write_overlay(path, write_identified(three()), {}, {{"payload@lower:mass", 0.5, 0.01, "kg", "scales"}}, "",
                catalogue_);
  EXPECT_THAT(read(path).correlations.of, ElementsAre("drag@rail:damping", "drag@mTip:damping"));
}

TEST_F(CorrelationsTest, LaterOnesStandBesideThoseOfTheOtherValues) {
  const std::string path = folder_.path("later.yaml");
  Correlations later{{"payload@lower:mass", "drag@rail:damping"}, Eigen::Matrix2d::Identity()};
  later.matrix(0, 1) = later.matrix(1, 0) = -0.5;
  write_overlay(
      path, write_identified(three()), {},
      {{"payload@lower:mass", 0.5, 0.01, "kg", "a"}, {"drag@rail:damping", 1.0, 0.01, "N s/m", "a"}}, "",
      catalogue_, later);
  const Correlations read = this->read(path).correlations;
  const Eigen::MatrixXd matrix = read.among({"drag@mTip:damping", "payload@lower:mass", "drag@rail:damping"});
  EXPECT_NEAR(matrix(1, 2), -0.5, 1e-4);
  EXPECT_EQ(matrix(0, 1), 0.0);
  EXPECT_EQ(matrix(0, 2), 0.0);
}

TEST_F(CorrelationsTest, BadSectionsAreRefusedInOneLine) {
  EXPECT_THAT(
      refusal_of("correlations: {of: [payload@lower:weight, drag@rail:damping], below_diagonal: [[0]]}\n"),
      HasSubstr("bad.yaml:3: correlations.of"));
  EXPECT_THAT(
      refusal_of("correlations: {of: [drag@rail:damping, drag@rail:damping], below_diagonal: [[0]]}\n"),
      HasSubstr("twice"));
  EXPECT_THAT(
      refusal_of("correlations: {of: [payload@lower:mass, drag@rail:damping], below_diagonal: [[0, 1]]}\n"),
      HasSubstr("found 2 numbers, expected 1"));
  EXPECT_THAT(refusal_of("correlations: {of: [payload@lower:mass, drag@rail:damping], below_diagonal: []}\n"),
              HasSubstr("found 0 rows, expected 1"));
  EXPECT_THAT(
      refusal_of("correlations: {of: [payload@lower:mass, drag@rail:damping], below_diagonal: [[1.5]]}\n"),
      HasSubstr("expected a positive definite matrix"));
}

}  // namespace
}  // namespace plumbline::model
