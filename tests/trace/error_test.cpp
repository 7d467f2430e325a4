#include "simulator/trace/error.h"

#include <gtest/gtest.h>

namespace plumbline {
namespace {

TEST(InputErrorTest, NamesFileLineKeyFoundAndExpected) {
  const InputError error({"a/model.yaml", 7, "motors.m.unit"}, "\"kg\"", "a unit like N m");
  EXPECT_STREQ(error.what(), "a/model.yaml:7: motors.m.unit: found \"kg\", expected a unit like N m");
}

TEST(InputErrorTest, LeavesOutWhatIsNotKnown) {
  EXPECT_STREQ(InputError({"f.csv", 0, ""}, "no rows", "rows").what(), "f.csv: found no rows, expected rows");
}

TEST(InputErrorTest, IsOneLineWhateverTheFileHeld) {
  const std::string found = std::string("a\nb\rc\td") + '\0' + std::string(5000, 'x');
  const std::string text = InputError({"f", 1, "k\ney"}, found, "less").what();
  EXPECT_EQ(text.find_first_of("\n\r\t"), std::string::npos);
  EXPECT_EQ(text.find('\0'), std::string::npos);
  EXPECT_LT(text.size(), 300U);
}

TEST(NearestNamesTest, SuggestsTheNearestFirst) {
  EXPECT_EQ(nearest_names("leg_angel", {"thigh", "leg_shape", "leg_angle"}),
            "; did you mean leg_angle?");  // leg_shape is 4 edits away
  EXPECT_EQ(nearest_names("Damping", {"stiffness", "damping"}), "; did you mean damping?");
  EXPECT_EQ(nearest_names("knee1", {"knee2", "knee"}), "; did you mean knee2, knee?");
}

TEST(NearestNamesTest, ListsAllWhenNoneIsNear) {
  EXPECT_EQ(nearest_names("zzzzzz", {"hip", "knee"}), "; known: hip, knee");
  EXPECT_EQ(nearest_names("hip", {}), "; none are known");
}

}  // namespace
}  // namespace plumbline
