// Results in a file: the same numbers when it is opened again, and what is refused.
#include "validation/identify/predict/kept_results.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "simulator/trace/error.h"
#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::validation {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Kept : public testing::Test {
 protected:
  static Record must_not_be_computed() {
    ADD_FAILURE() << "computed again";
    return {};
  }

  /// Keeps two results.
  void begin() const {
    KeptResults results(file, "inputs");
    results.get({"one"}, [] { return Record({1.0 / 3.0, -0.0, 5e-324}); });
    results.get({"other"}, [] { return Record({2.0}); });
  }

  test::TemporaryFolder folder;
  std::string file = folder.path("results.txt");
};

TEST_F(Kept, AreTheSameDoublesWhenOpenedAgain) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<double> odd{1.0 / 3.0, -0.0, 5e-324, kInfinity, -kInfinity, 1.7e308};
  KeptResults(file, "inputs").get({"one"}, [&] { return Record(odd); });
  KeptResults again(file, "inputs");
  EXPECT_EQ(again.found(), 1U);
  const std::vector<double> read = again.get({"one"}, must_not_be_computed).numbers();
  EXPECT_EQ(read, odd);
  EXPECT_TRUE(std::signbit(read[1]));
}

TEST_F(Kept, NotANumberStaysOne) {
  KeptResults(file, "inputs").get({"one"}, [] { return Record({std::nan("")}); });
  const Record read = KeptResults(file, "inputs").get({"one"}, must_not_be_computed);
  EXPECT_TRUE(std::isnan(read.numbers().at(0)));
}

TEST_F(Kept, OtherWordsOrNumbersAreAnotherResult) {
  KeptResults results(file, "inputs");
  const auto value = [&](const ResultKey& key, double computed) {
    return results.get(key, [&] { return Record({computed}); }).numbers().front();
  };
  EXPECT_EQ(value({"a", Record({1.0})}, 10.0), 10.0);
  EXPECT_EQ(value({"a", Record({1.0})}, 20.0), 10.0);
  EXPECT_EQ(value({"a", Record({1.0 + 1e-16 * 4})}, 30.0), 30.0);
  EXPECT_EQ(value({"b", Record({1.0})}, 40.0), 40.0);
}

TEST_F(Kept, ALineThatWasCutOffIsComputedAgain) {
  begin();
  const std::string whole = folder.read("results.txt");
  folder.write("results.txt", whole.substr(0, whole.size() - 3));
  {
    KeptResults results(file, "inputs");
    EXPECT_EQ(results.found(), 1U);
    EXPECT_THAT(results.get({"other"}, [] { return Record({3.0}); }).numbers(), ElementsAre(3.0));
  }
  KeptResults again(file, "inputs");
  EXPECT_EQ(again.found(), 2U);
  EXPECT_THAT(again.get({"other"}, must_not_be_computed).numbers(), ElementsAre(3.0));
}

TEST_F(Kept, AFileWithoutResultsIsGoneOnWith) {
  EXPECT_EQ(KeptResults(file, "inputs").found(), 0U);
  const std::string begun = folder.read("results.txt");
  EXPECT_EQ(KeptResults(file, "inputs").found(), 0U);
  EXPECT_EQ(folder.read("results.txt"), begun);
}

TEST_F(Kept, InMemoryTheSameIsNotComputedTwice) {
  KeptResults results;
  EXPECT_THAT(results.get({"one"}, [] { return Record({1.0}); }).numbers(), ElementsAre(1.0));
  EXPECT_THAT(results.get({"one"}, must_not_be_computed).numbers(), ElementsAre(1.0));
  EXPECT_TRUE(results.is_written());
}

TEST_F(Kept, AnExceptionKeepsNothing) {
  KeptResults results(file, "inputs");
  EXPECT_THROW(results.get({"one"}, []() -> Record { throw std::runtime_error("lost"); }),
               std::runtime_error);
  EXPECT_THAT(results.get({"one"}, [] { return Record({1.0}); }).numbers(), ElementsAre(1.0));
}

TEST_F(Kept, ResultsOfOtherInputsAreRefusedAndStay) {
  begin();
  const std::string before = folder.read("results.txt");
  EXPECT_THAT(test::refusal([&] { KeptResults(file, "others"); }),
              HasSubstr("results.txt:1: found results of other files"));
  EXPECT_EQ(folder.read("results.txt"), before);
}

TEST_F(Kept, AnotherKindOfFileIsRefusedAndStays) {
  for (const std::string text : {"plumbline: model/1\nname: x\n", "no end of line"}) {
    folder.write("results.txt", text);
    EXPECT_THAT(test::refusal([&] { KeptResults(file, "inputs"); }),
                HasSubstr("expected `plumbline: results/1"));
    EXPECT_EQ(folder.read("results.txt"), text);
  }
}

TEST_F(Kept, ABrokenLineIsNamed) {
  begin();
  const std::string good = folder.read("results.txt");
  for (const std::string line : {"abc", "abc 2 0x1p+0", "abc 1 one", "abc 1 1p+0 1p+0"}) {
    folder.write("results.txt", good + line + "\n");
    EXPECT_THAT(test::refusal([&] { KeptResults(file, "inputs"); }),
                HasSubstr("results.txt:4: found `" + line));
  }
}

TEST_F(Kept, AFileThatCannotBeWrittenIsRefused) {
  EXPECT_THAT(test::refusal([&] { KeptResults(folder.path("none/results.txt"), "inputs"); }),
              HasSubstr("expected a file that can be written"));
}

TEST(Record, IsReadInTheOrderInWhichItWasAdded) {
  const Eigen::VectorXd vector = Eigen::Vector3d(1.0, 2.0, 3.0);
  Record record;
  record.add(7.0).add(vector).add(std::vector<Eigen::VectorXd>{vector, Eigen::VectorXd()});
  RecordReader reader(record);
  EXPECT_EQ(reader.number(), 7.0);
  EXPECT_EQ(reader.vector(), vector);
  const std::vector<Eigen::VectorXd> vectors = reader.vectors();
  ASSERT_EQ(vectors.size(), 2U);
  EXPECT_EQ(vectors[0], vector);
  EXPECT_EQ(vectors[1].size(), 0);
  EXPECT_THROW(reader.number(), std::out_of_range);
}

}  // namespace
}  // namespace plumbline::validation
